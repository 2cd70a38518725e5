#pragma once

#include <stdexcept>
#include <vector>

#include "planner/domain/parts/part_model.h"
#include "planner/geometry/box.h"

namespace assay::oracle {

// Returns the pieces of a part as boxes, for oracles that know boxes only. Throws if a piece is no
// box.
inline std::vector<geometry::Box> BoxesOf(const domain::PartModel& part) {
  std::vector<geometry::Box> boxes;
  for (const geometry::ConvexHull& piece : part.pieces()) {
    const auto box = geometry::AsBox(piece);
    if (!box) throw std::logic_error("a piece that is no box");
    boxes.push_back(*box);
  }
  return boxes;
}

}  // namespace assay::oracle
