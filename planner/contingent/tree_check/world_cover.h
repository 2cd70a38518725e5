#pragma once

#include <cstddef>

#include "planner/contingent/world_sets/world_progression.h"

namespace assay::contingent {

// Compares the worlds and histories with which the repeats of a tree begin. Numbers of which
// nothing is known initially are ignored, because every other number would give the same result.
class WorldCover {
 public:
  // Keeps references.
  WorldCover(const GroundTask& task, WorldProgression& progression)
      : task_(task), progression_(progression) {}

  // Returns true if the world is a case of one of the worlds `by`, or if both of its cases for some
  // atom are covered.
  bool IsCovered(const World& world, const Worlds& by);
  // Returns the history in a form for comparison: without open numbers, each world once.
  History ToCompare(History history) const;

 private:
  bool IsOpen(std::size_t slot) const;
  bool IsCaseOf(const World& world, const World& of) const;

  const GroundTask& task_;
  WorldProgression& progression_;
};

// Returns true if all that was sensed in `begun` was sensed in `history`, with errors that are no
// larger.
bool HasSensed(const History& history, const History& begun);
// Returns `begun` with only those of its sensed facts that were sensed in `history`, too.
History WithSensedOf(const History& history, History begun);

}  // namespace assay::contingent
