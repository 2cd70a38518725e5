#include "planner/finemotion/strategy_search/passage.h"

#include <algorithm>
#include <cmath>

#include "planner/geometry/pose.h"

namespace assay::finemotion {

Pose Passage::X_StationaryEntryAt(int i) const {
  if (i == 0) return X_StationaryEntry;
  return geometry::Translation(further[static_cast<std::size_t>(i) - 1] * mating) *
         X_StationaryEntry;
}

std::vector<PrimitiveContact> WallsAt(const Passage& passage, int critical_point,
                                      const ContactFinder& finder) {
  std::vector<PrimitiveContact> walls =
      finder.Near(passage.X_StationaryEntryAt(critical_point), {.reach = passage.depth, .turn = 0});
  std::erase_if(walls, [&](const PrimitiveContact& contact) {
    return contact.kind == ContactKind::kEdgeEdge ||
           std::abs(contact.normal.dot(passage.mating)) > kAcross;
  });
  return walls;
}

double TipSize(const Passage& passage) {
  double size = 0;
  const ContactFinder finder(passage.moving, passage.stationary);
  for (const PrimitiveContact& wall : WallsAt(passage, 0, finder))
    size = std::max(size, wall.at.cross(passage.mating).norm());
  return size;
}

}  // namespace assay::finemotion
