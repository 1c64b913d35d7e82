#include "sim/hull/coefficient_source.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <mutex>
#include <sstream>

#include "sim/hull/coefficient_file.h"
#include "sim/hull/content_hash.h"
#include "sim/hull/damping_transform.h"
#include "sim/hull/database.h"
#include "sim/hull/file_stiffness.h"
#include "sim/hull/linear_froude_krylov.h"
#include "sim/hull/silent_modes.h"
#include "sim/hull/state_space_fit.h"

namespace stillhook {
namespace {

// Changes whenever the same input would give other numbers.
constexpr const char* kMethodVersion = "rankine 4";
constexpr const char* kMethodOfMeshes = "triangles to the diagonal";
constexpr const char* kMethodOfSeveral = "several hulls 2";  // the same for coupled hulls

using Set = std::shared_ptr<const HydrodynamicCoefficients>;

std::string key_of(const std::vector<PanelHull>& hulls, const PanelMethodOptions& o) {
  ContentHash hash;
  hash.add(std::string(kMethodVersion));
  if (hulls.size() > 1) {
    hash.add(std::string(kMethodOfSeveral));
    hash.add(o.gap_damping);
  }
  for (const double value : {o.density, o.gravity, o.lowest, o.highest, static_cast<double>(o.frequencies),
                             static_cast<double>(o.headings), o.refinement, o.panel_length})
    hash.add(value);
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

/// A file of the project's own format, read again only when it has changed: every model of a search asks for it.
Set read_table(const std::string& path) {
  struct Entry {
    std::filesystem::file_time_type time;
    Set set;
  };
  static std::mutex mutex;
  static std::map<std::string, Entry> known;
  const std::lock_guard lock(mutex);
  std::error_code error;
  const auto time = std::filesystem::last_write_time(path, error);
  const auto it = known.find(path);
  if (!error && it != known.end() && it->second.time == time) return it->second.set;
  return (known[path] = {time, std::make_shared<const HydrodynamicCoefficients>(without_noise(read_coefficient_file(path)))}).set;
}

Set read_file(const BodySpec& body, const HullAfloat& hull, const SeaSpec& sea) {
  const HydrodynamicsSpec& h = body.hydrodynamics;
  if (h.kind == HydrodynamicsSpec::Kind::table) return read_table(h.coefficient_file);
  const MeshProperties size = properties_of(*hull.mesh);
  DatabaseOptions options;
  // WAMIT's files hold no volume: that of the hull as it floats, so that only BEMIO's can differ from it.
  const double volume = LinearFroudeKrylov(*hull.mesh, hull.waterline, sea.density, sea.gravity).volume();
  const bool bemio = is_bemio(h.coefficient_file);
  if (bemio && !h.database_xbody.isZero())
    throw SpecificationError(h.coefficient_file, "",
                             "BEMIO files say themselves what their moments are about: leave database_xbody_m out");
  options.frame.bodies = {{h.database_origin, bemio ? 0.0 : volume}};
  options.frame.chosen = h.database_body;
  options.frame.axisymmetric = h.axisymmetric;
  options.frame.lowest = h.database_lowest;
  if (h.database_highest > 0.0) options.frame.highest = h.database_highest;
  options.frame.length = std::max(size.high.x() - size.low.x(), size.high.y() - size.low.y());
  options.frame.port_starboard = h.port_starboard;
  options.wamit.ulen = h.database_length;
  options.wamit.reference = {h.database_xbody};
  options.wamit.density = sea.density;
  options.wamit.gravity = sea.gravity;
  return std::make_shared<const HydrodynamicCoefficients>(without_noise(read_database(h.coefficient_file, options)));
}

std::string difference_from_hull(const HydrodynamicCoefficients& set, const HullAfloat& hull) {
  if (set.hulls() != 1 || set.stiffness.empty()) return {};
  return stiffness_difference(set, 0, *hull.mesh, hull.waterline, hull.body->cog);
}

/// K(t) of a causal, passive model that meets A(w) and B(w) with A_inf: the band ends where B has not died out, so the
/// transform of B alone would have to guess its tail; A - A_inf knows it (Kramers-Kronig). That such a model exists is
/// itself the check that A, B and A_inf belong together, and how far it is from them the self-check "kramers_kronig"
/// says. Where none is near, the transform stands in: what was computed is kept in any case.
RetardationFunctions causal_kernels(const HydrodynamicCoefficients& set) {
  constexpr double kInterval = 0.1, kDuration = 60.0;  // s
  StateSpaceOptions options;
  options.tolerance = 0.02;
  options.acceptable = 0.2;
  StateSpaceFit fit;
  try {
    fit = fit_state_space(set, options).fit;
  } catch (const SpecificationError&) {
    return retardation_from_damping(set.frequency, {kDuration, kInterval});
  }
  RetardationFunctions K;
  K.interval = kInterval;
  const int samples = static_cast<int>(std::lround(kDuration / kInterval)) + 1;
  std::vector<MatrixX> values;
  for (int m = 0; m < samples; ++m) values.push_back(fit.retardation(m * kInterval));
  for (int i = 0; i < set.modes(); ++i)
    for (int j = 0; j < set.modes(); ++j) {
      RetardationKernel kernel{i, j, {}};
      for (const MatrixX& value : values) kernel.value.push_back(value(i, j));
      if (std::any_of(kernel.value.begin(), kernel.value.end(), [](double v) { return v != 0.0; }))
        K.kernels.push_back(std::move(kernel));
    }
  return K;
}

std::vector<std::string> listed(const std::string& text) {
  std::vector<std::string> names(1);
  for (const char letter : text) {
    if (letter == ',')
      names.emplace_back();
    else if (letter != ' ')
      names.back() += letter;
  }
  std::erase(names, "");
  return names;
}

std::vector<std::string> accepted_failures(const HydrodynamicCoefficients& set, const std::string& accepted) {
  require_self_checks(set, listed(accepted));
  std::vector<std::string> failures;
  for (const SelfCheck& result : self_checks(set))
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

/// Once for each set: every model of a search has the same.
void check(const Set& set, const PanelMethodSpec& method, std::vector<std::string>& warnings) {
  struct Entry {
    std::weak_ptr<const HydrodynamicCoefficients> set;
    std::string accepted;
    std::vector<std::string> failures;
  };
  static std::mutex mutex;
  static std::vector<Entry> known;
  const std::lock_guard lock(mutex);
  std::erase_if(known, [](const Entry& entry) { return entry.set.expired(); });
  auto entry = std::find_if(known.begin(), known.end(), [&](const Entry& e) {
    return e.set.lock() == set && e.accepted == method.accepted_checks;
  });
  if (entry == known.end())
    entry = known.insert(known.end(), {set, method.accepted_checks, accepted_failures(*set, method.accepted_checks)});
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

PanelMethodOptions panel_options(const SeaSpec& sea, const PanelMethodSpec& method, double panel_length) {
  PanelMethodOptions options;
  options.density = sea.density;
  options.gravity = sea.gravity;
  options.lowest = method.lowest;
  options.highest = method.highest;
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
  if (kind == Kind::none || kind == Kind::constant) return nullptr;
  const char* field = kind == Kind::panels ? "kind" : "coefficient_file";
  try {
    double panel = 0.0;
    for (const HullAfloat& hull : hulls)
      if (const double own = hull.body->hydrodynamics.panel_length; own > 0.0 && (panel == 0.0 || own < panel))
        panel = own;
    Set set = kind == Kind::panels
                  ? cached_panel_method(panel_hulls(hulls), panel_options(sea, method, panel), progress, nullptr)
                  : read_file(body, hulls.front(), sea);
    warnings.insert(warnings.end(), set->remarks.begin(), set->remarks.end());
    if (const std::string difference = difference_from_hull(*set, hulls.front()); !difference.empty())
      warnings.push_back(difference);
    try {
      check(set, method, warnings);
    } catch (const SpecificationError& error) {
      if (kind != Kind::panels) throw;
      throw SpecificationError(error.entry, error.field,
                               std::string(error.what()).substr(error.entry.size() + 2) + finer_panels(method));
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
