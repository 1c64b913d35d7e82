// Multiple shooting: a record in segments, each simulated from a beginning of its own, which the measurement suggests and
// continuity ties to the end of the one before.
//
//   r = (z - y)/sigma in each segment      w (end of segment k - beginning of k+1)/s, s the spread of the beginnings
//
// Because no simulation runs long enough to lose the measured motion, a fit finds its way from start values from which
// whole simulations drift out of phase and leave it in a wrong minimum. (Bock 1983; Peifer & Timmer 2007)
#pragma once

#include "tuning/record_unit.h"

namespace stillhook {

class SegmentedRecord {
 public:
  /// The model must outlive it. Static pulls and records too short for segments of ten samples are refused (CaseError).
  SegmentedRecord(const RecordModel& model, int segments);

  /// Lays out the beginnings: simulated from the last, with what is measured put in place. Throws CaseError.
  void lay_out(const VectorX& values, const VectorX& own, const RunOptions& options);

  /// Adds a block for each beginning but the first, and a unit a segment. `parameters` must outlive the problem, as must
  /// this. `weight`: w.
  void add_to(FitProblem& problem, const FitParameters& parameters, const std::vector<double>& sigma, int own_block,
              double weight, const RunOptions& options) const;

  /// Takes the beginnings over from the solved problem, whose first block of this record was `first_block`.
  void take_from(const FitProblem& problem, int first_block);

  int segments() const { return static_cast<int>(times_.size()) - 1; }

 private:
  struct Part {
    RecordModel model;  // with the samples of the segment
    SampleIndex index;
    std::vector<std::size_t> sample;  // of the record, by sample of the segment
  };
  void scale_beginnings();

  const RecordModel& record_;
  std::vector<double> times_;        // s, of the beginnings, and the end
  std::vector<Part> parts_;
  std::vector<SystemState> begins_;  // [0] is not used
  VectorX spread_;
};

}  // namespace stillhook
