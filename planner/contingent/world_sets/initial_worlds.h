#pragma once

#include <compare>
#include <cstdint>
#include <vector>

#include "planner/contingent/grounding/ground_task.h"
#include "planner/contingent/knowledge/number_marks.h"

namespace assay::contingent {

// The truth of an atom in a world. kEither represents two worlds that differ only in this atom.
enum class Truth : std::int8_t { kFalse, kTrue, kEither };

struct World {
  std::vector<Truth> atoms;
  std::vector<Number> numbers;  // numbers of numeric functions, by slot
  // True if the checker follows this world. The other worlds of a history serve to determine what
  // is known.
  bool is_followed = true;

  bool operator==(const World&) const = default;
  auto operator<=>(const World&) const = default;
};

struct InitialWorlds {
  std::vector<World> worlds;
  bool were_drawn = false;  // true if the worlds are a random sample, because there are too many
};

// Enumerates the worlds that the initial knowledge allows. Atoms that no relation names are
// kEither. Numbers are those that represent their ranges. If there are more than `limit` worlds, a
// random sample of `limit` worlds is returned. Returns no worlds if the knowledge contradicts
// itself.
InitialWorlds EnumerateWorlds(const GroundTask& task, const NumberMarks& marks, std::int64_t limit,
                              std::uint64_t seed);

}  // namespace assay::contingent
