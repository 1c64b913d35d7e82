// Where a force element of an embedding program joins a model: what it may ask while it is made.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "sim/spatial/pose.h"

namespace stillhook {

class ForceElement;
class Model;
class WaveField;
struct BodyPoint;
struct Specification;

/// A model whose bodies stand at their initial pose and whose drives are known.
class ElementSite {
 public:
  explicit ElementSite(const Model& model) : model_(model) {}

  int body(const std::string& name) const;   // index; kWorld for "world". Throws SpecificationError if unknown
  int drive(const std::string& name) const;  // index. Throws SpecificationError if unknown
  /// A point given in the body's B (in W for "world"), as the library's own elements want it.
  BodyPoint point(const std::string& body, const Vector3& p_B) const;
  const Specification& specification() const;
  /// The sea, which lives as long as the model; an element that looks at it keeps the pointer.
  std::shared_ptr<const WaveField> waves() const;

 private:
  const Model& model_;
};

/// Makes a force element for the model being built. Called once for every model, from any thread.
using OwnElement = std::function<std::unique_ptr<const ForceElement>(const ElementSite& site)>;

}  // namespace stillhook
