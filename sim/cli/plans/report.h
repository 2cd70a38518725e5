#pragma once

#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace assay::cli {

// What `check` says about a file: for people, for programs, and whether everything in it holds.
struct Report {
  std::string text;
  std::shared_ptr<const nlohmann::ordered_json> json;  // an object
  bool holds = true;
};

}  // namespace assay::cli
