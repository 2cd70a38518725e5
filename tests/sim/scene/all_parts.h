#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "tests/sim/scene/peg_and_block.h"

namespace assay::scene {

// Returns the sorted names of all part models.
inline std::vector<std::string> AllParts() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(ModelsFolder() / "parts")) {
    if (exists(entry.path() / "part.yaml")) names.push_back(entry.path().filename().string());
  }
  std::ranges::sort(names);
  return names;
}

}  // namespace assay::scene
