#pragma once

#include <vector>

#include "planner/domain/parts/part_model.h"
#include "planner/geometry/coordinates.h"
#include "planner/kinematics/grippers/gripper.h"

namespace assay::domain {

// The set of origins of the tool, in a plane, at which one box of the gripper overlaps one piece
// of the part while neither turns: a C-obstacle (Lozano-Perez 1983).
struct CObstacle {
  struct Side {
    geometry::Vector2 normal;
    double offset = 0;  // normal . p < offset on the inside
  };
  std::vector<Side> sides;

  bool Contains(const geometry::Vector2& p) const;
};

// The approach of a hand to a part: along a direction in the plane midway between the held faces.
struct Approach {
  geometry::Vector2 x;  // the tool's x and z axes in the plane
  geometry::Vector2 z;
  double length = 0;  // length of the straight approach, metres

  // Returns the approach whose tool z is at an angle from the plane's x, with y along the plane's
  // normal.
  static Approach At(double angle, double length);
};

// The positions of the tool at which hand and fingers miss the part that they take. Fingers move
// only along the plane's normal, so each of their boxes is a rectangle in the plane. The rectangle
// meets the part where it meets the shadow of the part's pieces in the box's range of heights. This
// is exact for gripper boxes with a side parallel to the plane; other boxes are replaced by their
// bounding boxes.
class HandClearance {
 public:
  // `X_PartMiddle` is the plane midway between two faces `width` metres apart, with its z along the
  // tool's y. Hand and opened fingers must be free all along the approach, and closed fingers at
  // its end. Overlaps up to `allowance` metres on each side of a gripper box are allowed. If the
  // faces are too far apart for the gripper, only the hand must be free.
  HandClearance(const PartModel& part, const kinematics::Gripper& gripper, const Pose& X_PartMiddle,
                double width, double allowance);

  std::vector<CObstacle> ObstaclesOf(const Approach& approach) const;

 private:
  enum class Stage { kApproaching, kClosed };
  // A box of the gripper, and the shadow of one of the part's pieces that it can meet.
  struct Encounter {
    Stage stage;
    geometry::Vector2 low;  // corner of the gripper box's rectangle, tool x and z
    geometry::Vector2 high;
    geometry::Polygon shadow;  // shadow of the part's piece, plane x and y
  };
  void Add(const std::vector<geometry::Box>& gripper_boxes, Stage stage, double allowance);
  static CObstacle ObstacleOf(const Encounter& encounter, const Approach& approach);

  std::vector<geometry::ConvexHull> pieces_;  // of the part, in the plane's frame
  std::vector<Encounter> encounters_;
};

}  // namespace assay::domain
