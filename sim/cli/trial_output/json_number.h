#pragma once

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

namespace assay::cli {

// Returns null for numbers that JSON cannot hold: missing ones and infinite ones.
inline nlohmann::ordered_json OrNull(const std::optional<double>& value) {
  return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
}
inline nlohmann::ordered_json OrNull(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}

}  // namespace assay::cli
