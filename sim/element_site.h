// Where a force element joins a model: what it may ask while it is made.
#pragma once

#include <memory>
#include <string>

#include "sim/spatial/pose.h"

namespace stillhook {

class Model;
class WaveField;
struct BodyPoint;
struct Instant;
struct Specification;

/// A model whose bodies stand at their initial pose and whose drives are known.
class ElementSite {
 public:
  explicit ElementSite(const Model& model) : model_(model) {}

  int body(const std::string& name) const;   // index; kWorld for "world". Throws SpecificationError if unknown
  int drive(const std::string& name) const;  // index. Throws SpecificationError if unknown
  /// The same for a name that may be empty: -1 then.
  int drive_or_none(const std::string& name) const;
  /// Index of the phase with which an element begins to act, 0 when none is named. `entry` names the element in what is
  /// thrown (SpecificationError) if there is no such phase.
  int first_phase(const std::string& name, const std::string& entry) const;
  /// A point given in the body's B (in W for "world"), as the library's own elements want it.
  BodyPoint point(const std::string& body, const Vector3& p_B) const;
  /// Distance of two such points at the initial pose, m.
  double distance(const BodyPoint& a, const BodyPoint& b) const;
  /// Unstretched length of a wire at the start of the run, m.
  double initial_length(const std::string& wire) const;
  /// The bodies and drives at the initial pose.
  Instant now() const;
  const Specification& specification() const;
  /// The sea, which lives as long as the model; an element that looks at it keeps the pointer.
  std::shared_ptr<const WaveField> waves() const;

 private:
  const Model& model_;
};

}  // namespace stillhook
