// The front door for programs that embed stillhook: read a lift, change keys of its case, add force elements of your own,
// simulate, look at series and metrics. Only types of the standard library
// appear; a force element of your own is written against "sim/multibody/force_element.h", with Eigen.
//
//   stillhook::Lift lift = stillhook::Lift::read("box_installation.toml");
//   lift.set("operation.phases.hoist_up.moves.hoist.speed_m_per_min", "3.0");
//   const stillhook::LiftRun run = lift.simulate();
//   std::cout << run.metric("daf_total") << " " << run.series("load.z").back() << "\n";
//
// Everything throws stillhook::Error (sim/error.h); what() is a sentence with file, line and key.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "sim/own_element.h"
#include "sim/error.h"

namespace stillhook {

/// A limit of the case, judged.
struct LiftLimit {
  std::string metric, unit;
  double value = 0.0, limit = 0.0;  // in `unit`
  bool kept = false;
  bool hard = true;  // a soft limit does not fail the lift
};

/// A simulated and judged lift. Copies share the run.
class LiftRun {
 public:
  /// It completed and kept every hard limit.
  bool passed() const;
  /// "completed", "failed", "diverged" or "interrupted", and why where there is a reason.
  std::string status() const;
  std::string message() const;
  std::vector<std::string> warnings() const;

  /// Instants of the samples, s.
  const std::vector<double>& time() const;
  /// Names of the recorded channels, e.g. "load.z", and the SI unit of one.
  std::vector<std::string> channels() const;
  std::string unit(const std::string& channel) const;
  /// A channel at the instants of time(), SI.
  std::vector<double> series(const std::string& channel) const;

  /// Value of a metric in the unit of the catalogue (docs/summary.md); NaN where this lift has none of that name.
  double metric(const std::string& name) const;
  std::map<std::string, double> metrics() const;
  std::vector<LiftLimit> limits() const;

  /// As `stillhook simulate` writes it, JSON.
  std::string summary() const;

 private:
  friend class Lift;
  struct Data;
  std::shared_ptr<const Data> data_;
};

class Lift {
 public:
  /// Reads and checks a case file.
  static Lift read(const std::string& path);
  /// The same from text; file names in it start at `directory`.
  static Lift parse(const std::string& text, const std::string& name, const std::string& directory = ".");

  /// Changes a key, as --set KEY=VALUE does; `value` is a TOML value in the unit of the key.
  void set(const std::string& key, const std::string& value);
  /// Value of a numeric key in its own unit.
  double value(const std::string& key) const;

  /// Adds an element of the embedding program to every model of this lift.
  void add(OwnElement element);

  /// Builds the model, which may compute coefficients of hulls for minutes the first time, and simulates the operation.
  /// `progress` hears the time and the planned end, s; false interrupts.
  LiftRun simulate(const std::function<bool(double t, double t_end)>& progress = {}) const;

 private:
  Lift() = default;
  struct Data;
  std::shared_ptr<const Data> data_;
  std::vector<OwnElement> own_;
};

/// The version of the library, "0.2.0".
std::string library_version();

}  // namespace stillhook
