// What the panel method gives and costs, run by hand:
//
//   build/stillhook_panel_bench [folder for plots [plots only]]
//
// Coefficients of the reference crane hull and of a hemisphere against what others computed (the truths of the tests),
// as tables and SVG plots; processor time of the computation, of the cache, of the state space in a simulation step, and
// how fast the march runs. Nothing here is a test.
#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <fstream>

#include "problems/case.h"
#include "results/plot.h"
#include "sim/hull/coefficients/coefficient_source.h"
#include "sim/simulate.h"
#include "tests/truth/box_hull.h"
#include "tests/truth/hemisphere.h"
#include "tests/truth/sphere_mesh.h"

namespace {

using namespace stillhook;

double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }
double clock_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

constexpr const char* kModes[6] = {"surge", "sway", "heave", "roll", "pitch", "yaw"};
std::filesystem::path folder;

void save(const Plot& plot, const std::string& name) {
  if (folder.empty()) return;
  std::filesystem::create_directories(folder);
  std::string svg = draw_plot(plot);
  if (const std::size_t at = svg.find("<svg"); at != std::string::npos && svg.find("xmlns") == std::string::npos)
    svg.insert(at + 4, " xmlns=\"http://www.w3.org/2000/svg\"");
  std::ofstream(folder / (name + ".svg")) << svg;
}

/// A value of another's as a short stroke.
void add_stroke(PlotLine& line, double x, double value, double half) {
  for (const double at : {x - half, x + half}) {
    line.time.push_back(at);
    line.value.push_back(value);
  }
  line.time.push_back(x + half);
  line.value.push_back(std::nan(""));
}

PanelHull crane() {
  PanelHull hull;
  hull.name = "crane";
  hull.box_size = {110.0, 46.0, 7.5};
  hull.box_centre = {0.0, 0.0, -0.25};
  hull.mesh = box_mesh(hull.box_size, hull.box_centre, 4.0);
  return hull;
}

void hemisphere() {
  PanelHull hull;
  hull.name = "sphere";
  hull.mesh = truth::sphere_mesh(10.0, 32);
  PanelMethodOptions options;
  options.headings = 8;
  for (const auto& exact : truth::kHemisphere) options.chosen.push_back(std::sqrt(exact.Ka * options.gravity / 10.0));
  fmt::print("\nHemisphere: deviation from the exact solution, %: of A; of the largest B\n");
  for (const double refinement : {0.7, 1.0, 1.7}) {
    options.refinement = refinement;
    PanelMethodReport report;
    const double begin = processor_seconds();
    const HydrodynamicCoefficients c = panel_method({hull}, options, &report);
    fmt::print("refinement {:.1f}: {} hull and {} surface panels at most, {:.1f} s of processor time\n", refinement,
               report.bands.back().hull_panels, report.bands.back().surface_panels, processor_seconds() - begin);
    fmt::print("  Ka    A33    B33    A11    B11\n");
    const double mass = options.density * c.volume[0];
    Plot plot;
    plot.title = "Floating hemisphere: panel method (lines) and exact solution (strokes)";
    plot.x_label = "Ka";
    plot.y_label = "A, B over displaced mass";
    std::vector<PlotLine> lines = {{"A heave", {}, {}}, {"B heave", {}, {}}, {"A surge", {}, {}}, {"B surge", {}, {}},
                                   {"A heave exact", {}, {}}, {"B heave exact", {}, {}}, {"A surge exact", {}, {}},
                                   {"B surge exact", {}, {}}};
    for (std::size_t i = 0; i < truth::kHemisphere.size(); ++i) {
      const auto& exact = truth::kHemisphere[i];
      const FrequencyCoefficients& at = c.frequency[i + 1];
      const double found[4] = {at.A(2, 2) / mass, at.B(2, 2) / mass / at.frequency, at.A(0, 0) / mass,
                               at.B(0, 0) / mass / at.frequency};
      const double truth[4] = {exact.A_heave, exact.B_heave, exact.A_surge, exact.B_surge};
      fmt::print("  {:.1f}  {:+5.2f}  {:+5.2f}  {:+5.2f}  {:+5.2f}\n", exact.Ka, 100.0 * (found[0] / truth[0] - 1.0),
                 100.0 * (found[1] - truth[1]) / truth::kMostHeaveDamping, 100.0 * (found[2] / truth[2] - 1.0),
                 100.0 * (found[3] - truth[3]) / truth::kMostSurgeDamping);
      for (int k = 0; k < 4; ++k) {
        lines[k].time.push_back(exact.Ka);
        lines[k].value.push_back(found[k]);
        add_stroke(lines[k + 4], exact.Ka, truth[k], 0.02);
      }
    }
    plot.lines = lines;
    if (refinement == 1.0) save(plot, "hemisphere");
  }
}

void box() {
  PanelMethodReport report;
  const PanelMethodOptions options;
  const double begin = processor_seconds(), clock = clock_seconds();
  const HydrodynamicCoefficients c = panel_method({crane()}, options, &report);
  fmt::print("\nCrane hull 110 x 46 x 4, {} frequencies from {} to {} rad/s: {:.1f} s of processor time, {:.1f} s by the clock\n",
             options.frequencies, options.lowest, options.highest, processor_seconds() - begin,
             clock_seconds() - clock);
  double bytes = 0.0;
  for (const PanelBand& band : report.bands) {
    fmt::print("  {:.2f}-{:.2f} rad/s: {} hull, {} surface panels, {:.0f} MB, {} iterations\n", band.from, band.to,
               band.hull_panels, band.surface_panels, band.bytes / 1e6, band.iterations);
    bytes = std::max(bytes, band.bytes);
  }
  PanelMethodOptions at = options;
  at.headings = 8;
  for (const truth::BoxHull& exact : truth::kBoxHull) at.chosen.push_back(exact.frequency);
  const HydrodynamicCoefficients chosen = panel_method({crane()}, at);
  fmt::print("deviation from the frequency-domain codes, %\n  rad/s       surge   sway  heave   roll  pitch    yaw\n");
  for (std::size_t f = 0; f < truth::kBoxHull.size(); ++f)
    for (const char quantity : {'A', 'B'}) {
      fmt::print("  {:.3f}  {}  ", truth::kBoxHull[f].frequency, quantity);
      for (int i = 0; i < 6; ++i) {
        const auto& e = truth::kBoxHull[f];
        const double found = quantity == 'A' ? chosen.frequency[f + 1].A(i, i) : chosen.frequency[f + 1].B(i, i);
        fmt::print("  {:+5.2f}", 100.0 * (found / (quantity == 'A' ? e.A[i] : e.B[i]) - 1.0));
      }
      fmt::print("\n");
    }
  for (int i = 0; i < 6; ++i) {
    Plot plot;
    plot.title = fmt::format("Box hull 110 x 46 x 4 m, {}: panel method (lines), two other codes (strokes)", kModes[i]);
    plot.x_label = "frequency, rad/s";
    plot.y_label = i < 3 ? "A, kt;  B, kt/s" : "A, Mt m2;  B, Mt m2/s";
    const double unit = i < 3 ? 1e6 : 1e9;
    PlotLine A{"A", {}, {}}, B{"B", {}, {}}, A_other{"A, others", {}, {}}, B_other{"B, others", {}, {}};
    for (const FrequencyCoefficients& f : c.frequency) {
      A.time.push_back(f.frequency), A.value.push_back(f.A(i, i) / unit);
      B.time.push_back(f.frequency), B.value.push_back(f.B(i, i) / unit);
    }
    for (const truth::BoxHull& e : truth::kBoxHull) {
      add_stroke(A_other, e.frequency, e.A[i] / unit, 0.02);
      add_stroke(B_other, e.frequency, e.B[i] / unit, 0.02);
    }
    plot.lines = {A, B, A_other, B_other};
    save(plot, fmt::format("box_{}", kModes[i]));
  }
}

void in_simulation() {
  Case c = read_case(std::string(STILLHOOK_SOURCE_DIR) + "/problems/box_installation.toml");
  c.specification.solver.max_duration = 300.0;
  using Model = HydrodynamicsSpec::RadiationModel;
  build_model(c.specification);  // fills the cache
  const double begin = processor_seconds();
  build_model(c.specification);
  fmt::print("\nReference lift: model with coefficients known to this process: {:.2f} s\n", processor_seconds() - begin);
  double plain = 0.0;
  const auto run = [&](const char* name, const Specification& s) {
    const stillhook::Model model = build_model(s);
    const Operation operation = build_operation(model);
    RunOptions options;
    options.record = false;
    double best = 1e9;
    for (int i = 0; i < 3; ++i) {
      const double start = clock_seconds();
      simulate(model, operation, options);
      best = std::min(best, clock_seconds() - start);
    }
    if (plain == 0.0) plain = best;
    fmt::print("  {:<34} {:7.1f} times real time, {:.2f} of the first\n", name, 300.0 / best, best / plain);
  };
  Specification s = c.specification;
  for (BodySpec& body : s.bodies)
    if (body.hydrodynamics.kind == HydrodynamicsSpec::Kind::panels) {
      body.hydrodynamics.kind = HydrodynamicsSpec::Kind::constant;
      body.hydrodynamics.added_mass = body.mass * Matrix6::Identity();
      body.hydrodynamics.added_mass.bottomRightCorner<3, 3>() = body.inertia;
      body.hydrodynamics.damping = 0.1 * body.hydrodynamics.added_mass;
    }
  run("constant coefficients", s);
  for (const auto& [name, model] : {std::pair{"reduced", Model::reduced}, std::pair{"retardation", Model::retardation},
                                    std::pair{"direct", Model::direct}}) {
    s = c.specification;
    for (BodySpec& body : s.bodies)
      if (body.hydrodynamics.kind == HydrodynamicsSpec::Kind::panels) body.hydrodynamics.radiation = model;
    run(name, s);
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc > 1) folder = argv[1];
  box();
  hemisphere();
  if (argc <= 2) in_simulation();  // anything after the folder: only the plots
}
