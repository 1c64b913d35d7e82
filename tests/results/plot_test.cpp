// The lines, ticks and labels of a plot.
#include "results/plot.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "tests/results/markup.h"

using namespace stillhook;

TEST_CASE("thinning keeps every extreme and the ends; a plot of 20,000 samples stays small") {
  PlotLine line{"x", {}, {}};
  for (int i = 0; i < 20000; ++i) {
    line.time.push_back(0.2 * i);
    line.value.push_back(std::sin(0.7 * i) + (i == 12345 ? 5.0 : 0.0) - (i == 777 ? 7.0 : 0.0));
  }
  const auto points = thin_out(line, 0.0, line.time.back(), 400);
  CHECK(points.size() <= 4 * 401);
  CHECK(std::is_sorted(points.begin(), points.end(), [](auto& a, auto& b) { return a.first < b.first; }));
  const auto [low, high] =
      std::minmax_element(points.begin(), points.end(), [](auto& a, auto& b) { return a.second < b.second; });
  CHECK(low->first == line.time[777]);
  CHECK(high->first == line.time[12345]);
  CHECK(points.front().first == line.time.front());
  CHECK(points.back().first == line.time.back());

  Plot plot;
  plot.title = "A & B <C>";
  plot.lines = {line, line, line, line};
  plot.phases = {{"first", 0, 2000}, {"second", 2000, 4000}};
  const std::string svg = draw_plot(plot);
  CHECK(svg.size() < 60000);
  CHECK(unbalanced(svg) == "");
  CHECK(svg.find("A &amp; B &lt;C&gt;") != std::string::npos);
}

TEST_CASE("ticks are round, cover the range and are few") {
  for (const auto& [low, high] :
       {std::pair{0.0, 1.0}, {-3.2, 7.9}, {73.9, 74.1}, {0.0, 1886.0}, {-1e-6, 1e-6}, {4.9e6, 5.2e6}}) {
    const std::vector<double> ticks = nice_ticks(low, high, 5);
    INFO(low << " " << high);
    CHECK(ticks.front() <= low + 1e-9 * (high - low));
    CHECK(ticks.back() >= high - 1e-9 * (high - low));
    CHECK(ticks.size() >= 3);
    CHECK(ticks.size() <= 8);
  }
}

TEST_CASE("a gap breaks the line instead of bridging it; a constant line has an axis") {
  Plot plot;
  plot.lines = {{"x", {0, 1, 2, 3, 4}, {1, 1, std::nan(""), 1, 1}}};
  const std::string svg = draw_plot(plot);
  const std::size_t path = svg.find("<g transform=\"scale(.1)\"");
  CHECK(count(svg.substr(path, svg.find("</g>", path) - path), "M") == 2);
  CHECK(count(svg, "nan") == 0);
}

TEST_CASE("a plot over frequencies shows the periods as well, and small numbers leave its labels short") {
  Plot plot;
  plot.x_label = "ω, rad/s";
  plot.y_label = "m";
  plot.periods = true;
  plot.lines = {{"x", {0.0, 0.5, 1.0, 2.0}, {0.0, 1e-7, 3e-7, 4e-7}}};
  const std::string svg = draw_plot(plot);
  CHECK_THAT(svg, Catch::Contains(">12.6 s</text>") && Catch::Contains(">6.28 s</text>"));  // 2 pi / 0.5, 2 pi / 1
  CHECK_THAT(svg, Catch::Contains("ω, rad/s, with the period"));
  CHECK_THAT(svg, Catch::Contains(">m (in 10⁻⁹)</text>") && Catch::Contains(">400</text>"));
  CHECK_THAT(svg, !Catch::Contains(">0.000000</text>"));
}
