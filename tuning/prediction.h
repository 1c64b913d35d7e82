// What the model says a record should show, and its derivatives: one simulation of a record, from its beginning or of a
// segment of it.
#pragma once

#include <array>
#include <optional>

#include "problems/case.h"
#include "problems/tangent_run.h"
#include "tuning/record.h"
#include "tuning/start_state.h"

namespace stillhook {

/// A record and how it is simulated.
struct RecordModel {
  Case base;                      // the case as it was during the record
  MeasuredRecord data;
  std::vector<std::string> keys;  // of the fit's parameters, those that matter here ...
  std::vector<int> parameters;    // ... and which they are
  int body = -1;                  // whose start is estimated, -1 none
  std::vector<int> free;          // coordinates of DisplacedStart that are estimated
  std::vector<int> offsets;       // channels of the record whose zero is estimated

  int own() const { return static_cast<int>(free.size() + offsets.size()); }
  /// "roll of vessel at the start", "zero of vessel.roll".
  std::string own_name(int i) const;
  std::string own_unit(int i) const;
};

/// Simulated values at a record's samples.
struct Prediction {
  bool ok = false;
  std::string message;
  std::vector<VectorX> value;     // by channel
  std::vector<MatrixX> tangent;   // by channel: samples x (keys, own); empty if not asked for
};

/// The record's case: settings, sea, duration and output interval put in place. Throws CaseError.
Case record_case(const Case& c, const FitRecordSpec& spec);

/// Everything about a record of a case. Reads the file and builds the model once. Throws CaseError.
RecordModel record_model(const Case& c, const FitRecordSpec& spec);

/// The record's case with the keys at `values`.
Case case_at(const RecordModel& model, const VectorX& values);

/// Where a record's simulation begins.
struct RecordStart {
  std::optional<SystemState> from;  // absent: as the case does, derivatives included
  MatrixX by;  // of `from` by (keys, free); empty without derivatives
};
RecordStart record_start(const RecordModel& model, const Case& at, const VectorX& own, bool derivatives);

/// `values`: of the keys, in their units; `own`: of the record's own unknowns, SI. Throws CaseError when the lift cannot
/// be built with these values.
Prediction predict(const RecordModel& model, const VectorX& values, const VectorX& own, bool derivatives,
                   const RunOptions& options = {});

/// The record's own unknowns as its first samples show them, the rest zero; displacements are from the reference state.
VectorX own_start(const RecordModel& model, const VectorX& values);

/// Weights that turn simulated samples into values at other times, by cubic interpolation between four neighbours.
class Interpolation {
 public:
  Interpolation(const std::vector<double>& simulated, const std::vector<double>& wanted);
  /// False if the simulation ends before the last wanted time.
  bool complete() const { return complete_; }
  MatrixX operator()(const Eigen::Ref<const MatrixX>& samples) const;

 private:
  struct Weights {
    Eigen::Index first;
    std::array<double, 4> w;
  };
  std::vector<Weights> at_;
  bool complete_ = true;
};

}  // namespace stillhook
