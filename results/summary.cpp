#include "results/summary.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "results/files.h"
#include "results/json_number.h"
#include "results/summary_envelope.h"

namespace stillhook {
namespace {

using Json = nlohmann::ordered_json;

Json metrics_json(const Metrics& metrics) {
  Json all = Json::object();
  for (const Metric& m : metrics.items)
    all[m.name] = {
        {"value", json_number(m.value)}, {"unit", m.unit}, {"time", json_number(m.time)}, {"phase", m.phase}};
  for (const Metric& m : metrics.items) {
    if (!m.scenario.empty()) all[m.name]["scenario"] = m.scenario;
    for (const PhaseValue& here : m.by_phase) all[m.name]["by_phase"][here.phase] = json_number(here.value);
  }
  return all;
}

Json limits_json(const std::vector<LimitCheck>& checks) {
  Json all = Json::array();
  for (const LimitCheck& c : checks)
    all.push_back({{"name", c.metric},
                   {"unit", c.unit},
                   {"sense", c.is_max ? "max" : "min"},
                   {"value", json_number(c.value)},
                   {"limit", json_number(c.limit)},
                   {"margin", json_number(c.margin)},
                   {"time", json_number(c.time)},
                   {"phase", c.phase},
                   {"hard", c.hard},
                   {"pass", c.pass},
                   {"source", c.source}});
  for (std::size_t i = 0; i < checks.size(); ++i)
    if (!checks[i].scenario.empty()) all[i]["scenario"] = checks[i].scenario;
  return all;
}

void add_search(const Summary& summary, Json& document) {
  if (summary.objective)
    document["objective"] = {{"baseline", json_number(summary.objective->baseline)},
                             {"plan", json_number(summary.objective->plan)},
                             {"random_search", json_number(summary.objective->random_search)}};
  if (summary.search)
    document["search"] = {{"algorithm", summary.search->algorithm},
                          {"evaluations", summary.search->evaluations},
                          {"simulation_equivalents", json_number(summary.search->simulation_equivalents)},
                          {"seed", summary.search->seed}};
  if (summary.variables.empty()) return;
  Json& variables = document["variables"] = Json::array();
  for (const VariableSummary& v : summary.variables)
    variables.push_back({{"name", v.name},
                         {"lower", json_number(v.lower)},
                         {"upper", json_number(v.upper)},
                         {"baseline", json_number(v.baseline)},
                         {"plan", json_number(v.plan)}});
}

Json mean_json(const MeanSummary& m) {
  return {{"mean", json_number(m.mean)}, {"low", json_number(m.low)}, {"high", json_number(m.high)}};
}

Json certificate_json(const CertificateSummary& c) {
  Json out = {{"conditions", c.conditions},
              {"completed", c.completed},
              {"baseline_completed", c.baseline_completed},
              {"objective", {{"plan", mean_json(c.plan)}, {"baseline", mean_json(c.baseline)}}},
              {"improvement", mean_json(c.improvement)},
              {"terms", Json::array()},
              {"limits", Json::array()}};
  for (const CertificateSummary::Term& t : c.terms)
    out["terms"].push_back(
        {{"name", t.name}, {"unit", t.unit}, {"plan", mean_json(t.plan)}, {"baseline", mean_json(t.baseline)}});
  for (const CertificateSummary::Limit& l : c.limits)
    out["limits"].push_back({{"name", l.name},
                             {"broken", l.broken},
                             {"baseline_broken", l.baseline_broken},
                             {"share_at_most", json_number(l.share_at_most)},
                             {"allowed", json_number(l.allowed)}});
  return out;
}

Json pareto_json(const ParetoSummary& p) {
  Json out = {{"first", p.first}, {"second", p.second}, {"points", Json::array()}};
  for (const ParetoSummary::Point& point : p.points) {
    Json variables = Json::array();
    for (const double v : point.variables) variables.push_back(json_number(v));
    out["points"].push_back({{"first", json_number(point.first)},
                             {"second", json_number(point.second)},
                             {"on_front", point.on_front},
                             {"within_limits", point.within_limits},
                             {"variables", variables}});
  }
  return out;
}

}  // namespace

std::string status_name(RunStatus status) {
  switch (status) {
    case RunStatus::completed:
      return "completed";
    case RunStatus::interrupted:
      return "interrupted";
    case RunStatus::diverged:
      return "diverged";
    case RunStatus::failed:
      return "failed";
    case RunStatus::not_run:
      break;
  }
  return "not_run";
}

Summary summarise(const Specification& specification, const Trajectory& trajectory, const Metrics& metrics,
                  const std::vector<LimitCheck>& limits) {
  Summary summary;
  summary.case_name = specification.name;
  summary.sea = specification.sea.active;
  summary.status = metrics.status;  // the trajectory knows whether it ran to its end, the metrics whether a lift would
  summary.message = metrics.message;
  if (!trajectory.phases.empty()) summary.simulated = trajectory.phases.back().end - trajectory.phases.front().start;
  summary.wall = trajectory.wall;
  summary.metrics = metrics;
  summary.limits = limits;
  return summary;
}

std::string summary_json(const Summary& summary) {
  Json document = summary_envelope(summary.program_version, summary.date, summary.case_name, summary.verb);
  document["sea"] = summary.sea;
  document["status"] = status_name(summary.status);
  document["message"] = summary.message;
  document["warnings"] = summary.warnings;
  document["within_limits"] = within_limits(summary.metrics, summary.limits);
  const LimitCheck* governing = governing_check(summary.limits);
  document["governing"] = governing ? Json(governing->metric) : Json(nullptr);
  document["simulated_s"] = json_number(summary.simulated);
  document["wall_s"] = json_number(summary.wall);
  document["real_time_factor"] = json_number(summary.simulated / summary.wall);
  document["metrics"] = metrics_json(summary.metrics);
  document["limits"] = limits_json(summary.limits);
  add_search(summary, document);
  if (summary.certificate) document["certificate"] = certificate_json(*summary.certificate);
  if (summary.pareto) document["pareto"] = pareto_json(*summary.pareto);
  return summary_text(document);
}

void write_summary(const Summary& summary, const std::string& path) { write_file(path, summary_json(summary)); }

}  // namespace stillhook
