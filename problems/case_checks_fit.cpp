#include <fmt/core.h>

#include "problems/case_checks.h"
#include "problems/case_key.h"

namespace stillhook {
namespace {

void check_parameter(const FitParameterSpec& p, const Node& root, Findings& findings) {
  const std::string entry = "fit.parameters." + as_step(p.key);
  check_varied_key({entry, p.key, p.lower, p.upper, p.start}, root, findings);
  if (p.prior_mean.has_value() != p.prior_sd.has_value())
    findings.add(position_of_key(root, entry, ""), entry, "", "needs prior_mean and prior_sd, or none of them");
}

void check_record(const FitRecordSpec& r, const Case& c, const Node& root, Findings& findings) {
  const std::string entry = "fit.records." + r.name;
  const auto report = [&](const std::string& key, const std::string& sentence) {
    findings.add(position_of_key(root, entry, key), entry, key, sentence);
  };
  if (r.start && r.end && !(*r.start < *r.end))
    report("start_s", fmt::format("must be < end_s {:.6g}, got {:.6g}", *r.end, *r.start));
  if (r.columns.empty()) report("columns", "must have at least one entry");
  if (!r.free.empty() && r.free_body.empty()) report("free", "needs free_body");
  const bool calm = r.kind == FitRecordSpec::Kind::decay || r.kind == FitRecordSpec::Kind::constant;
  if (!calm && r.sea.empty() && c.specification.sea.active.empty())
    report("kind", "needs the sea state of the run: give sea, or sea.active of the case");
}

}  // namespace

void check_fit(const Case& c, const Node& root, Findings& findings) {
  for (const FitParameterSpec& parameter : c.fit.parameters) check_parameter(parameter, root, findings);
  for (const FitRecordSpec& record : c.fit.records) check_record(record, c, root, findings);
}

}  // namespace stillhook
