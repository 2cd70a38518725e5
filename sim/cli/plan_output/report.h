#pragma once

#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace assay::cli {

// The result of `assay check` for a file: a text for people, JSON for programs, and whether
// everything in the file holds.
struct Report {
  std::string text;
  std::shared_ptr<const nlohmann::ordered_json> json;  // an object
  bool holds = true;
};

}  // namespace assay::cli
