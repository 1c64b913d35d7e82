#include "planner/cli/verb_run.h"

#include <fmt/format.h>

#include "planner/cli/interrupt.h"
#include "planner/document_control.h"
#include "results/files.h"

namespace stillhook {

VerbRun::VerbRun(std::string verb, const CommonOptions& options)
    : verb_(std::move(verb)),
      options_(options),
      begin_(std::chrono::steady_clock::now()),
      date_(date_now()),
      stop_(catch_interrupts()) {}

double VerbRun::wall() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
}

const RunFolder& VerbRun::open(const Case& c, std::optional<RunFolder::Mode> mode) {
  folder_.emplace(options_.out.empty() ? default_folder(c.name, verb_) : options_.out,
                  mode.value_or(options_.force ? RunFolder::Mode::replace : RunFolder::Mode::fresh));
  statement_ = statement_of(options_.input);
  return *folder_;
}

const RunFolder& VerbRun::open_named(const std::string& name) {
  folder_.emplace(options_.out.empty() ? default_folder(name, verb_) : options_.out,
                  options_.force ? RunFolder::Mode::replace : RunFolder::Mode::fresh);
  return *folder_;
}

DocumentControl VerbRun::control(const Case& c) const { return document_control(c, date_, folder().case_file()); }

void VerbRun::write(const std::string& path, const std::string& text) const {
  write_or_refuse([&] { write_file(path, text); });
}

void VerbRun::write_case(const std::string& path, const Case& c) const { write(path, case_text(c, statement_)); }

void VerbRun::conclude(const std::string& summary_json) const {
  write(folder().summary(), summary_json);
  if (options_.json) fmt::print("{}", summary_json);
}

}  // namespace stillhook
