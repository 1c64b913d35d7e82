#include "planner/verbs/check/sea_tables.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "planner/text_number.h"
#include "results/sea_words.h"
#include "sim/crane_parts.h"
#include "sim/hull/coefficients/coefficients.h"
#include "sim/hull/hydrostatics.h"
#include "sim/sea/dispersion.h"
#include "sim/sea/sea_statistics.h"
#include "sim/sea/spectrum.h"
#include "sim/spatial/constants.h"

namespace stillhook {
namespace {

/// The vessel from whose bow directions are told: that of the operation, else the first that floats; -1 if none does.
int first_vessel(const Model& model) {
  const Specification& spec = model.specification();
  for (const std::string& name : operation_vessels(spec)) return model.body_index(name);
  for (std::size_t i = 0; i < spec.bodies.size(); ++i)
    if (spec.bodies[i].floats() || spec.bodies[i].moved_by_sea()) return static_cast<int>(i);
  return -1;
}

/// rad/s, the lowest of the highest frequencies of all coefficient sets; infinite without one.
double end_of_coefficients(const Model& model) {
  double end = std::numeric_limits<double>::infinity();
  const std::vector<BodySpec>& bodies = model.specification().bodies;
  for (std::size_t i = 0; i < bodies.size(); ++i)
    if (bodies[i].floats())
      if (const auto set = model.coefficients(static_cast<int>(i)).set; set && !set->excitation.empty())
        end = std::min(end, set->excitation.frequencies.back());
  return end;
}

/// In %, of waves shorter than those of deep water at `end` (rad/s).
double share_beyond(const SeaStateSpec& state, const SeaSpec& sea, double end) {
  double all = 0.0, beyond = 0.0;
  const WaveField waves = build_wave_field(state, sea.gravity, 0.0, sea.wave_depth());
  for (const WaveComponent& c : waves.components()) {
    all += c.amplitude * c.amplitude;
    if (c.wavenumber > end * end / sea.gravity * (1.0 + 1e-9)) beyond += c.amplitude * c.amplitude;
  }
  return all > 0.0 ? 100.0 * beyond / all : 0.0;
}

ReportTable parts_table(const Model& model, const SeaStateSpec& state) {
  const SeaSpec& sea = model.specification().sea;
  const int vessel = first_vessel(model);
  const double end = end_of_coefficients(model);
  ReportTable table;
  table.title = "Sea";
  table.note =
      "Of the spectra; H: height of a regular wave. Towards: mean direction of travel, from +x, counter-clockwise. "
      "Spread: circular. Beyond: share "
      "of "
      "the energy in waves shorter than the hulls' coefficients know.";
  table.header = {"waves",      "Hs m",    "Tp s", "T01 s", "Tz s", "towards deg", "seen from the bow",
                  "spread deg", "beyond %"};
  const std::vector<SeaStatistics> all = sea_statistics(state);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const SeaStatistics& s = all[i];
    const bool whole = i + 1 == all.size();
    const SeaStateSpec of = whole ? state : part_of(state, static_cast<int>(i));
    std::string from = "-";
    if (vessel >= 0)
      from = direction_in_words(s.heading -
                                roll_pitch_yaw(model.initial_state().body[static_cast<std::size_t>(vessel)].R_WB).yaw);
    double towards = s.heading / kDegree;
    if (towards < -1e-9) towards += 360.0;
    const bool regular = of.type == SeaStateSpec::Type::regular;
    const std::string height = regular ? "H " + cell(2.0 * of.amplitude, 2) : cell(s.significant_height, 2);
    table.rows.push_back({whole && all.size() > 1 ? "together" : s.name, height, cell(s.peak_period, 1),
                          cell(s.mean_period, 1), cell(s.zero_crossing_period, 1), cell(towards, 0), from,
                          cell(s.spread / kDegree, 1), std::isinf(end) ? "-" : cell(share_beyond(of, sea, end), 1)});
  }
  return table;
}

ReportTable bed_table(const SeaSpec& sea, const SeaStateSpec& state, const WaveField& waves) {
  ReportTable table;
  table.title = "Waves over the bed";
  table.note = sea.deep_waves ? "The water is " + cell(sea.depth, 1) +
                                    " m deep; the waves are those of deep water all the same (sea.deep_waves)."
                              : "The water is " + cell(sea.depth, 1) +
                                    " m deep. kh: depth times 2 pi over the length; from pi on waves are as in deep "
                                    "water.";
  table.header = {"wave", "period s", "length m", "kh", "group velocity m/s", "water"};
  const double depth = sea.wave_depth();
  double lowest = std::numeric_limits<double>::infinity(), highest = 0.0;
  for (const WaveComponent& c : waves.components()) {
    lowest = std::min(lowest, c.frequency);
    highest = std::max(highest, c.frequency);
  }
  const double peak = kTwoPi / sea_statistics(state).back().peak_period;
  for (const auto& [name, w] :
       {std::pair("at Tp", peak), std::pair("longest", lowest), std::pair("shortest", highest)}) {
    const double k = wave_number(w, sea.gravity, depth), kh = k * sea.depth;
    table.rows.push_back({name, cell(kTwoPi / w, 1), cell(kTwoPi / k, 1), cell(kh, 2),
                          cell(group_velocity(w, sea.gravity, depth), 2),
                          kh > std::numbers::pi ? "deep"
                          : sea.deep_waves      ? "taken as deep"
                                                : "feels the bed"});
  }
  return table;
}

ReportTable clearance_table(const Model& model) {
  const Specification& spec = model.specification();
  ReportTable table;
  table.title = "Keel clearance";
  table.note = "At the start, in still water.";
  table.header = {"body", "lowest point m", "above the bed m"};
  for (std::size_t i = 0; i < spec.bodies.size(); ++i) {
    const BodySpec& body = spec.bodies[i];
    if (!body.floats()) continue;
    const BodyKinematics& k = model.initial_state().body[i];
    double low = std::numeric_limits<double>::infinity();
    for (const Vector3& v : build_hull_mesh(body.hull).vertices)
      low = std::min(low, (k.p_WC + k.R_WB * (v - body.cog)).z());
    table.rows.push_back({body.name, cell(low, 2), cell(low + spec.sea.depth, 2)});
  }
  return table;
}

}  // namespace

std::vector<ReportTable> sea_tables(const Model& model) {
  const SeaSpec& sea = model.specification().sea;
  const SeaStateSpec* state = sea.active_state();
  if (!state || model.waves().calm()) return {};
  std::vector<ReportTable> tables = {parts_table(model, *state)};
  if (!(sea.depth > 0.0)) return tables;
  tables.push_back(bed_table(sea, *state, model.waves()));
  if (ReportTable table = clearance_table(model); !table.rows.empty()) tables.push_back(std::move(table));
  return tables;
}

}  // namespace stillhook
