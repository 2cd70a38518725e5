#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "planner/finemotion/motions/believed_pose.h"

// The values that a linear function takes over all motions that errors allow. Checks of motions
// spend much of their time here, so these functions stand in a header.
namespace assay::finemotion {

// The changes of a row's value that are due to the errors of the start, one number for each error.
using ErrorParts = Eigen::VectorXd;

inline ErrorParts PartsOf(const numeric::SmallVector& row, const PoseChanges& errors,
                          const Eigen::VectorXd& tolerances) {
  ErrorParts parts = errors.transpose() * row.head<kPoseDimensions>();
  const Eigen::Index t = tolerances.size();
  if (t > 0) parts.head(t) += row.tail(t).cwiseProduct(tolerances);
  return parts;
}

// Returns the sum of the sizes of the parts that PartsOf computes.
inline double SumOfParts(const numeric::SmallVector& row, const PoseChanges& errors,
                         const Eigen::VectorXd& tolerances) {
  const PoseChange pose = row.head<kPoseDimensions>();
  const Eigen::Index t = tolerances.size();
  double sum = 0;
  for (Eigen::Index i = 0; i < t; ++i) {
    sum += std::abs(pose.dot(errors.col(i)) + row[kPoseDimensions + i] * tolerances[i]);
  }
  for (Eigen::Index i = t; i < errors.cols(); ++i) sum += std::abs(pose.dot(errors.col(i)));
  return sum;
}

// Returns how much errors can change the value of a row.
inline double ErrorOf(const numeric::SmallVector& row, const BelievedPose& believed) {
  return SumOfParts(row, believed.errors, believed.tolerances);
}

// The range of a linear function over a forward projection: over the start, with all of its errors,
// and over the velocity, with all of its errors.
struct RowRange {
  double start = 0;
  double motion = 0;  // change of the value in one displacement
  ErrorParts start_errors;
  PoseChange motion_errors;

  double Lowest(double time) const { return Extreme(-1, time); }
  double Highest(double time) const { return Extreme(1, time); }
  // Returns the greatest rate over all velocities.
  double Fastest() const { return motion + motion_errors.lpNorm<1>(); }

 private:
  double Extreme(double sign, double time) const {
    const double moved = sign * motion + motion_errors.lpNorm<1>();
    return sign * (sign * start + start_errors.lpNorm<1>() + time * std::max(0.0, moved));
  }
};

// Returns whether `row` stays below `most` wherever the contact that ends the motion is still open.
// The highest value of `row` there is at most the highest value of `row` plus a multiple of the
// contact's gap (Lagrange). This bound is convex in the multiplier, so a search over multipliers
// finds the best bound.
inline bool StaysBelow(const RowRange& row, const RowRange& gap, double gap_offset, double most,
                       double time) {
  const auto bound = [&](double multiplier) {
    const double errors = (row.start_errors + multiplier * gap.start_errors).lpNorm<1>();
    const double moved = row.motion + multiplier * gap.motion +
                         (row.motion_errors + multiplier * gap.motion_errors).lpNorm<1>();
    return row.start + multiplier * (gap.start + gap_offset) + errors + time * std::max(0.0, moved);
  };
  constexpr double kGreatestMultiplier = 1e6;
  constexpr int kThirds = 30;  // steps of a search that leaves two thirds of an interval in each
  double high = 1;
  while (high < kGreatestMultiplier && bound(2 * high) < bound(high)) high *= 2;
  high *= 2;
  double low = 0;
  for (int i = 0; i < kThirds; ++i) {
    const double third = (high - low) / 3;
    const double left = bound(low + third);
    const double right = bound(high - third);
    if (std::min(left, right) <= most) return true;
    (left < right ? high : low) += left < right ? -third : third;
  }
  return false;
}

}  // namespace assay::finemotion
