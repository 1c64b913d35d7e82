#include <fmt/format.h>
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>

#include "planner/cli/commands.h"
#include "planner/cli/hydro_progress.h"
#include "planner/cli/interrupt.h"
#include "planner/cli/tables.h"
#include "planner/pose_files.h"
#include "planner/run.h"
#include "planner/static_tables.h"
#include "planner/version.h"

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

}  // namespace

int run_check(const CommonOptions& options, const CheckArguments& arguments) {
  const std::atomic<bool>& stop = catch_interrupts();
  const Case c = load_case(options);
  const PreparedRun prepared = prepare_run(c, c.specification, panel_method_progress(options.quiet, &stop));
  print_warnings(prepared.warnings);
  std::vector<std::string> drawings;
  if (!arguments.draw.empty())
    drawings = write_pose_drawings(prepared.model, prepared.operation, arguments.draw, options.force);
  std::vector<ReportTable> tables = static_tables(prepared.model, prepared.operation);
  tables.push_back(phase_table(prepared.model, prepared.operation));
  if (options.json) {
    nlohmann::ordered_json document = {{"schema_version", Summary::kSchemaVersion},
                                       {"case", c.name},
                                       {"verb", "check"},
                                       {"program_version", kVersion},
                                       {"duration_s", prepared.operation.planned_duration()},
                                       {"warnings", prepared.warnings},
                                       {"drawings", drawings},
                                       {"tables", nlohmann::ordered_json::array()}};
    for (const ReportTable& table : tables) document["tables"].push_back(table_json(table));
    fmt::print("{}\n", document.dump(2));
    return kDone;
  }
  if (options.quiet) return kDone;
  fmt::print("{}: {}\n", c.name, c.title);
  for (const ReportTable& table : tables) fmt::print("\n{}", table_text(table));
  if (!drawings.empty()) fmt::print("\nDrawn: {}\n", fmt::join(drawings, ", "));
  fmt::print("\nThe operation takes {:.0f} s without waiting for events. The case is valid.\n",
             prepared.operation.planned_duration());
  return kDone;
}

}  // namespace stillhook
