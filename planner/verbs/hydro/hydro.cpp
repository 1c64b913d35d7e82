#include "planner/verbs/hydro/hydro.h"

#include <omp.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>

#include "sim/hull/afloat.h"
#include "sim/hull/hydrodynamics.h"
#include "sim/hull/hydrostatics.h"

namespace stillhook {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

/// The lift with nothing in its hulls' hydrodynamics: it floats where the complete one does.
Model model_at_rest(const Case& c) {
  Specification spec = c.specification;
  spec.sea.active.clear();
  for (BodySpec& body : spec.bodies) body.hydrodynamics = HydrodynamicsSpec();
  try {
    return build_model(spec);
  } catch (const SpecificationError& error) {
    throw located(c, error);
  }
}

/// Bodies whose hulls have coefficients, each once: alone, or with the one whose set it shares.
std::vector<std::vector<int>> groups_of(const Specification& spec) {
  using Kind = HydrodynamicsSpec::Kind;
  std::vector<std::vector<int>> groups;
  for (const std::vector<std::size_t>& together : coupled_hulls(spec.bodies)) {
    const Kind kind = spec.bodies[together.front()].hydrodynamics.kind;
    if (kind != Kind::none && kind != Kind::constant && kind != Kind::rao) groups.emplace_back(together.begin(), together.end());
  }
  return groups;
}

/// Floating point operations per second of one thread, by a product that fits the cache.
double measured_speed() {
  constexpr int n = 384;
  const MatrixX a = MatrixX::Constant(n, n, 1.25), b = MatrixX::Constant(n, n, 0.75);
  MatrixX c(n, n);
  // The fastest of some rounds: what else the machine does is not counted.
  double least = std::numeric_limits<double>::max();
  for (int round = 0; round < 8; ++round) {
    const Clock::time_point begin = Clock::now();
    c.noalias() = a * b;
    least = std::min(least, seconds_since(begin));
  }
  return 2.0 * n * n * n / least;
}

}  // namespace

std::string HydroSet::name() const {
  std::string text;
  for (const std::string& body : names) text += (text.empty() ? "" : "-") + body;
  return text;
}

std::string HydroSet::title() const {
  std::string text;
  for (const std::string& body : names) text += (text.empty() ? "" : " and ") + body;
  return text;
}

std::string HydroSet::mode_name(int mode) const {
  static constexpr std::array<const char*, 6> kNames = {"surge", "sway", "heave", "roll", "pitch", "yaw"};
  return (names.size() > 1 ? names[mode / 6] + " " : "") + kNames[mode % 6];
}

std::vector<HydroSet> planned_sets(const Case& c) {
  const Specification& spec = c.specification;
  std::vector<HydroSet> sets;
  std::vector<std::vector<int>> groups;
  try {
    groups = groups_of(spec);
  } catch (const SpecificationError& error) {
    throw located(c, error);
  }
  if (groups.empty()) return sets;
  const Model at_rest = model_at_rest(c);
  for (const std::vector<int>& bodies : groups) {
    HydroSet set;
    set.bodies = bodies;
    for (const int body : bodies) set.names.push_back(spec.bodies[body].name);
    const HydrodynamicsSpec& h = spec.bodies[bodies.front()].hydrodynamics;
    set.panels = h.kind == HydrodynamicsSpec::Kind::panels;
    if (set.panels) {
      std::vector<Mesh> meshes(bodies.size());
      std::vector<HullAfloat> afloat;
      double panel = 0.0;
      for (std::size_t k = 0; k < bodies.size(); ++k) {
        meshes[k] = build_hull_mesh(spec.bodies[bodies[k]].hull);
        afloat.push_back(hull_afloat(spec, at_rest.system(), at_rest.initial_state(),
                                     static_cast<std::size_t>(bodies[k]), meshes[k]));
        const double own = spec.bodies[bodies[k]].hydrodynamics.panel_length;
        if (own > 0.0 && (panel == 0.0 || own < panel)) panel = own;
      }
      try {
        set.hulls = panel_hulls(afloat);
        set.options = panel_options(spec.sea, spec.panel_method, panel);
        set.bands = planned_bands(set.hulls, set.options);
      } catch (const SpecificationError& error) {
        throw located(c, SpecificationError("bodies." + set.names.front() + ".hydrodynamics", "kind", error.what()));
      }
    }
    sets.push_back(std::move(set));
  }
  return sets;
}

void compute_set(const Case& c, HydroSet& set, const HydroProgress& progress) {
  const Clock::time_point begin = Clock::now();
  PanelMethodReport report;
  try {
    set.set = cached_panel_method(set.hulls, set.options, progress, &set.from_cache, &report);
  } catch (const SpecificationError& error) {
    throw located(c, SpecificationError("bodies." + set.names.front() + ".hydrodynamics", "kind", error.what()));
  }
  set.seconds = seconds_since(begin);
  if (set.from_cache) return;
  set.bands = report.bands;
  set.asymmetry = report.asymmetry;
}

void complete_sets(const Model& model, std::vector<HydroSet>& sets) {
  for (HydroSet& set : sets) {
    set.set = model.coefficients(set.bodies.front()).set;
    set.checks = self_checks(*set.set, model.specification().panel_method.tolerances);
    StateSpaceOptions options;
    options.tolerance = model.specification().panel_method.fit_tolerance;
    try {
      set.fit = fit_state_space(*set.set, options);
    } catch (const SpecificationError& error) {
      set.no_fit = error.what();
    }
  }
}

double largest_bytes(const HydroSet& set) {
  double bytes = 0.0;
  for (const PanelBand& band : set.bands)
    bytes = std::max(bytes, bytes_at_most(band, static_cast<int>(set.bodies.size())));
  return bytes;
}

double estimated_seconds(const HydroSet& set) {
  // In units of a floating point operation of a matrix product, from runs of boxes and spheres of 500 to 4000 panels.
  constexpr double kPair = 1500.0;  // influence of one panel on another with its image: logarithms and arc tangents
  double work = 0.0;
  for (const PanelBand& band : set.bands) {
    const double H = band.hull_panels, F = band.surface_panels, n = band.classes;
    // The images of a panel in the planes of symmetry serve all classes.
    work += n * kPair * (H + F) * (H + F);
    work += n * (8.0 / 3.0 * H * H * H + 2.0 * H * H * F + 2.0 * H * F * F);
    work += n * kUsualIterations * 4.0 * F * F * columns_of(band, static_cast<int>(set.bodies.size()));  // two products of complex columns
  }
  constexpr double kIdle = 1.6;  // threads wait for each other, and for memory
  return kIdle * work / (measured_speed() * omp_get_max_threads());
}

}  // namespace stillhook
