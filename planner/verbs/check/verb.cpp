#include <fmt/format.h>
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>

#include "planner/cli/tables.h"
#include "planner/cli/verb_run.h"
#include "planner/run.h"
#include "planner/verbs/check/pose_files.h"
#include "planner/verbs/check/rigging_table.h"
#include "planner/verbs/check/static_tables.h"
#include "planner/verbs/verbs.h"
#include "planner/version.h"
#include "results/summary_envelope.h"

namespace stillhook {
namespace {

nlohmann::ordered_json cell_json(const std::string& text) {
  if (text.empty() || text == "-") return nullptr;
  std::size_t used = 0;
  try {
    const double value = std::stod(text, &used);
    if (used == text.size()) return value;
  } catch (const std::logic_error&) {
    // Not a number: the text itself.
  }
  return text;
}

nlohmann::ordered_json table_json(const ReportTable& table) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const std::vector<std::string>& row : table.rows) {
    nlohmann::ordered_json cells = nlohmann::ordered_json::array();
    for (std::size_t i = 0; i < row.size(); ++i)
      cells.push_back(i == 0 ? nlohmann::ordered_json(row[i]) : cell_json(row[i]));
    rows.push_back(cells);
  }
  return {{"title", table.title}, {"note", table.note}, {"header", table.header}, {"rows", rows}};
}

std::string check_json(const Case& c, const PreparedRun& prepared, const std::string& date,
                       const std::vector<std::string>& drawings, const std::vector<ReportTable>& tables) {
  nlohmann::ordered_json document = summary_envelope(kVersion, date, c.name, "check");
  document["duration_s"] = prepared.operation.planned_duration();
  document["warnings"] = prepared.warnings;
  document["drawings"] = drawings;
  document["tables"] = nlohmann::ordered_json::array();
  for (const ReportTable& table : tables) document["tables"].push_back(table_json(table));
  return summary_text(document);
}

void print_check(const Case& c, const PreparedRun& prepared, const std::vector<std::string>& drawings,
                 const std::vector<ReportTable>& tables) {
  fmt::print("{}: {}\n", c.name, c.title);
  for (const ReportTable& table : tables) fmt::print("\n{}", table_text(table));
  if (!drawings.empty()) fmt::print("\nDrawn: {}\n", fmt::join(drawings, ", "));
  fmt::print("\nThe operation takes {:.0f} s without waiting for events. The case is valid.\n",
             prepared.operation.planned_duration());
}

class CheckVerb final : public Verb {
 public:
  std::string name() const override { return "check"; }
  std::string help() const override {
    return "Validate a case; print poses, drafts, natural periods, wires, phases; draw it";
  }
  void add_options(VerbOptions& o) override {
    o.add_case();
    o.add_threads();
    o.add({"--draw", &draw_, "FILE",
           "Draw the start pose, elevation and plan, into FILE.svg; into a folder: every pose"});
    o.add_force("Replace drawings that exist");
  }
  int run(const CommonOptions& options) override {
    const VerbRun verb(name(), options);
    const Case c = load_case(options);
    const PreparedRun prepared = prepare_run(c, c.specification, verb.panel_progress());
    print_warnings(prepared.warnings);
    std::vector<std::string> drawings;
    if (!draw_.empty()) drawings = write_pose_drawings(prepared.model, prepared.operation, draw_, options.force);
    std::vector<ReportTable> tables = static_tables(prepared.model, prepared.operation);
    for (ReportTable& table : rigging_tables(c)) tables.push_back(std::move(table));
    tables.push_back(phase_table(prepared.model, prepared.operation));
    if (options.json) fmt::print("{}", check_json(c, prepared, verb.date(), drawings, tables));
    if (verb.prints()) print_check(c, prepared, drawings, tables);
    return kDone;
  }

 private:
  std::string draw_;  // FILE.svg or a folder; empty = no drawing
};

}  // namespace

std::unique_ptr<Verb> check_verb() { return std::make_unique<CheckVerb>(); }

}  // namespace stillhook
