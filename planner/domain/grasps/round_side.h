#pragma once

#include <optional>
#include <vector>

#include "planner/base/interval.h"
#include "planner/domain/parts/feature.h"

namespace assay::domain {

class PartModel;

// Faces all around an axis that touch one circle about it: the side of a prism that stands for a
// cylinder. Each face has an opposite one.
struct RoundSide {
  Pose X_PartAxis;            // z along the axis
  double radius = 0;          // of the circle, metres
  double half_step = 0;       // half the greatest angle between neighbouring normals, radians
  std::vector<FaceId> faces;  // in the order of their angles about the axis

  // Returns the distance of the corners from the axis: the radius of the circle around the polygon.
  double OuterRadius() const;
};

// Returns the round side about z of `X_PartAxis` whose faces are `radius` away from it. Returns
// none if there is no such side, or if neighbouring normals are more than 30 degrees apart.
std::optional<RoundSide> RoundSideAbout(const PartModel& part, const Pose& X_PartAxis,
                                        double radius);

// Returns whether the whole side is exposed between two heights: z of X_PartAxis, in metres.
bool IsRoundBetween(const PartModel& part, const RoundSide& side, const Interval& heights);

// Returns whether nothing of the part between two heights is outside of the polygon's outer circle.
bool IsInsideCircle(const PartModel& part, const RoundSide& side, const Interval& heights);

}  // namespace assay::domain
