// What a tuning of gains tells: tables for the screen and for report.html, the page.
#pragma once

#include "results/report.h"
#include "results/summary.h"
#include "tuning/gains.h"

namespace stillhook {

/// One sentence: what was gained, or that the gains of the case stay.
std::string tuning_verdict(const GainTuning& result);
/// The gains before and after, in their keys' units.
ReportTable gain_table(const Evaluator& evaluator, const GainTuning& result);
/// The terms of the objective before and after.
ReportTable tuning_objective_table(const Evaluator& evaluator, const GainTuning& result);
/// Damping ratio of each swing without taglines, with the case's gains and with the tuned ones.
ReportTable swing_table(const GainTuning& result);
/// Which part of the operation was tuned for; empty: all of it.
std::string tuning_scope(const Evaluator& evaluator);
/// Whether gains over the fall length are worth having; empty if the case does not ask.
std::string schedule_verdict(const GainTuning& result);
/// The factors of the schedule; no rows if there is none.
ReportTable schedule_table(const GainTuning& result);
/// Winches that cannot follow, and what they would have to do.
ReportTable winch_table(const GainTuning& result);

/// `warnings`: what must be known before the numbers are used.
std::string tuning_report(const Evaluator& evaluator, const GainTuning& result, const DocumentControl& control = {},
                          const std::vector<std::string>& warnings = {});
Summary tuning_summary(const Evaluator& evaluator, const GainTuning& result, double wall);

}  // namespace stillhook
