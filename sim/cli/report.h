#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace assay::cli {

// What `check` says about a file: for people, for programs, and whether everything in it holds.
struct Report {
  std::string text;
  nlohmann::ordered_json json;
  bool holds = true;
};

}  // namespace assay::cli
