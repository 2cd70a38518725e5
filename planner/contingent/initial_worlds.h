#pragma once

#include <compare>
#include <cstdint>
#include <vector>

#include "planner/contingent/ground_task.h"

namespace assay::contingent {

// Whether an atom is true in a world; kEither stands for two worlds that differ in nothing else.
enum class Truth : std::int8_t { kFalse, kTrue, kEither };

struct World {
  std::vector<Truth> atoms;
  std::vector<double> numbers;  // of numeric functions, by slot

  bool operator==(const World&) const = default;
  auto operator<=>(const World&) const = default;
};

struct InitialWorlds {
  std::vector<World> worlds;
  bool are_all = true;  // else they were drawn
};

// The worlds that the initial knowledge allows, by enumeration. Atoms that no relation names are
// kEither. More than `limit`: as many, drawn.
InitialWorlds EnumerateWorlds(const GroundTask& task, std::int64_t limit, std::uint64_t seed);

}  // namespace assay::contingent
