#include "sim/hull/coefficients/database_source.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <list>
#include <mutex>
#include <sstream>
#include <stdexcept>

#include "sim/hull/coefficients/coefficient_file.h"
#include "sim/hull/coefficients/database.h"
#include "sim/hull/coefficients/database_band.h"
#include "sim/hull/felt_depth.h"
#include "sim/hull/linear_froude_krylov.h"
#include "sim/hull/radiation/causal_kernels.h"
#include "sim/hull/silent_modes.h"
#include "sim/number_text.h"

namespace stillhook {
namespace {

namespace fs = std::filesystem;
using FileSet = std::shared_ptr<const HydrodynamicCoefficients>;

constexpr std::size_t kKeptSets = 16;
constexpr double kSameVolume = 0.02;

/// Everything that the reading of a database depends on, but the files' contents.
DatabaseOptions options_of(const HullAfloat& hull, const SeaSpec& sea) {
  const HydrodynamicsSpec& h = hull.body->hydrodynamics;
  const auto refuse = [&](const char* sentence) { throw SpecificationError(h.coefficient_file, "", sentence); };
  const bool bemio = is_bemio(h.coefficient_file);
  if (bemio && !h.database_xbody.isZero())
    refuse("BEMIO files say themselves what their moments are about: leave database_xbody_m out");
  if (bemio && h.database_depth > 0.0)
    refuse("BEMIO files say themselves how deep the water was: leave database_depth_m out");
  if (bemio && h.database_in_frequency)
    refuse("BEMIO files have frequencies in rad/s: leave database_first_column out");
  DatabaseOptions options;
  double volume = 0.0;
  if (!bemio) {
    // WAMIT's files hold no volume: that of the hull below their still water.
    try {
      volume = LinearFroudeKrylov(*hull.mesh, -h.database_origin.z(), sea.density, sea.gravity).volume();
    } catch (const MeshError&) {
      refuse(
          "the hull has nothing below the still water of the database, its z = 0: is database_origin_m, the place of "
          "the body's origin in the frame of the database, right?");
    }
  }
  const MeshProperties size = properties_of(*hull.mesh);
  options.frame.bodies = {{h.database_origin, volume}};
  options.frame.chosen = h.database_body;
  options.frame.axisymmetric = h.axisymmetric;
  options.frame.lowest = h.database_lowest;
  options.frame.depth = sea.wave_depth();
  if (h.database_highest > 0.0) options.frame.highest = h.database_highest;
  options.frame.length = std::max(size.high.x() - size.low.x(), size.high.y() - size.low.y());
  options.frame.port_starboard = h.port_starboard;
  options.frame.without_retardation = true;
  options.wamit.ulen = h.database_length;
  options.wamit.reference = {h.database_xbody};
  if (h.database_in_frequency) options.wamit.column = WamitUnits::Column::frequency;
  if (h.database_depth > 0.0) options.wamit.depth = h.database_depth;
  options.wamit.density = sea.density;
  options.wamit.gravity = sea.gravity;
  return options;
}

HydrodynamicCoefficients read_fresh(const HullAfloat& hull, const DatabaseOptions& options) {
  const HydrodynamicsSpec& h = hull.body->hydrodynamics;
  if (h.kind == HydrodynamicsSpec::Kind::table) return without_noise(read_coefficient_file(h.coefficient_file));
  HydrodynamicCoefficients set = without_noise(read_database(h.coefficient_file, options));
  if (!set.retardation.empty()) return set;
  try {
    set.retardation = causal_kernels(set);
  } catch (const std::invalid_argument& error) {
    throw SpecificationError(set.source, "", error.what());
  }
  return set;
}

/// The files of a set and how they are now, with all that is asked of them.
std::string key_of_file(const HullAfloat& hull, const DatabaseOptions& o) {
  const HydrodynamicsSpec& h = hull.body->hydrodynamics;
  std::ostringstream key;
  key.precision(17);
  for (const std::string& path : database_files(h.coefficient_file)) {
    std::error_code error;
    const auto time = fs::last_write_time(path, error);
    if (error) continue;
    key << path << '\n' << time.time_since_epoch().count() << ' ' << fs::file_size(path, error) << '\n';
  }
  key << static_cast<int>(h.kind);
  if (h.kind == HydrodynamicsSpec::Kind::table) return key.str();
  const DatabaseFrame& f = o.frame;
  const WamitUnits& w = o.wamit;
  key << ' ' << f.bodies[0].origin.transpose() << ' ' << f.bodies[0].volume << ' ' << f.chosen << ' ' << f.axisymmetric
      << ' ' << f.lowest << ' ' << f.highest << ' ' << f.depth << ' ' << f.length << ' ' << f.port_starboard << ' '
      << w.ulen << ' ' << w.reference[0].transpose() << ' ' << static_cast<int>(w.column) << ' ' << w.depth << ' '
      << w.density << ' ' << w.gravity;
  return key.str();
}

std::string depth_sentence(const HydrodynamicCoefficients& set, const HydrodynamicsSpec& h) {
  if (!is_wamit(h.coefficient_file) || h.database_depth > 0.0) return {};
  const std::optional<double> depth = felt_depth(set);
  if (!depth) return {};
  std::ostringstream sentence;
  sentence.precision(2);
  sentence << "B(3,3) and X(3) in the longest waves belong together as in water about " << *depth
           << " m deep, and the waves here are those of deep water: if the files were computed with a bottom, "
              "database_depth_m says how deep it was";
  return sentence.str();
}

}  // namespace

FileSet file_set(const HullAfloat& hull, const SeaSpec& sea) {
  struct Kept {
    std::string key;
    FileSet set;
  };
  static std::mutex mutex;
  static std::list<Kept> kept;  // the last used first
  const bool database = hull.body->hydrodynamics.kind == HydrodynamicsSpec::Kind::database;
  const DatabaseOptions options = database ? options_of(hull, sea) : DatabaseOptions{};
  // One at a time: whoever asks for the same files meanwhile gets what is read now.
  const std::lock_guard lock(mutex);
  const std::string key = key_of_file(hull, options);
  if (const auto found = std::ranges::find(kept, key, &Kept::key); found != kept.end()) {
    kept.splice(kept.begin(), kept, found);
    return kept.front().set;
  }
  HydrodynamicCoefficients set = read_fresh(hull, options);
  if (database)
    if (const std::string sentence = depth_sentence(set, hull.body->hydrodynamics); !sentence.empty())
      set.remarks.push_back(set.source + ": " + sentence);
  kept.push_front({key, std::make_shared<const HydrodynamicCoefficients>(std::move(set))});
  if (kept.size() > kKeptSets) kept.pop_back();
  return kept.front().set;
}

std::string draft_difference(const HydrodynamicCoefficients& set, const HullAfloat& hull) {
  if (set.hulls() != 1) return {};
  double afloat = 0.0;
  try {
    afloat = LinearFroudeKrylov(*hull.mesh, hull.waterline, set.density, set.gravity).volume();
  } catch (const MeshError&) {
    return {};  // out of the water: its own sentence says so
  }
  if (std::abs(afloat / set.volume[0] - 1.0) <= kSameVolume) return {};
  return set.source + ": the coefficients hold for a displaced volume of " + number_text(set.volume[0]) +
         " m3, with the still water at z = " + number_text(set.waterline) + " m of the body; '" + hull.body->name +
         "' floats with " + number_text(afloat) + " m3, the water at z = " + number_text(hull.waterline) + " m";
}

std::string database_remedy(const HydrodynamicCoefficients& set, const HullAfloat& hull, const SeaSpec& sea,
                            const PanelMethodSpec& method) {
  const HydrodynamicsSpec& h = hull.body->hydrodynamics;
  if (h.kind != HydrodynamicsSpec::Kind::database) return {};
  std::string remedy = passing_band(set, method);
  if (const std::string depth = depth_sentence(set, h); !depth.empty()) remedy += "; " + depth;
  if (!is_wamit(h.coefficient_file)) return remedy;
  DatabaseOptions other = options_of(hull, sea);
  const bool frequency = other.wamit.column == WamitUnits::Column::frequency;
  other.wamit.column = frequency ? WamitUnits::Column::period : WamitUnits::Column::frequency;
  try {
    if (passes_checks(read_fresh(hull, other), method))
      remedy +=
          std::string("; with database_first_column = \"") + (frequency ? "period" : "frequency") + "\" they pass";
  } catch (const SpecificationError&) {
    // No reading of it.
  }
  return remedy;
}

}  // namespace stillhook
