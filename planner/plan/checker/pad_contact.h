#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "planner/domain/parts/part_model.h"
#include "planner/geometry/hull.h"
#include "planner/plan/data/plan.h"

namespace assay::plan {

// The contact of one closed pad with a part, as a grid of points over the pad's face.
struct PadContact {
  std::string finger;                     // "left", "right"
  geometry::Vector3 normal;               // part frame, unit: out of the part, into the pad
  std::vector<geometry::Vector3> points;  // part frame, on the pad's face with its rim
};

// Returns the contacts that the checker examines. `pad_half_extents` are along x and z of the tool.
// The left pad is on the tool's +y side.
std::array<PadContact, 2> PadContactsOf(const Hold& hold,
                                        const geometry::Vector2& pad_half_extents);

// Returns at how many examined points both pads touch the part opposite each other. They touch it
// at a point of the surface of the pieces' union: one of the part's pieces is 10 micrometres
// further into the part, and none is 10 micrometres out of it. The points are those of the grid,
// and more points on the facets of the pieces that lie in the pads' planes, since these may be
// narrower than the grid.
int PointsOfTouch(const std::array<PadContact, 2>& pads,
                  std::span<const geometry::ConvexHull> part);

// Returns whether the pads of a checked grasp touch or cover a feature (its faces, or the mouth of
// a hole). The test uses the points of the pad's grid and the corners of the feature. Points on the
// rims do not count.
bool Covers(const PadContact& contact, const domain::PartModel& part,
            const domain::Feature& feature);

// Checks whether a face of the feature, or the face around its mouth, lies on the table.
bool IsOnTable(const domain::PartModel& part, const domain::Feature& feature,
               const Pose& X_WorldPart);

}  // namespace assay::plan
