#include "planner/verbs/operability/operability_files.h"

#include <fmt/format.h>

#include <cmath>

#include "planner/verbs/operability/operability_tables.h"
#include "planner/version.h"
#include "results/files.h"
#include "results/json_number.h"
#include "results/netcdf_file.h"
#include "results/summary_envelope.h"

namespace stillhook {
namespace {

using Json = nlohmann::ordered_json;

/// The shortest form that reads back to the same number; nothing for NaN.
std::string csv_number(double value) { return std::isnan(value) ? "" : fmt::format("{}", value); }

std::string joined_flags(const OperabilityStudy& study, std::size_t task, std::size_t place) {
  return fmt::format("{}", fmt::join(flags_of(study, task, place), " "));
}

/// Arrays over the grid, filled cell by cell.
struct NetcdfLimits {
  std::vector<double> limit, low, high, gumbel, share, crossing, by_phase, by_limit;
  std::vector<int> governing, status, bound;
};

/// Bits of `status`, in the order of kFlags.
constexpr std::array<const char*, 8> kFlags = {"incomplete", "crashed", "not_certified",  "wide",
                                               "at_least",   "steep",   "breaks_at_once", "not_monotone"};

int status_bits(const OperabilityStudy& study, std::size_t task) {
  int bits = 0;
  for (const std::string& flag : flags_of(study, task, 0))
    for (std::size_t i = 0; i < kFlags.size(); ++i)
      if (flag == kFlags[i]) bits |= 1 << i;
  return bits;
}

int index_of_criterion(const OperabilityPlan& plan, const std::string& name) {
  for (std::size_t k = 0; k < plan.criteria.size(); ++k)
    if (plan.criteria[k].name == name) return static_cast<int>(k);
  return -1;
}

void add_cell(const OperabilityStudy& study, std::size_t task, NetcdfLimits& n) {
  const LimitingHeight& l = study.collected.columns[task].result.targets[0].limit;
  n.limit.push_back(l.height);
  n.low.push_back(l.low);
  n.high.push_back(l.high);
  n.gumbel.push_back(l.gumbel);
  n.share.push_back(l.governing_share);
  n.governing.push_back(index_of_criterion(study.plan(), l.governing));
  n.status.push_back(status_bits(study, task));
}

/// Values of targets from `first` on, [target][period][heading].
std::vector<double> target_heights(const OperabilityStudy& study, std::size_t first, std::size_t count) {
  std::vector<double> heights;
  for (std::size_t t = first; t < first + count; ++t)
    for (std::size_t p = 0; p < study.plan().peak_periods.size(); ++p)
      for (std::size_t h = 0; h < study.plan().headings.size(); ++h)
        heights.push_back(study.limit(p, h, t).limit.height);
  return heights;
}

void add_crossings(const OperabilityStudy& study, NetcdfLimits& n) {
  const std::size_t seeds = static_cast<std::size_t>(study.plan().rules.looks.back());
  for (std::size_t s = 0; s < seeds; ++s)
    for (std::size_t p = 0; p < study.plan().peak_periods.size(); ++p)
      for (std::size_t h = 0; h < study.plan().headings.size(); ++h) {
        const std::vector<SeedBracket>& all = study.limit(p, h).seeds;
        const bool run = s < all.size() && all[s].runs > 0;
        const bool found = run && all[s].found();
        n.crossing.push_back(found ? all[s].height() : run ? all[s].low : std::nan(""));
        n.bound.push_back(found ? 0 : run ? 1 : 2);
      }
}

class LimitsNetcdf {
 public:
  LimitsNetcdf(const OperabilityStudy& study, NetcdfFile& file) : study_(study), file_(file) {}

  void write() {
    const OperabilityPlan& plan = study_.plan();
    file_.attribute(NC_GLOBAL, "Conventions", "CF-1.8");
    file_.attribute(NC_GLOBAL, "title", "Limiting sea states of " + study_.campaign.lift.name);
    file_.attribute(NC_GLOBAL, "source", std::string("stillhook ") + kVersion);
    file_.attribute(NC_GLOBAL, "results_sha256", study_.collected.results_sha256);
    tp_ = file_.define_dimension("tp", plan.peak_periods.size());
    heading_ = file_.define_dimension("heading", plan.headings.size());
    phase_ = file_.define_dimension("phase", plan.phases.size());
    criterion_ = file_.define_dimension("limit", plan.criteria.size());
    seed_ = file_.define_dimension("seed", static_cast<std::size_t>(plan.rules.looks.back()));
    std::vector<double> headings;
    for (const double heading : plan.headings) headings.push_back(degrees_of(heading));
    numbers("tp", {tp_}, "peak period", "s", plan.peak_periods);
    numbers("heading", {heading_}, "direction that the waves travel towards, from +x counter-clockwise", "degree",
            headings);
    std::vector<std::string> names;
    for (const Criterion& k : plan.criteria) names.push_back(k.name);
    file_.put_texts("phase", phase_, "phase of the operation", plan.phases);
    file_.put_texts("limit", criterion_, "limit, or that the run completes", names);
    limits();
  }

 private:
  void limits() {
    const OperabilityPlan& plan = study_.plan();
    NetcdfLimits n;
    for (std::size_t p = 0; p < plan.peak_periods.size(); ++p)
      for (std::size_t h = 0; h < plan.headings.size(); ++h) add_cell(study_, study_.task_at(p, h), n);
    add_crossings(study_, n);
    const std::vector<int> grid = {tp_, heading_};
    numbers("hs_limit", grid, "limiting significant wave height", "m", n.limit);
    numbers("hs_low", grid, "its lower bound at 95 %", "m", n.low);
    numbers("hs_high", grid, "its upper bound at 95 %", "m", n.high);
    numbers("hs_gumbel", grid, "smooth estimate: Gumbel on 1/h by L-moments", "m", n.gumbel);
    numbers("governing_share", grid, "share of the governing limit among the seeds that break", "1", n.share);
    governing(n.governing);
    std::string flags;
    std::vector<int> masks;
    for (std::size_t i = 0; i < kFlags.size(); ++i) {
      flags += (flags.empty() ? "" : " ") + std::string(kFlags[i]);
      masks.push_back(1 << i);
    }
    const int status = integers("status", grid, "what the limit is not; 0 = nothing is amiss", n.status);
    file_.attribute(status, "flag_masks", masks);
    file_.attribute(status, "flag_meanings", flags);
    numbers("hs_by_phase", {phase_, tp_, heading_},
            "limiting height of a phase; at least that where only the lift's own "
            "limit was refined",
            "m", target_heights(study_, 1, plan.phases.size()));
    numbers("hs_by_limit", {criterion_, tp_, heading_}, "limiting height of one limit; likewise", "m",
            target_heights(study_, plan.places(), plan.criteria.size()));
    numbers("crossing", {seed_, tp_, heading_}, "height at which a seed first breaks a limit", "m", n.crossing);
    const int bound = integers("crossing_bound", {seed_, tp_, heading_}, "what the crossing is", n.bound);
    file_.attribute(bound, "flag_values", std::vector<int>{0, 1, 2});
    file_.attribute(bound, "flag_meanings", "found at_least not_run");
  }

  void governing(const std::vector<int>& values) {
    const int id = integers("governing", {tp_, heading_}, "limit that most seeds break first", values);
    std::vector<int> flags = {-1};
    std::string meanings = "none";
    for (std::size_t k = 0; k < study_.plan().criteria.size(); ++k) {
      std::string name = study_.plan().criteria[k].name;
      for (char& c : name)
        if (c == ' ') c = '_';
      flags.push_back(static_cast<int>(k));
      meanings += " " + name;
    }
    file_.attribute(id, "flag_values", flags);
    file_.attribute(id, "flag_meanings", meanings);
  }

  int numbers(const char* name, const std::vector<int>& dimensions, const char* meaning, const char* unit,
              const std::vector<double>& values) {
    const int id = file_.define(name, NC_DOUBLE, dimensions, meaning, unit, NetcdfFile::Storage::compressed);
    file_.put(id, values);
    return id;
  }

  int integers(const char* name, const std::vector<int>& dimensions, const char* meaning,
               const std::vector<int>& values) {
    const int id = file_.define(name, NC_INT, dimensions, meaning, "", NetcdfFile::Storage::compressed);
    file_.put(id, values);
    return id;
  }

  const OperabilityStudy& study_;
  NetcdfFile& file_;
  int tp_ = 0, heading_ = 0, phase_ = 0, criterion_ = 0, seed_ = 0;
};

Json column_json(const OperabilityStudy& study, std::size_t task) {
  const OperabilityColumn& column = study.plan().columns[task];
  const CollectedColumn& c = study.collected.columns[task];
  const LimitingHeight& l = c.result.targets[0].limit;
  Json json = {{"peak_period_s", column.peak_period},
               {"heading_deg", degrees_of(column.heading)},
               {"hs_limit_m", json_number(l.height)},
               {"hs_low_m", json_number(l.low)},
               {"hs_high_m", json_number(l.high)},
               {"governing", l.governing},
               {"governing_share", json_number(l.governing_share)},
               {"seeds", c.result.seeds},
               {"runs", c.parts.runs.size()},
               {"state", flags_of(study, task, 0)}};
  Json& phases = json["by_phase"] = Json::object();
  for (std::size_t place = 1; place < study.plan().places(); ++place)
    phases[place_name(study.plan(), place)] = {{"hs_limit_m", json_number(c.result.targets[place].limit.height)},
                                               {"at_least", c.result.targets[place].at_least}};
  return json;
}

}  // namespace

std::string operability_csv(const OperabilityStudy& study) {
  const OperabilityPlan& plan = study.plan();
  std::string out =
      "tp [s],heading [deg],phase,hs_limit [m],hs_low [m],hs_high [m],seeds [1],governing,share [1],status\n";
  for (std::size_t p = 0; p < plan.peak_periods.size(); ++p)
    for (std::size_t h = 0; h < plan.headings.size(); ++h)
      for (std::size_t place = 0; place < plan.places(); ++place) {
        const LimitingHeight& l = study.limit(p, h, place).limit;
        out += fmt::format("{},{},{},{},{},{},{},{},{},{}\n", csv_number(plan.peak_periods[p]),
                           csv_number(degrees_of(plan.headings[h])), place_name(plan, place), csv_number(l.height),
                           csv_number(l.low), csv_number(l.high), study.at(p, h).result.seeds, l.governing,
                           csv_number(l.governing_share), joined_flags(study, study.task_at(p, h), place));
      }
  return out;
}

void write_operability_netcdf(const OperabilityStudy& study, const std::string& path) {
  PendingFile pending(path);
  NetcdfFile file(pending.temporary(), NetcdfFile::Mode::create, path);
  LimitsNetcdf(study, file).write();
  file.close();
  pending.commit();
}

std::string operability_summary(const OperabilityStudy& study, const std::vector<std::string>& files,
                                const std::string& status, const std::string& date, double wall) {
  Json document = summary_envelope(kVersion, date, study.campaign.lift.name, "operability");
  document["status"] = status;
  document["message"] = operability_verdict(study);
  document["warnings"] = study.warnings;
  document["notes"] = study.notes;
  document["files"] = files;
  Json& o = document["operability"] = Json::object();
  o["level"] = study.plan().rules.level;
  o["certified"] = certified(study);
  o["runs"] = study.collected.runs;
  o["crashed"] = study.collected.crashed;
  o["repeated"] = study.collected.repeated;
  o["core_hours"] = study.collected.wall / 3600.0;
  o["wall_s"] = wall;
  o["hosts"] = study.collected.hosts;
  o["arithmetic"] = study.collected.arithmetic;
  o["results_sha256"] = study.collected.results_sha256;
  Json& columns = o["columns"] = Json::array();
  for (std::size_t task = 0; task < study.plan().columns.size(); ++task) columns.push_back(column_json(study, task));
  return summary_text(document);
}

}  // namespace stillhook
