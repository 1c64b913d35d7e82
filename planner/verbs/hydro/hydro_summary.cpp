#include <cmath>
#include <nlohmann/json.hpp>

#include "planner/verbs/hydro/hydro_files.h"
#include "planner/version.h"
#include "results/json_number.h"
#include "results/summary.h"
#include "sim/spatial/constants.h"
#include "results/summary_envelope.h"

namespace stillhook {
namespace {

using Json = nlohmann::ordered_json;

Json checks_json(const HydroSet& set) {
  Json checks = Json::array();
  for (const SelfCheck& check : set.checks)
    checks.push_back({{"key", check.key},
                      {"name", check.name},
                      {"value", json_number(check.value)},
                      {"limit", json_number(check.limit)},
                      {"pass", check.passed()},
                      {"detail", check.detail}});
  return checks;
}

Json fit_json(const HydroSet& set) {
  if (!set.fit) return {{"message", set.no_fit}};
  const StateSpaceReport& report = set.fit->report;
  Json fit = {{"data", report.data},
              {"from_rad_per_s", report.lowest},
              {"to_rad_per_s", report.highest},
              {"tolerance", report.tolerance},
              {"states", report.states},
              {"worst_r_squared", json_number(report.worst_r_squared())},
              {"blocks", Json::array()}};
  for (const StateSpaceBlockReport& block : report.blocks) {
    Json modes = Json::array();
    for (const int mode : block.modes) modes.push_back(set.mode_name(mode));
    fit["blocks"].push_back({{"modes", modes},
                             {"order", block.order},
                             {"passivity_margin", json_number(block.passivity_margin)},
                             {"margin_rad_per_s", json_number(block.margin_frequency)},
                             {"passivity_enforced", block.passivity_enforced}});
  }
  return fit;
}

Json panels_json(const HydroSet& set) {
  Json panels = Json::array();
  for (const PanelBand& band : set.bands)
    panels.push_back({{"from_rad_per_s", band.from},
                      {"to_rad_per_s", band.to},
                      {"frequencies", band.frequencies.size()},
                      {"hull", band.hull_panels},
                      {"surface", band.surface_panels},
                      {"classes", band.classes},
                      {"bytes", band.bytes}});
  return panels;
}

Json convergence_json(const HydroSet& set, const Convergence& convergence) {
  Json rows = Json::array();
  for (const ConvergenceRow& row : convergence.rows)
    rows.push_back({{"quantity", row.quantity},
                    {"mode", set.mode_name(row.mode)},
                    {"first_change", json_number(row.first)},
                    {"second_change", json_number(row.second)},
                    {"order", json_number(row.order)},
                    {"error", json_number(row.error)}});
  return {{"refinement", convergence.refinement},         {"hull_panels", convergence.hull_panels},
          {"surface_panels", convergence.surface_panels}, {"limit", Convergence::kLimit},
          {"worst_error", convergence.worst().error},     {"within_limit", convergence.within_limit()},
          {"conclusion", convergence.conclusion(set)},    {"rows", rows}};
}

Json rao_json(const ResponseCurves& curves) {
  Json headings = Json::array(), bodies = Json::array();
  for (const double heading : curves.headings) headings.push_back(heading / kDegree);
  static constexpr const char* kNames[6] = {"surge", "sway", "heave", "roll", "pitch", "yaw"};
  for (const BodyResponse& body : curves.bodies) {
    Json motions = Json::array();
    for (std::size_t h = 0; h < curves.headings.size(); ++h) {
      Json of_heading;
      for (int i = 0; i < 6; ++i) {
        Json amplitude = Json::array(), phase = Json::array();
        for (const ResponseAmplitude::Vector6c& value : body.value[h]) {
          amplitude.push_back(json_number(std::abs(value[i]) / (i < 3 ? 1.0 : kDegree)));
          phase.push_back(json_number(std::arg(value[i]) / kDegree));
        }
        of_heading[kNames[i]] = {{"amplitude", amplitude}, {"phase_deg", phase}};
      }
      motions.push_back(of_heading);
    }
    bodies.push_back(
        {{"body", body.name}, {"point_m", {body.point.x(), body.point.y(), body.point.z()}}, {"motions", motions}});
  }
  return {{"headings_deg", headings}, {"frequencies_rad_per_s", curves.frequencies}, {"bodies", bodies}};
}

Json periods_json(const std::vector<ReportTable>& tables) {
  Json periods = Json::array();
  for (const ReportTable& table : tables)
    periods.push_back({{"title", table.title}, {"header", table.header}, {"rows", table.rows}});
  return periods;
}

}  // namespace

std::string hydro_summary(const Case& c, const HydroResult& result, const std::vector<std::string>& files,
                          const std::string& date) {
  Json document = summary_envelope(kVersion, date, c.name, "hydro");
  document["status"] = "completed";
  document["wall_s"] = json_number(result.wall);
  document["warnings"] = result.warnings;
  document["files"] = files;
  Json& sets = document["sets"] = Json::array();
  for (std::size_t k = 0; k < result.sets.size(); ++k) {
    const HydroSet& set = result.sets[k];
    sets.push_back({{"bodies", set.names},
                    {"source", set.set->source},
                    {"description", set.set->description},
                    {"from_cache", set.from_cache},
                    {"seconds", json_number(set.seconds)},
                    {"waterline_m", set.set->waterline},
                    {"volume_m3", set.set->volume},
                    {"frequencies", set.set->frequency.size()},
                    {"asymmetry", json_number(set.asymmetry)},
                    {"checks", checks_json(set)},
                    {"fit", fit_json(set)},
                    {"panels", panels_json(set)}});
    if (!result.convergence[k].empty())
      sets.back()["convergence"] = convergence_json(set, result.convergence[k].front());
  }
  document["natural_periods"] = periods_json(result.periods);
  document["rao"] = rao_json(result.responses);
  return summary_text(document);
}

}  // namespace stillhook
