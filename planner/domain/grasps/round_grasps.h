#pragma once

#include <vector>

#include "planner/domain/grasps/round_side.h"

namespace assay::domain {

// The round sides of a part that pads close on, each with the directions in which they close.
class RoundGrasps {
 public:
  // `step` is the least angle between two directions, radians.
  explicit RoundGrasps(double step) : step_(step) {}

  // Notes a pair of faces of a round side, which pads close on along the unit vector `closing`.
  // Returns false if the pads close on the same side in nearly the same direction for another pair:
  // the grasps would be alike.
  bool Add(const RoundSide& side, const Vector3& closing);

 private:
  struct Taken {
    RoundSide side;
    Vector3 closing;
  };
  double step_;
  std::vector<Taken> taken_;
};

}  // namespace assay::domain
