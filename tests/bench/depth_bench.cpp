// What the panel method over a flat bed gives and costs, run by hand:
//
//   build/stillhook_depth_bench [box | cylinders | cost]
//
// The box hull of the reference lift and truncated cylinders against what others computed (the truths of
// finite_depth_hulls_test.cpp), and processor time at several depths; all three without an argument. Nothing here is a
// test.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <ctime>
#include <map>
#include <numbers>

#include "sim/spatial/constants.h"
#include "tests/truth/finite_depth.h"

namespace {

using namespace stillhook;

double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Largest deviation of a group of values, and where.
struct Worst {
  double value = 0.0, frequency = 0.0;
  void take(double deviation, double w) {
    if (std::abs(deviation) > std::abs(value)) value = deviation, frequency = w;
  }
};

std::size_t nearest(const std::vector<double>& values, double value) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < values.size(); ++i)
    if (std::abs(values[i] - value) < std::abs(values[best] - value)) best = i;
  return best;
}

void box() {
  fmt::print("Box hull 110 x 46 x 4 m, 0.3 to 1.0 rad/s: largest deviation from HAMS, %, and where, rad/s\n");
  for (const char* depth : {"inf", "40", "20", "10"}) {
    PanelMethodOptions options;
    options.headings = 8;
    if (std::string(depth) != "inf") options.depth = std::stod(depth);
    options.chosen = truth::box_frequencies();
    const double begin = processor_seconds();
    const HydrodynamicCoefficients c = panel_method({truth::box_in_water()}, options);
    const double seconds = processor_seconds() - begin;
    const std::vector<truth::DepthRow> rows = truth::box_over_bed(depth);
    std::map<std::pair<int, double>, double> largest;
    for (const auto& row : rows)
      if (row.quantity == "X") largest[{row.i, row.frequency}] = std::max(largest[{row.i, row.frequency}], row.value);
    std::map<std::string, Worst> worst;
    Worst force, phase;
    for (const auto& row : rows) {
      if (row.quantity == "X") {
        const double most = largest[{row.i, row.frequency}];
        if (row.value < 0.1 * most) continue;
        const Complex X = c.excitation.at(static_cast<int>(nearest(c.excitation.frequencies, row.frequency)),
                                          static_cast<int>(nearest(c.excitation.headings, row.j * kDegree)), row.i);
        force.take(100.0 * (std::abs(X) / row.value - 1.0), row.frequency);
        phase.take(std::remainder(std::arg(X) / kDegree - row.phase, 360.0), row.frequency);
        continue;
      }
      const int j = static_cast<int>(row.j) - 1;
      if (row.i != j) continue;
      for (const FrequencyCoefficients& f : c.frequency)
        if (std::abs(f.frequency - row.frequency) < 1e-9)
          worst[row.quantity + std::to_string(row.i + 1)].take(
              100.0 * ((row.quantity == "A" ? f.A : f.B)(j, j) / row.value - 1.0), row.frequency);
    }
    fmt::print("depth {:>3} m, {:.1f} s of processor time:", depth, seconds);
    for (const auto& [name, at] : worst) fmt::print("  {}{} {:+.1f} ({:.1f})", name, name[1], at.value, at.frequency);
    fmt::print("  |X| {:+.1f} ({:.1f})  phase {:+.1f} deg ({:.1f})\n", force.value, force.frequency, phase.value,
               phase.frequency);
  }
}

void cylinders() {
  fmt::print(
      "\nTruncated cylinders, Ka 0.1 to 2, refinement 1.7: largest deviation from the exact solution, %, and Ka\n"
      "draft/a depth/a      A11         A33         A55       B11 of max  B33 of max       X1          X3\n");
  for (const auto& [draft, depth] : {std::pair{0.2, 0.4}, std::pair{0.5, 1.0}, std::pair{0.5, 1.5},
                                     std::pair{0.5, 10.0}, std::pair{1.0, 1.5}, std::pair{1.0, 3.0}}) {
    const std::vector<truth::CylinderRow> rows = truth::cylinder_over_bed(draft, depth);
    const PanelMethodOptions options = truth::cylinder_options(rows);
    const HydrodynamicCoefficients c = panel_method({truth::cylinder_in_water(draft)}, options);
    constexpr double a = truth::kCylinderRadius;
    const double plane = std::numbers::pi * a * a, mass = options.density * plane * draft * a;
    const double force = options.density * options.gravity * plane;
    double most_B11 = 0.0, most_B33 = 0.0;
    for (const auto& row : rows) most_B11 = std::max(most_B11, row.B11), most_B33 = std::max(most_B33, row.B33);
    std::array<Worst, 7> worst;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const truth::CylinderRow& row = rows[i];
      const FrequencyCoefficients& f = c.frequency[i];
      const int at = static_cast<int>(nearest(c.excitation.frequencies, f.frequency));
      const double w = f.frequency;
      worst[0].take(100.0 * (f.A(0, 0) / mass / row.A11 - 1.0), row.Ka);
      worst[1].take(100.0 * (f.A(2, 2) / mass / row.A33 - 1.0), row.Ka);
      worst[2].take(100.0 * (f.A(4, 4) / mass / (a * a) / row.A55 - 1.0), row.Ka);
      worst[3].take(100.0 * (f.B(0, 0) / (mass * w) - row.B11) / most_B11, row.Ka);
      worst[4].take(100.0 * (f.B(2, 2) / (mass * w) - row.B33) / most_B33, row.Ka);
      worst[5].take(100.0 * (std::abs(c.excitation.at(at, 0, 0)) / force / row.X1 - 1.0), row.Ka);
      worst[6].take(100.0 * (std::abs(c.excitation.at(at, 0, 2)) / force / row.X3 - 1.0), row.Ka);
    }
    fmt::print("{:7.1f} {:7.1f}", draft, depth);
    for (const Worst& at : worst) fmt::print("  {:+5.2f} ({:.1f})", at.value, at.frequency);
    fmt::print("\n");
  }
}

void cost() {
  fmt::print("\nThe box hull with the automatic band: processor time\n");
  for (const double depth : {0.0, 40.0, 20.0, 10.0}) {
    PanelMethodOptions options;
    options.frequencies = 0;
    if (depth > 0.0) options.depth = depth, options.lowest = 0.1;
    PanelMethodReport report;
    const double begin = processor_seconds();
    const HydrodynamicCoefficients c = panel_method({truth::box_in_water()}, options, &report);
    int most = 0;
    for (const PanelBand& band : report.bands) most = std::max(most, band.surface_panels);
    fmt::print(
        "  {:>4}: {:.1f} s, {} frequencies from {:.1f} rad/s in {} parts, at most {} panels on the water; pressure and "
        "radiated energy differ by {:.1f} %\n",
        depth > 0.0 ? fmt::format("{:.0f} m", depth) : "deep", processor_seconds() - begin,
        c.frequency.size() - (depth > 0.0 ? 0 : 1), options.lowest, report.bands.size(), most,
        100.0 * report.energy_balance);
  }
}

}  // namespace

int main(int argc, char** argv) {
  const std::string what = argc > 1 ? argv[1] : "";
  if (what.empty() || what == "box") box();
  if (what.empty() || what == "cylinders") cylinders();
  if (what.empty() || what == "cost") cost();
}
