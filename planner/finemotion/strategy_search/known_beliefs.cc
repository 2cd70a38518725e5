#include "planner/finemotion/strategy_search/known_beliefs.h"

#include <algorithm>

namespace assay::finemotion {

namespace {

constexpr double kSamePlace = 1e-3;  // metres within which positions are alike
constexpr double kTurn = 0.02;       // radians within which orientations are alike
constexpr double kWorse = 1.05;      // errors up to this factor greater are no worse
constexpr double kShift = 1e-5;      // metres by which greater errors of position are no worse
constexpr double kTwist = 2e-4;      // radians by which greater errors of orientation are no worse

using HalfWidths = Eigen::Matrix<double, kPoseDimensions, 1>;

HalfWidths HalfWidthsOf(const Belief& belief) { return belief.errors.rowwise().lpNorm<1>(); }

bool IsNoWorse(const Belief& known, const Belief& belief) {
  HalfWidths most = kWorse * HalfWidthsOf(belief);
  most.head<3>().array() += kShift;
  most.tail<3>().array() += kTwist;
  return (HalfWidthsOf(known).array() <= most.array()).all();
}

}  // namespace

bool KnownBeliefs::Add(int critical_point, const Belief& belief) {
  std::vector<ContactKey> kept = belief.kept;
  std::ranges::sort(kept);
  std::vector<Belief>& known = known_[{critical_point, std::move(kept)}];
  if (std::ranges::any_of(known, [&](const Belief& other) { return AreAlike(other, belief); }))
    return false;
  known.push_back(belief);
  return true;
}

bool KnownBeliefs::AreAlike(const Belief& known, const Belief& belief) const {
  PoseChange apart = Between(known.X_StationaryMoving, belief.X_StationaryMoving);
  const double farther_out = -apart.head<3>().dot(mating_);
  if (belief.kept.empty() && farther_out > 0) apart.head<3>() += farther_out * mating_;
  return apart.head<3>().norm() <= kSamePlace && apart.tail<3>().norm() <= kTurn &&
         IsNoWorse(known, belief);
}

}  // namespace assay::finemotion
