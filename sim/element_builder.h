// From the entries of a specification to force elements: names resolved, fields handed over.
#pragma once

#include <memory>
#include <string>

#include "sim/model.h"

namespace stillhook {

/// Builds the elements of a model whose bodies stand at their initial pose. Every function throws SpecificationError.
class ElementBuilder {
 public:
  explicit ElementBuilder(const Model& model) : model_(model) {}

  /// A point given in the body's B (or in W for "world"), as the elements want it.
  BodyPoint point(const std::string& body, const Vector3& p_B) const;
  int drive_or_none(const std::string& name) const { return name.empty() ? -1 : model_.drive_index(name); }
  /// Distance of the ends of a wire now, m.
  double end_distance(const WireSpec& w) const;

  std::unique_ptr<const ForceElement> wire(const WireSpec& w, double unstretched_length) const;
  std::unique_ptr<const ForceElement> tagline(const TaglineSpec& t) const;
  std::unique_ptr<const ForceElement> mooring(const MooringSpec& m) const;
  std::unique_ptr<const ForceElement> restoring(const RestoringSpec& r) const;
  std::unique_ptr<const ForceElement> contact(const ContactSpec& c) const;
  std::unique_ptr<const ForceElement> ballast(const BallastSpec& b) const;

 private:
  const Specification& spec() const { return model_.specification(); }
  Instant now() const { return model_.initial_state().instant(); }
  int phase_index(const std::string& name, const std::string& entry) const;

  const Model& model_;
};

}  // namespace stillhook
