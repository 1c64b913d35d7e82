// What a fit tells: tables for the screen and for report.html, the page, summary.json.
#pragma once

#include "results/report.h"
#include "tuning/identification.h"

namespace stillhook {

/// Estimates with start, interval and bounds.
ReportTable estimate_table(const Identification& result);
/// Residuals of every channel of every record, before and after.
ReportTable residual_table(const Identification& result);
/// Periods and p-q lines of the decays; no rows without any.
ReportTable decay_table(const Identification& result);
/// No rows without any.
ReportTable cross_table(const Identification& result);

/// The verdict in one sentence.
std::string verdict_of(const Identification& result);

/// report.html. `files`: written beside it.
std::string fit_report(const Case& c, const Identification& result, const std::vector<std::string>& files,
                       const DocumentControl& control = {});

/// summary.json.
std::string fit_summary(const Case& c, const Identification& result, const std::vector<std::string>& files,
                        const std::string& date = "");

}  // namespace stillhook
