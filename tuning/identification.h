// Estimating case keys from measured runs: from a case with a [fit] section to estimates with intervals, and what speaks
// against them. docs/fitting.md tells it to users.
#pragma once

#include <optional>

#include "problems/case.h"
#include "tuning/decay_start.h"
#include "tuning/fit.h"
#include "tuning/identifiability.h"

namespace stillhook {

struct FitEstimate {
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  FitParameterSpec spec;
  std::string unit;
  std::string started_from;  // "the case", "start", "the p-q line of <record>"
  double start = kNone, value = kNone;
  double sd = kNone, low = kNone, high = kNone;  // 95 %
  double white_sd = kNone;                       // if residuals were white
  bool at_bound = false;   // held there: no interval
  bool no_influence = false;
};

/// One of a record's own unknowns.
struct OwnEstimate {
  std::string name, unit;
  double value = 0.0, sd = 0.0;
};

struct ChannelFit {
  std::string channel, unit;
  std::vector<double> measured, before, after;  // by sample; NaN gaps; simulated at the start values and with the fit
  double sigma = 0.0;                           // weight of a sample: 1/sigma
  double rms_before = 0.0, rms_after = 0.0;     // of the residuals
  double explained = 0.0;                       // share of the variance
  double correlation_time = 1.0;                // samples per independent one
  int samples = 0, missing = 0, outliers = 0;
};

struct RecordFit {
  std::string name, file;
  FitRecordSpec::Kind kind = FitRecordSpec::Kind::decay;
  std::vector<double> time;  // s
  double interval = 0.0;     // s
  std::size_t rows = 0;
  std::vector<ChannelFit> channels;
  std::vector<OwnEstimate> own;
  std::vector<DecayComparison> decays;  // simulated: with the fit
};

/// A record predicted by a fit to the others, only its own beginning fitted.
struct LeftOut {
  std::string record;
  double ratio = 0.0;  // of its residual rms, to that of the fit to all
  std::vector<double> values;  // of the parameters, from the others
};

struct Identification {
  bool usable = false;    // there are estimates
  bool trusted = false;   // ... and the model explains the records
  bool interrupted = false;
  std::string message;    // how it ended, one sentence
  std::vector<FitEstimate> estimates;
  MatrixX correlation;    // of the estimates
  std::vector<Inseparable> inseparable;
  std::vector<RecordFit> records;
  std::vector<LeftOut> cross;
  std::vector<std::string> warnings;  // what speaks against the estimates, one sentence each
  std::vector<std::string> notes;     // what was done to the data
  int iterations = 0, simulations = 0;
  double wall = 0.0;  // s
};

struct IdentificationOptions {
  const std::atomic<bool>* stop = nullptr;
  std::function<void(const std::string& stage, int iteration, double cost)> progress;
};

/// Throws CaseError for a fit that cannot begin: no parameters, no records, data that are no run of this case, units that
/// are another's, a start that cannot be simulated.
Identification identify(const Case& c, const IdentificationOptions& options = {});

/// The case with the estimates in place.
Case fitted_case(const Case& c, const Identification& result);

}  // namespace stillhook
