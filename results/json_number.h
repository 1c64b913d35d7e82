// Numbers in JSON, which knows no NaN: null stands for it.
#pragma once

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

namespace stillhook {

inline nlohmann::ordered_json json_number(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}

inline double number_of(const nlohmann::ordered_json& entry) {
  return entry.is_null() ? std::numeric_limits<double>::quiet_NaN() : entry.get<double>();
}

}  // namespace stillhook
