#pragma once

#include <cmath>
#include <numbers>

#include "planner/base/random.h"
#include "planner/geometry/box.h"
#include "planner/geometry/pose.h"

namespace assay::oracle {

inline geometry::Vector3 RandomVector(RandomStream& random, double reach) {
  const double x = random.Uniform(-reach, reach);
  const double y = random.Uniform(-reach, reach);
  return {x, y, random.Uniform(-reach, reach)};
}

// Returns a rotation from the uniform distribution (Shoemake 1992).
inline geometry::Matrix3 RandomRotation(RandomStream& random) {
  const double u = random.Uniform();
  const double v = random.Uniform(0, 2 * std::numbers::pi);
  const double w = random.Uniform(0, 2 * std::numbers::pi);
  return Eigen::Quaterniond(std::sqrt(u) * std::cos(w), std::sqrt(1 - u) * std::sin(v),
                            std::sqrt(1 - u) * std::cos(v), std::sqrt(u) * std::sin(w))
      .toRotationMatrix();
}

inline geometry::Pose RandomPose(RandomStream& random, double reach) {
  geometry::Pose X = geometry::Translation(RandomVector(random, reach));
  X.linear() = RandomRotation(random);
  return X;
}

// Returns one of the 24 rotations that permute the axes.
inline geometry::Matrix3 RandomQuarterTurns(RandomStream& random) {
  const int axis = random.Index(3);
  const int sign = random.Index(2) * 2 - 1;
  const int turn = random.Index(2) * 2 - 1;
  geometry::Matrix3 R = geometry::Matrix3::Zero();
  R(axis, 0) = sign;
  R((axis + 1 + random.Index(2)) % 3, 1) = turn;
  R.col(2) = R.col(0).cross(R.col(1));
  return R;
}

inline geometry::Box RandomBox(RandomStream& random, double reach, double least, double most) {
  geometry::Box box{RandomPose(random, reach), {}};
  for (int i = 0; i < 3; ++i) box.half_extents[i] = random.Uniform(least, most);
  return box;
}

}  // namespace assay::oracle
