#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <numbers>

#include "planner/cli/tables.h"
#include "planner/cli/verb_run.h"
#include "planner/run.h"
#include "planner/text_number.h"
#include "planner/verbs/check/natural_periods.h"
#include "planner/verbs/hydro/hydro_report.h"
#include "planner/verbs/hydro/hydro_tables.h"
#include "planner/verbs/verbs.h"
#include "problems/case_document.h"
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
  HydroRun(const CommonOptions& options, bool converge, const std::vector<double>& headings)
      : verb_("hydro", options), converge_(converge), headings_(headings), case_(load_hulls(options)) {}

  int run() {
    result_.sets = planned_sets(case_);
    if (result_.sets.empty())
      throw UsageError(
          verb_.options().input +
          ": no body has hydrodynamics of kind \"panels\", \"table\" or \"database\"; there is nothing to do");
    const RunFolder& folder = verb_.open(case_);
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
      return !verb_.stop().load();
    };
  }

  void compute(HydroSet& set) {
    announce(set, set.title());
    Progress bar = verb_.progress();
    compute_set(case_, set, progress_for(bar, set.title()));
    bar.clear();
    spdlog::info("{}", origin_sentence(set));
  }

  Model build() {
    try {
      return build_model(case_.specification, verb_.panel_progress());
    } catch (const SpecificationError& error) {
      throw located(case_, error);
    }
  }

  void refine() {
    result_.convergence.resize(result_.sets.size());
    if (!converge_) return;
    for (std::size_t k = 0; k < result_.sets.size(); ++k) {
      const HydroSet& set = result_.sets[k];
      if (!set.panels) {
        spdlog::warn("{}: read from a file, there are no panels to refine", set.title());
        continue;
      }
      for (const HydroSet& other : convergence_sets(set))
        announce(other, fmt::format("{} with panels divided by {:.2f}", set.title(), other.options.refinement));
      Progress bar = verb_.progress();
      result_.convergence[k].push_back(converge(case_, set, progress_for(bar, set.title())));
    }
  }

  void respond(const Model& model) {
    result_.warnings = model.warnings();
    std::vector<double> headings = usual_headings(model);
    if (!headings_.empty()) {
      headings.clear();
      for (const double heading : headings_) headings.push_back(heading * std::numbers::pi / 180.0);
    }
    result_.responses = response_curves(model, headings);
    result_.periods = period_tables(model, {{"start", model.initial_state()}});
  }

  void finish(const Model& model, const RunFolder& folder) {
    std::vector<std::string> files;
    verb_.keep_case(case_);
    for (const HydroSet& set : result_.sets)
      for (std::string& file : write_coefficient_files(folder.path(), model, set, result_.warnings))
        files.push_back(std::move(file));
    result_.wall = verb_.wall();
    verb_.write(folder.report(), hydro_report(case_, result_, files, verb_.control(case_)));
    verb_.conclude(hydro_summary(case_, result_, files, verb_.date()));
    print_warnings(result_.warnings);
    if (verb_.prints()) print(folder);
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

  VerbRun verb_;
  bool converge_;
  const std::vector<double>& headings_;
  Case case_;
  HydroResult result_;
};

class HydroVerb final : public Verb {
 public:
  std::string name() const override { return "hydro"; }
  std::string help() const override {
    return "Hydrodynamic coefficients of the hulls and the lift's response to waves: tables, files, report";
  }
  void add_options(VerbOptions& o) override {
    o.add_case();
    o.add_folder();
    o.add({"--converge", &converge_, "", "Compute with longer and shorter panels too; print the change"});
    o.add({.name = "--headings",
           .target = &headings_,
           .operand = "DEG",
           .help =
               "Directions in deg the waves of the response amplitude operators travel towards, e.g. 180,90 (default: "
               "head, bow quartering and beam seas of the first hull)",
           .range = std::pair(-360.0, 360.0),
           .delimiter = ','});
  }
  int run(const CommonOptions& options) override { return HydroRun(options, converge_, headings_).run(); }
  std::vector<RunFile> files() const override {
    return {{"coefficients-*.csv", "Coefficients of a hull, as a case takes them."},
            {"coefficients-*.h5", "The same for BEMIO."},
            {"coefficients-*.1", "The same for WAMIT: added mass and damping,"},
            {"coefficients-*.3", "excitation,"},
            {"coefficients-*.hst", "and hydrostatic stiffness."}};
  }

 private:
  bool converge_ = false;
  std::vector<double> headings_;  // deg; empty = usual ones
};

}  // namespace

std::unique_ptr<Verb> hydro_verb() { return std::make_unique<HydroVerb>(); }

}  // namespace stillhook
