// What `stillhook fit` is asked: which case keys are unknown, and what was measured.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace stillhook {

/// A case key to be estimated. Numbers in the unit of the key.
struct FitParameterSpec {
  std::string key;  // as in plan.variables; "*" moves several entries together
  double lower = 0.0, upper = 0.0;
  std::optional<double> start;               // absent: from a decay's p-q line, else the case's own value
  std::optional<double> prior_mean, prior_sd;  // what is known beforehand, normal
};

/// A column of a measured file and the channel of the simulation that it shows.
struct FitColumnSpec {
  std::string channel;  // of trajectory.h
  std::string column;   // name in the file
  std::string unit;     // of the file
  bool reversed = false;  // positive in the file is negative here
  double offset = 0.0;    // in the file's unit, taken off before the sign is turned
  bool estimate_offset = false;
  std::optional<double> noise;  // standard deviation in the file's unit; absent: from the residuals
  bool trust_unit = false;      // no refusal when the size looks like another unit's
};

/// A change of the case for one record, as by --set.
struct FitSettingSpec {
  std::string key, value;
};

/// One measured run.
struct FitRecordSpec {
  enum class Kind { decay, regular, irregular, constant };
  std::string name;
  std::string file;  // resolved path; empty = given on the command line
  Kind kind = Kind::decay;
  std::string sea;  // sea state; empty = calm water for decay and static, else sea.active
  std::string time_column = "t_s";
  double time_unit = 1.0;            // s per unit of the time column
  std::optional<double> time_shift;  // s at full scale, added to the record's time to give the simulation's
  std::optional<double> start, end;  // s, window in simulated time
  double settle = 0.0;               // s, simulated before the window counts
  double model_scale = 1.0;          // full scale / model, by Froude; 1 = the file is at full scale
  std::optional<double> interval;    // s, of the samples compared; absent: solver.output_interval
  std::string free_body;             // body whose initial state is estimated; empty = none
  std::string free;                  // which of it, with commas in between: x ... yaw, vx ... wz; empty = all
  std::vector<FitColumnSpec> columns;
  std::vector<FitSettingSpec> settings;
};

struct FitSpec {
  enum class Shooting { single, multiple };
  std::vector<FitParameterSpec> parameters;
  std::vector<FitRecordSpec> records;
  Shooting shooting = Shooting::single;
  int segments = 12;         // of each record, multiple shooting
  double robust = 2.5;       // standard deviations beyond which a residual counts linearly (Huber)
  int iterations = 50;       // of each solve
  bool cross_validate = true;
  double explained = 0.5;    // share of a channel's variance that the model must explain for the fit to be trusted
};

}  // namespace stillhook
