#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <chrono>
#include <cmath>
#include <fstream>
#include <iterator>
#include <numbers>

#include "planner/cli/commands.h"
#include "planner/cli/hydro_progress.h"
#include "planner/cli/interrupt.h"
#include "planner/cli/tables.h"
#include "planner/document_control.h"
#include "planner/hydro_report.h"
#include "planner/hydro_tables.h"
#include "planner/natural_periods.h"
#include "planner/run.h"
#include "planner/text_number.h"
#include "problems/case_document.h"
#include "results/files.h"
#include "sim/statics.h"

namespace stillhook {
namespace {

/// What a computation will take, before it begins.
void announce(const HydroSet& set, const std::string& what) {
  int hull = 0, surface = 0;
  for (const PanelBand& band : set.bands) {
    hull = std::max(hull, band.hull_panels);
    surface = std::max(surface, band.surface_panels);
  }
  spdlog::info(
      "{}: {} parts of the band {:.2f} to {:.2f} rad/s, up to {} panels on the hull and {} on the water, about {:.0f} "
      "MB "
      "and {} unless it is in the cache",
      what, set.bands.size(), set.bands.front().from, set.bands.back().to, hull, surface, largest_bytes(set) / 1e6,
      duration_text(std::max(1.0, estimated_seconds(set))));
}

/// Coefficients do not depend on what is done with the hulls: the case may lack an operation.
Case load_hulls(const CommonOptions& options) {
  std::ifstream in(options.input, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  if (!in.good() && text.empty()) return load_case(options);  // which says what is wrong with the file
  const Node root = parse_document(text, options.input);
  const Node* operation = root.find("operation");
  if (operation && operation->find("phases")) return load_case(options);
  const std::vector<Override> rest = {{"solver.max_duration_s", "1"}};  // a run without phases has to end somehow
  return operation ? load_case(options, rest) : load_case_text(options, text + "\n[operation]\n", rest);
}

class HydroRun {
 public:
  HydroRun(const CommonOptions& options, const HydroArguments& arguments)
      : options_(options), arguments_(arguments), stop_(catch_interrupts()), case_(load_hulls(options)) {}

  int run() {
    result_.sets = planned_sets(case_);
    if (result_.sets.empty())
      throw UsageError(
          options_.input +
          ": no body has hydrodynamics of kind \"panels\", \"table\" or \"database\"; there is nothing to do");
    const RunFolder folder(folder_path(options_, case_, "hydro"),
                           options_.force ? RunFolder::Mode::replace : RunFolder::Mode::fresh);
    for (HydroSet& set : result_.sets)
      if (set.panels) compute(set);
    const Model model = build();
    complete_sets(model, result_.sets);
    refine();
    respond(model);
    finish(model, folder);
    return kDone;
  }

 private:
  HydroProgress progress_for(Progress& bar, const std::string& what) {
    return [this, &bar, what](double share, const std::string& text) {
      bar.update(share, what + ": " + text);
      return !stop_.load();
    };
  }

  void compute(HydroSet& set) {
    announce(set, set.title());
    Progress bar = stderr_progress(options_.quiet);
    compute_set(case_, set, progress_for(bar, set.title()));
    bar.clear();
    spdlog::info("{}", origin_sentence(set));
  }

  Model build() {
    try {
      return build_model(case_.specification, panel_method_progress(options_.quiet, &stop_));
    } catch (const SpecificationError& error) {
      throw located(case_, error);
    }
  }

  void refine() {
    result_.convergence.resize(result_.sets.size());
    if (!arguments_.converge) return;
    for (std::size_t k = 0; k < result_.sets.size(); ++k) {
      const HydroSet& set = result_.sets[k];
      if (!set.panels) {
        spdlog::warn("{}: read from a file, there are no panels to refine", set.title());
        continue;
      }
      for (const HydroSet& other : convergence_sets(set))
        announce(other, fmt::format("{} with panels divided by {:.2f}", set.title(), other.options.refinement));
      Progress bar = stderr_progress(options_.quiet);
      result_.convergence[k].push_back(converge(case_, set, progress_for(bar, set.title())));
    }
  }

  void respond(const Model& model) {
    result_.warnings = model.warnings();
    std::vector<double> headings = usual_headings(model);
    if (!arguments_.headings.empty()) {
      headings.clear();
      for (const double heading : arguments_.headings) headings.push_back(heading * std::numbers::pi / 180.0);
    }
    result_.responses = response_curves(model, headings);
    result_.periods = period_tables(model, {{"start", model.initial_state()}});
  }

  void finish(const Model& model, const RunFolder& folder) {
    std::vector<std::string> files;
    write_or_refuse([&] { write_file(folder.case_file(), case_text(case_, statement_of(options_.input))); });
    for (const HydroSet& set : result_.sets)
      for (std::string& file : write_coefficient_files(folder.path(), model, set, result_.warnings))
        files.push_back(std::move(file));
    result_.wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
    write_or_refuse([&] { write_file(folder.report(), hydro_report(case_, result_, files, document_control(case_, date_, folder.case_file()))); });
    const std::string summary = hydro_summary(case_, result_, files, date_);
    write_or_refuse([&] { write_file(folder.summary(), summary); });  // last: its presence says that all is there
    print_warnings(result_.warnings);
    if (options_.json)
      fmt::print("{}", summary);
    else if (!options_.quiet)
      print(folder);
  }

  void print(const RunFolder& folder) const {
    fmt::print("{}: {}\n", case_.name, case_.title);
    for (std::size_t k = 0; k < result_.sets.size(); ++k) {
      const HydroSet& set = result_.sets[k];
      fmt::print("\n{}\n", origin_sentence(set));
      if (!set.bands.empty()) fmt::print("\n{}", table_text(panel_table(set)));
      for (const ReportTable& table : coefficient_tables(set)) fmt::print("\n{}", table_text(table));
      fmt::print("\n{}\n{}", table_text(check_table(set)),
                 set.fit ? table_text(fit_table(set)) : "No reduced model: " + set.no_fit + "\n");
      for (const Convergence& convergence : result_.convergence[k])
        fmt::print("\n{}", table_text(convergence_table(set, convergence)));
    }
    for (const ReportTable& table : result_.periods) fmt::print("\n{}", table_text(table));
    fmt::print("\nReport: {}\n", folder.report());
  }

  const CommonOptions& options_;
  const HydroArguments& arguments_;
  const std::atomic<bool>& stop_;
  std::string date_ = date_now();
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  Case case_;
  HydroResult result_;
};

}  // namespace

int run_hydro(const CommonOptions& options, const HydroArguments& arguments) {
  return HydroRun(options, arguments).run();
}

}  // namespace stillhook
