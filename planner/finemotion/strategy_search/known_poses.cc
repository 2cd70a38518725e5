#include "planner/finemotion/strategy_search/known_poses.h"

#include <algorithm>

namespace assay::finemotion {

namespace {

constexpr double kSamePlace = 1e-3;  // metres within which positions are alike
constexpr double kTurn = 0.02;       // radians within which orientations are alike
constexpr double kWorse = 1.05;      // errors up to this factor greater are no worse
constexpr double kShift = 1e-5;      // metres by which greater errors of position are no worse
constexpr double kTwist = 2e-4;      // radians by which greater errors of orientation are no worse

using HalfWidths = Eigen::Matrix<double, kPoseDimensions, 1>;

HalfWidths HalfWidthsOf(const BelievedPose& believed) {
  return believed.errors.rowwise().lpNorm<1>();
}

bool IsNoWorse(const BelievedPose& known, const BelievedPose& believed) {
  HalfWidths most = kWorse * HalfWidthsOf(believed);
  most.head<3>().array() += kShift;
  most.tail<3>().array() += kTwist;
  return (HalfWidthsOf(known).array() <= most.array()).all();
}

}  // namespace

bool KnownPoses::Add(int critical_point, const BelievedPose& believed) {
  std::vector<ContactKey> kept = believed.kept;
  std::ranges::sort(kept);
  std::vector<BelievedPose>& known = known_[{critical_point, std::move(kept)}];
  if (std::ranges::any_of(known,
                          [&](const BelievedPose& other) { return AreAlike(other, believed); }))
    return false;
  known.push_back(believed);
  return true;
}

bool KnownPoses::AreAlike(const BelievedPose& known, const BelievedPose& believed) const {
  PoseChange apart = Between(known.X_StationaryMoving, believed.X_StationaryMoving);
  const double farther_out = -apart.head<3>().dot(mating_);
  if (believed.kept.empty() && farther_out > 0) apart.head<3>() += farther_out * mating_;
  return apart.head<3>().norm() <= kSamePlace && apart.tail<3>().norm() <= kTurn &&
         IsNoWorse(known, believed);
}

}  // namespace assay::finemotion
