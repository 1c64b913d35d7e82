#include "sim/hull/coefficients/coefficient_source.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <mutex>
#include <sstream>

#include "sim/hull/coefficients/coefficient_file.h"
#include "sim/hull/coefficients/content_hash.h"
#include "sim/hull/coefficients/database_band.h"
#include "sim/hull/coefficients/database_frame.h"
#include "sim/hull/coefficients/database_source.h"
#include "sim/hull/coefficients/file_stiffness.h"
#include "sim/hull/coefficients/sea_band.h"
#include "sim/hull/linear_froude_krylov.h"
#include "sim/hull/radiation/causal_kernels.h"
#include "sim/hull/silent_modes.h"
#include "sim/spatial/constants.h"

namespace stillhook {
namespace {

// Changes whenever the same input would give other numbers.
constexpr const char* kMethodVersion = "rankine 5";
constexpr const char* kMethodOfMeshes = "triangles to the diagonal";
constexpr const char* kMethodOfSeveral = "several hulls 3";  // the same for coupled hulls
constexpr const char* kMethodOverBed = "flat bed 1";         // the same in water of finite depth

// rad/s, of an automatic band: of deep water; over a bed, where B_33 falls as w alone and K has a long tail.
constexpr double kLowest = 0.2, kLowestOverBed = 0.1;

using Set = std::shared_ptr<const HydrodynamicCoefficients>;

std::string key_of(const std::vector<PanelHull>& hulls, const PanelMethodOptions& o) {
  ContentHash hash;
  hash.add(std::string(kMethodVersion));
  if (hulls.size() > 1) {
    hash.add(std::string(kMethodOfSeveral));
    hash.add(o.gap_damping);
  }
  for (const double value : {o.density, o.gravity, o.lowest, o.highest, static_cast<double>(o.frequencies),
                             static_cast<double>(o.headings), o.refinement, o.panel_length, o.sea_highest})
    hash.add(value);
  if (std::isfinite(o.depth)) {
    hash.add(std::string(kMethodOverBed));
    hash.add(o.depth);
  }
  for (const PanelHull& hull : hulls) {
    hash.add(hull.waterline);
    hash.add(hull.box_size);
    hash.add(hull.box_centre);
    if (!(hull.box_size.minCoeff() > 0.0)) hash.add(std::string(kMethodOfMeshes));
    for (const Vector3& vertex : hull.mesh.vertices) hash.add(vertex);
    for (const auto& triangle : hull.mesh.triangles) hash.add(triangle.data(), sizeof triangle);
    if (hulls.size() == 1) break;
    hash.add(Vector3(hull.x, hull.y, hull.yaw));
  }
  return hash.text();
}

/// The set as it reads back from a file of `folder`, under its name when the folder is the cache.
Set stored(const HydrodynamicCoefficients& set, const std::filesystem::path& file) {
  namespace fs = std::filesystem;
  std::error_code error;
  if (!file.empty()) {
    fs::create_directories(file.parent_path(), error);
    try {
      write_coefficient_file(file.string(), set);
      return std::make_shared<const HydrodynamicCoefficients>(read_coefficient_file(file.string()));
    } catch (const SpecificationError&) {
      // No place to keep it: by way of a temporary file the numbers are the same.
    }
  }
  const fs::path scratch = fs::temp_directory_path() / ("stillhook-" + std::to_string(getpid()) + ".csv");
  write_coefficient_file(scratch.string(), set);
  Set result = std::make_shared<const HydrodynamicCoefficients>(read_coefficient_file(scratch.string()));
  fs::remove(scratch, error);
  return result;
}

double rounded_draft(double waterline) { return kDraftStep * std::round(waterline / kDraftStep); }

std::string difference_from_hull(const HydrodynamicCoefficients& set, const HullAfloat& hull) {
  if (set.hulls() != 1 || set.stiffness.empty()) return {};
  return stiffness_difference(set, 0, *hull.mesh, hull.waterline, hull.body->cog);
}

std::vector<std::string> accepted_failures(const HydrodynamicCoefficients& set, const PanelMethodSpec& method) {
  require_self_checks(set, listed_checks(method.accepted_checks), method.tolerances);
  std::vector<std::string> failures;
  for (const SelfCheck& result : self_checks(set, method.tolerances))
    if (!result.passed()) {
      std::ostringstream sentence;
      sentence << set.source << ": the self-check \"" << result.key << "\" fails (" << result.value << ", at most "
               << result.limit << "; " << result.detail << ") and is accepted by name";
      failures.push_back(sentence.str());
    }
  return failures;
}

/// How a set that fails a self-check is computed better, and what that costs.
std::string finer_panels(const PanelMethodSpec& method) {
  std::ostringstream sentence;
  sentence.precision(3);
  sentence << "; finer panels compute it better: panel_method.refinement = " << 1.4 * method.refinement
           << " takes about four times the time and the memory";
  if (method.headings > 0) sentence << ", and panel_method.headings = 0 as many headings as the waves need";
  return sentence.str();
}

std::string gap_warning(const std::string& body, const HydrodynamicCoefficients& set) {
  std::ostringstream sentence;
  sentence.precision(3);
  sentence << body << ": resonance of the gap: the water between the hulls rises " << set.gap_rise
           << " times a hull's motion at " << set.gap_frequency
           << " rad/s, a height that potential theory exaggerates";
  return sentence.str();
}

/// A set of water with a bed serves no other depth.
void require_depth(const HydrodynamicCoefficients& set, const SeaSpec& sea) {
  const double depth = sea.wave_depth();
  if (std::isinf(set.depth) || std::abs(depth / set.depth - 1.0) <= kSameDepth) return;
  std::ostringstream sentence;
  sentence << "holds for water " << set.depth << " m deep, ";
  if (std::isinf(depth))
    sentence << "the waves of the case are those of deep water" << (sea.deep_waves ? " (sea.deep_waves)" : "");
  else
    sentence << "sea.depth_m is " << depth << " m, more than " << 100.0 * kSameDepth << " % off";
  sentence << ": the depths must be the same, or the coefficients those of deep water";
  throw SpecificationError(set.source, "", sentence.str());
}

/// Once for each set: every model of a search has the same.
void check(const Set& set, const PanelMethodSpec& method, std::vector<std::string>& warnings) {
  struct Entry {
    std::weak_ptr<const HydrodynamicCoefficients> set;
    std::string accepted;
    SelfCheckTolerances tolerances;
    std::vector<std::string> failures;
  };
  static std::mutex mutex;
  static std::vector<Entry> known;
  const std::lock_guard lock(mutex);
  std::erase_if(known, [](const Entry& entry) { return entry.set.expired(); });
  auto entry = std::find_if(known.begin(), known.end(), [&](const Entry& e) {
    return e.set.lock() == set && e.accepted == method.accepted_checks && e.tolerances == method.tolerances;
  });
  if (entry == known.end())
    entry = known.insert(known.end(),
                         {set, method.accepted_checks, method.tolerances, accepted_failures(*set, method)});
  warnings.insert(warnings.end(), entry->failures.begin(), entry->failures.end());
}

}  // namespace

std::string cache_folder() {
  for (const auto& [variable, below] : {std::pair{"STILLHOOK_CACHE", ""}, std::pair{"XDG_CACHE_HOME", "stillhook"},
                                        std::pair{"HOME", ".cache/stillhook"}}) {
    const char* value = std::getenv(variable);
    if (value && *value) return (std::filesystem::path(value) / below).string();
  }
  return {};
}

double reference_height(std::span<const HullAfloat> hulls, const HullAfloat& hull) {
  return rounded_draft(hull.waterline) - rounded_draft(hulls.front().waterline);
}

std::vector<PanelHull> panel_hulls(std::span<const HullAfloat> hulls) {
  std::vector<PanelHull> result;
  for (const HullAfloat& hull : hulls) {
    PanelHull p;
    p.name = hull.body->name;
    p.mesh = *hull.mesh;
    if (hull.body->hull.shape == HullSpec::Shape::box) {
      p.box_size = hull.body->hull.size;
      p.box_centre = hull.body->hull.centre;
    }
    p.waterline = rounded_draft(hulls.front().waterline);
    const double lift = reference_height(hulls, hull);
    for (Vector3& vertex : p.mesh.vertices) vertex.z() -= lift;
    p.box_centre.z() -= lift;
    // Where coupled hulls lie is rounded too.
    p.x = kDraftStep * std::round(hull.x / kDraftStep);
    p.y = kDraftStep * std::round(hull.y / kDraftStep);
    p.yaw = 1e-3 * std::round(hull.yaw / 1e-3);
    result.push_back(std::move(p));
  }
  return result;
}

double panel_depth(const SeaSpec& sea, const PanelMethodSpec& method) {
  const double lowest = method.lowest > 0.0 ? method.lowest : kLowest;
  const double longest = kTwoPi * sea.gravity / (lowest * lowest), depth = sea.wave_depth();
  return depth >= longest ? std::numeric_limits<double>::infinity() : depth;
}

PanelMethodOptions panel_options(const SeaSpec& sea, const PanelMethodSpec& method, double panel_length) {
  PanelMethodOptions options;
  options.density = sea.density;
  options.gravity = sea.gravity;
  options.depth = panel_depth(sea, method);
  options.lowest = method.lowest > 0.0 ? method.lowest : std::isinf(options.depth) ? kLowest : kLowestOverBed;
  options.highest = method.highest;
  options.sea_highest = method.highest > 0.0 ? 0.0 : highest_of_seas(sea);
  options.frequencies = method.frequencies;
  options.headings = method.headings;
  options.refinement = method.refinement;
  options.panel_length = panel_length;
  options.memory = 1e9 * method.memory;
  return options;
}

Set cached_panel_method(const std::vector<PanelHull>& hulls, const PanelMethodOptions& options,
                        const HydroProgress& progress, bool* from_cache, PanelMethodReport* report) {
  static std::mutex mutex;
  static std::map<std::string, Set> known;
  // One computation at a time: whoever asks for the same set meanwhile gets this one.
  const std::lock_guard lock(mutex);
  const std::string key = key_of(hulls, options);
  if (from_cache) *from_cache = true;
  if (const auto it = known.find(key); it != known.end()) return it->second;
  std::filesystem::path file;
  if (const std::string folder = cache_folder(); !folder.empty())
    file = std::filesystem::path(folder) / ("hull-" + key + ".csv");
  std::error_code error;
  if (!file.empty() && std::filesystem::exists(file, error)) {
    try {
      return known[key] = std::make_shared<const HydrodynamicCoefficients>(read_coefficient_file(file.string()));
    } catch (const SpecificationError&) {
      // Not what was written: computed anew and replaced.
      std::filesystem::remove(file, error);
    }
  }
  if (from_cache) *from_cache = false;
  HydrodynamicCoefficients set = panel_method(hulls, options, report, progress);
  set.retardation = causal_kernels(set);
  return known[key] = stored(set, file);
}

Set coefficient_set(std::span<const HullAfloat> hulls, const SeaSpec& sea, const PanelMethodSpec& method,
                    std::vector<std::string>& warnings, const HydroProgress& progress) {
  using Kind = HydrodynamicsSpec::Kind;
  const BodySpec& body = *hulls.front().body;
  const Kind kind = body.hydrodynamics.kind;
  if (kind == Kind::none || kind == Kind::constant || kind == Kind::rao) return nullptr;
  const char* field = kind == Kind::panels ? "kind" : "coefficient_file";
  try {
    double panel = 0.0;
    for (const HullAfloat& hull : hulls)
      if (const double own = hull.body->hydrodynamics.panel_length; own > 0.0 && (panel == 0.0 || own < panel))
        panel = own;
    Set set = kind == Kind::panels
                  ? cached_panel_method(panel_hulls(hulls), panel_options(sea, method, panel), progress, nullptr)
                  : file_set(hulls.front(), sea);
    require_depth(*set, sea);
    warnings.insert(warnings.end(), set->remarks.begin(), set->remarks.end());
    if (const std::string difference = difference_from_hull(*set, hulls.front()); !difference.empty())
      warnings.push_back(difference);
    if (kind == Kind::database)
      if (const std::string difference = draft_difference(*set, hulls.front()); !difference.empty())
        warnings.push_back(difference);
    try {
      check(set, method, warnings);
    } catch (const SpecificationError& error) {
      const std::string remedy =
          kind == Kind::panels ? finer_panels(method) : database_remedy(*set, hulls.front(), sea, method);
      throw SpecificationError(error.entry, error.field,
                               std::string(error.what()).substr(error.entry.size() + 2) + remedy);
    }
    if (set->gap_rise > kGapResonance) warnings.push_back(gap_warning(body.name, *set));
    if (set->hulls() != static_cast<int>(hulls.size()))
      throw SpecificationError(set->source, "", "holds the coefficients of several hulls, one body needs those of one");
    return set;
  } catch (const SpecificationError& error) {
    throw SpecificationError(entry_of(body), field, error.what());
  }
}

}  // namespace stillhook
