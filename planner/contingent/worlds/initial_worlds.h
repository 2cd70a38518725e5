#pragma once

#include <compare>
#include <cstdint>
#include <vector>

#include "planner/contingent/grounding/ground_task.h"
#include "planner/contingent/knowledge/number_marks.h"

namespace assay::contingent {

// Whether an atom is true in a world; kEither stands for two worlds that differ in nothing else.
enum class Truth : std::int8_t { kFalse, kTrue, kEither };

struct World {
  std::vector<Truth> atoms;
  std::vector<Number> numbers;  // of numeric functions, by slot
  // Where the checker asks what one world of a history comes to: this one, or one of the others,
  // which are there for what is known.
  bool is_followed = true;

  bool operator==(const World&) const = default;
  auto operator<=>(const World&) const = default;
};

struct InitialWorlds {
  std::vector<World> worlds;
  bool were_drawn = false;  // being too many
};

// The worlds that the initial knowledge allows, by enumeration. Atoms that no relation names are
// kEither; numbers are those that stand for their ranges. More than `limit`: as many, drawn. None
// if the knowledge contradicts itself.
InitialWorlds EnumerateWorlds(const GroundTask& task, const NumberMarks& marks, std::int64_t limit,
                              std::uint64_t seed);

}  // namespace assay::contingent
