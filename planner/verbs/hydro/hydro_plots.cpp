#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "planner/verbs/hydro/hydro_report.h"
#include "planner/verbs/hydro/hydro_tables.h"
#include "results/html.h"
#include "results/plot.h"
#include "sim/spatial/constants.h"

namespace stillhook {
namespace {

constexpr double kNegligible = 1e-4;  // of the largest mode of its kind: not plotted
constexpr double kStillMotion = 1e-4, kStillTurn = 2e-5;  // m/m and rad/m (0.001 deg/m): a motion that is nothing
constexpr int kModelSamples = 160;
constexpr double kKernelEnd = 25.0;  // s, plotted at most

std::string grid(const std::vector<Plot>& plots) {
  std::string out;
  for (const Plot& plot : plots) out += "<figure><div class=\"scroll\">" + draw_plot(plot) + "</div></figure>";
  return out.empty() ? "" : "<div class=\"pairs\">" + out + "</div>";
}

/// "10³ t m²" and the factor that belongs to it, so that tick labels stay short.
ShownUnit readable(const ShownUnit& unit, double largest) {
  static constexpr std::array<const char*, 4> kPowers = {"", "10³ ", "10⁶ ", "10⁹ "};
  std::size_t power = 0;
  double factor = unit.factor;
  for (double rest = largest / unit.factor; rest >= 1e4 && power + 1 < kPowers.size(); rest /= 1e3, factor *= 1e3) ++power;
  std::string text = unit.name;
  if (text.ends_with("m2")) text.replace(text.size() - 2, 2, "m²");
  return {kPowers[power] + text, factor};
}

Plot empty_plot(const std::string& title, const std::string& y_label, const std::string& x_label) {
  Plot plot;
  plot.title = title;
  plot.y_label = y_label;
  plot.x_label = x_label;
  plot.periods = x_label.starts_with("ω");
  plot.width = 520.0;
  plot.height = 270.0;
  return plot;
}

/// A or B of one mode: the set's values, and the reduced model between them.
Plot coefficient_plot(const HydroSet& set, int i, bool added_mass) {
  const HydrodynamicCoefficients& c = *set.set;
  PlotLine data{added_mass ? "A(ω)" : "B(ω)", {}, {}}, model{"reduced model", {}, {}};
  double largest = 0.0, lowest = std::numeric_limits<double>::infinity(), highest = 0.0;
  for (const FrequencyCoefficients& at : c.frequency) {
    if (at.frequency <= 0.0) continue;
    data.time.push_back(at.frequency);
    data.value.push_back(added_mass ? at.A(i, i) : at.B(i, i));
    largest = std::max(largest, std::abs(data.value.back()));
    lowest = std::min(lowest, at.frequency);
    highest = std::max(highest, at.frequency);
  }
  if (set.fit && highest > 0.0)
    for (int n = 0; n <= kModelSamples; ++n) {
      const double w = lowest + n * (highest - lowest) / kModelSamples;
      model.time.push_back(w);
      model.value.push_back(added_mass ? c.A_inf(i, i) + set.fit->fit.added_mass_change(w)(i, i)
                                       : set.fit->fit.damping(w)(i, i));
    }
  const ShownUnit unit = readable(added_mass ? added_mass_unit(i, i) : damping_unit(i, i), largest);
  for (PlotLine* line : {&data, &model})
    for (double& v : line->value) v /= unit.factor;
  Plot plot = empty_plot(fmt::format("{} in {}", added_mass ? "Added mass" : "Radiation damping", set.mode_name(i)),
                         unit.name, "ω, rad/s");
  plot.lines.push_back(std::move(data));
  if (!model.time.empty()) plot.lines.push_back(std::move(model));
  if (added_mass) {
    plot.limits.push_back({"A(∞)", c.A_inf(i, i) / unit.factor});
    if (!c.frequency.empty() && c.frequency.front().frequency == 0.0)
      plot.limits.push_back({"A(0)", c.frequency.front().A(i, i) / unit.factor});
  }
  return plot;
}

Plot kernel_plot(const HydroSet& set, int i) {
  const HydrodynamicCoefficients& c = *set.set;
  const double end = std::min(kKernelEnd, c.retardation.duration());
  PlotLine kernel{"K(t)", {}, {}}, model{"reduced model", {}, {}};
  double largest = 0.0;
  for (const RetardationKernel& k : c.retardation.kernels) {
    if (k.i != i || k.j != i) continue;
    for (std::size_t m = 0; m < k.value.size() && static_cast<double>(m) * c.retardation.interval <= end; ++m) {
      kernel.time.push_back(static_cast<double>(m) * c.retardation.interval);
      kernel.value.push_back(k.value[m]);
      largest = std::max(largest, std::abs(k.value[m]));
    }
  }
  if (set.fit)
    for (const double t : kernel.time) {
      model.time.push_back(t);
      model.value.push_back(set.fit->fit.retardation(t)(i, i));
    }
  const ShownUnit unit = readable(kernel_unit(i, i), largest);
  for (PlotLine* line : {&kernel, &model})
    for (double& v : line->value) v /= unit.factor;
  Plot plot = empty_plot("Retardation function in " + set.mode_name(i), unit.name, "t, s");
  plot.lines.push_back(std::move(kernel));
  if (!model.time.empty()) plot.lines.push_back(std::move(model));
  return plot;
}

/// Amplitude and phase of X in one mode, a line a heading.
std::array<Plot, 2> excitation_plots(const HydroSet& set, int i) {
  const ExcitationTable& X = set.set->excitation;
  const std::vector<int> headings = shown_headings(X);
  double largest = 0.0;
  for (const int h : headings)
    for (std::size_t f = 0; f < X.frequencies.size(); ++f)
      largest = std::max(largest, std::abs(X.at(static_cast<int>(f), h, i)));
  const ShownUnit unit = readable(excitation_unit(i), largest);
  std::array<Plot, 2> plots{empty_plot("Excitation in " + set.mode_name(i), unit.name, "ω, rad/s"),
                            empty_plot("Its lag behind the crest", "deg", "ω, rad/s")};
  for (const int h : headings) {
    PlotLine amplitude{fmt::format("{:.0f}°", X.headings[h] / kDegree), {}, {}}, phase = amplitude;
    double before = 0.0;
    for (std::size_t f = 0; f < X.frequencies.size(); ++f) {
      const Complex x = X.at(static_cast<int>(f), h, i);
      amplitude.time.push_back(X.frequencies[f]);
      amplitude.value.push_back(std::abs(x) / unit.factor);
      phase.time.push_back(X.frequencies[f]);
      const double now = std::arg(x) / kDegree;
      // The line is broken where the phase jumps through 180 deg, and where there is no force.
      const bool jump = f > 0 && std::abs(now - before) > 180.0;
      phase.value.push_back(std::abs(x) < 1e-6 * largest || jump ? kNaN : now);
      before = now;
    }
    plots[0].lines.push_back(std::move(amplitude));
    plots[1].lines.push_back(std::move(phase));
  }
  return plots;
}

/// Modes whose largest value is not nothing beside the others of their kind.
std::vector<int> excited_modes(const ExcitationTable& X) {
  std::vector<double> largest(X.modes, 0.0);
  for (const int h : shown_headings(X))
    for (std::size_t f = 0; f < X.frequencies.size(); ++f)
      for (int i = 0; i < X.modes; ++i) largest[i] = std::max(largest[i], std::abs(X.at(static_cast<int>(f), h, i)));
  std::vector<int> modes;
  for (int i = 0; i < X.modes; ++i) {
    double most = 0.0;
    for (int j = i / 3 * 3; j < i / 3 * 3 + 3; ++j) most = std::max(most, largest[j]);
    if (largest[i] > kNegligible * most) modes.push_back(i);
  }
  return modes;
}

/// Amplitude of one motion by heading, and its lag behind the crest that passes the body.
std::array<Plot, 2> response_pair(const ResponseCurves& curves, const BodyResponse& body, int i, const char* name,
                                  double largest) {
  std::array<Plot, 2> plots{
      empty_plot(fmt::format("{} of {}", name, readable_name(body.name)), i < 3 ? "m/m" : "deg/m", "ω, rad/s"),
      empty_plot("Its lag behind the crest", "deg", "ω, rad/s")};
  for (std::size_t h = 0; h < curves.headings.size(); ++h) {
    PlotLine amplitude{fmt::format("{:.0f}°", curves.headings[h] / kDegree), curves.frequencies, {}}, lag = amplitude;
    double before = 0.0;
    for (const ResponseAmplitude::Vector6c& value : body.value[h]) {
      amplitude.value.push_back(std::abs(value[i]) / (i < 3 ? 1.0 : kDegree));
      const double now = std::arg(value[i]) / kDegree;
      // The line is broken where it jumps through 180 deg, and where nothing moves.
      const bool shown = std::abs(value[i]) > kNegligible * largest && std::abs(now - before) <= 180.0;
      lag.value.push_back(shown ? now : kNaN);
      before = now;
    }
    plots[0].lines.push_back(std::move(amplitude));
    plots[1].lines.push_back(std::move(lag));
  }
  return plots;
}

}  // namespace

std::string coefficient_plots(const HydroSet& set) {
  const int modes = set.set->modes();
  std::vector<Plot> coefficients, kernels, excitation;
  for (int i = 0; i < modes; ++i) {
    if (!set.set->frequency.empty()) {
      coefficients.push_back(coefficient_plot(set, i, true));
      coefficients.push_back(coefficient_plot(set, i, false));
    }
    const auto& all = set.set->retardation.kernels;
    if (std::any_of(all.begin(), all.end(), [&](const RetardationKernel& k) { return k.i == i && k.j == i; }))
      kernels.push_back(kernel_plot(set, i));
  }
  if (!set.set->excitation.empty())
    for (const int i : excited_modes(set.set->excitation))
      for (Plot& plot : excitation_plots(set, i)) excitation.push_back(std::move(plot));
  std::string out;
  if (!coefficients.empty()) out += "<h3>Added mass and damping</h3>" + grid(coefficients);
  if (!excitation.empty())
    out +=
        "<h3>Excitation per metre of wave</h3><p><small>By the direction the waves travel towards, relative to the "
        "hull: 180° head seas, 90° beam seas from starboard.</small></p>" +
        grid(excitation);
  if (!kernels.empty()) out += "<h3>Retardation functions</h3>" + grid(kernels);
  return out;
}

std::string response_plots(const ResponseCurves& curves) {
  static constexpr std::array<const char*, 6> kNames = {"Surge", "Sway", "Heave", "Roll", "Pitch", "Yaw"};
  std::string out;
  for (const BodyResponse& body : curves.bodies) {
    std::vector<Plot> plots;
    std::string still;
    for (int i = 0; i < 6; ++i) {
      double largest = 0.0;
      for (const auto& heading : body.value)
        for (const ResponseAmplitude::Vector6c& value : heading)
          if (std::isfinite(std::abs(value[i]))) largest = std::max(largest, std::abs(value[i]));
      if (largest > (i < 3 ? kStillMotion : kStillTurn))
        for (Plot& plot : response_pair(curves, body, i, kNames[i], largest)) plots.push_back(std::move(plot));
      else
        still += (still.empty() ? "" : ", ") + std::string(kNames[i]);
    }
    out += "<h3>" + escape_html(readable_name(body.name)) + "</h3>" + grid(plots);
    if (!still.empty()) out += "<p><small>Not drawn, because next to nothing moves: " + still + ".</small></p>";
  }
  return out;
}

}  // namespace stillhook
