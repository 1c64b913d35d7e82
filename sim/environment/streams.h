// The wind and the current of a lift, as its elements ask for them.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "sim/environment/stream.h"

namespace stillhook {

class ElementSite;
struct Specification;

/// Throws SpecificationError("wind").
std::shared_ptr<const Stream> wind_at(const ElementSite& site);
/// Throws SpecificationError("sea.current").
std::shared_ptr<const Stream> current_at(const ElementSite& site);

/// What a reader must know of the current beside the waves: one above 5 % of their phase speed at the peak changes them
/// noticeably, which is left out. Sentences.
std::vector<std::string> current_notes(const Specification& specification);

}  // namespace stillhook
