#include "planner/geometry/connected_boxes.h"

#include <algorithm>
#include <array>
#include <vector>

#include "planner/geometry/collision.h"

namespace assay::geometry {
namespace {

constexpr double kJointDepth = 1e-6;  // depth of a test whether boxes touch, metres

// A box in two forms, to test whether it is connected with another box. The reaching form has its
// sides pushed out a little, along one axis at a time. The other form is drawn in on all sides, by
// a little less.
struct Joint {
  CollisionShape reaching;
  CollisionShape drawn_in;

  explicit Joint(const Box& box) : reaching(Reaching(box)), drawn_in(DrawnIn(box)) {}

  bool HoldsTo(const Joint& other) const {
    return Overlaps(reaching, Pose::Identity(), other.drawn_in, Pose::Identity(), 0);
  }

 private:
  static CollisionShape Reaching(const Box& box) {
    std::array<Box, 3> boxes = {box, box, box};
    for (int axis = 0; axis < 3; ++axis) {
      boxes[static_cast<std::size_t>(axis)].half_extents[axis] += 1.2 * kJointDepth;
    }
    return CollisionShape(boxes);
  }
  static CollisionShape DrawnIn(Box box) {
    box.half_extents.array() -= kJointDepth;
    return CollisionShape({&box, 1});
  }
};

}  // namespace

int FirstApart(std::span<const Box> boxes) {
  const std::vector<Joint> joints(boxes.begin(), boxes.end());
  std::vector<bool> is_reached(boxes.size());
  std::vector<std::size_t> to_look_from = {0};
  is_reached[0] = true;
  while (!to_look_from.empty()) {
    const Joint& from = joints[to_look_from.back()];
    to_look_from.pop_back();
    for (std::size_t i = 0; i < joints.size(); ++i) {
      if (is_reached[i] || !from.HoldsTo(joints[i])) continue;
      is_reached[i] = true;
      to_look_from.push_back(i);
    }
  }
  const auto apart = std::ranges::find(is_reached, false);
  return apart == is_reached.end() ? -1 : static_cast<int>(apart - is_reached.begin());
}

}  // namespace assay::geometry
