// A force element that a program which embeds the library adds to a lift.
#pragma once

#include <functional>
#include <memory>

namespace stillhook {

class ElementSite;
class ForceElement;

/// Makes a force element for the model being built. Called once for every model, from any thread.
using OwnElement = std::function<std::unique_ptr<const ForceElement>(const ElementSite& site)>;

}  // namespace stillhook
