#include "planner/finemotion/strategy_search/fine_motion_plan.h"

namespace assay::finemotion {

FineMotionErrors Enlarged(const FineMotionErrors& errors, double multiple) {
  return {multiple * errors.pose, errors.velocity, multiple * errors.tolerances};
}

MotionChecker CheckerFor(const Passage& passage, const FineMotionErrors& errors,
                         const StrategyOptions& options) {
  return {passage.moving,
          ContactFinder(passage.moving, passage.stationary, passage.tolerances),
          {.velocity_error = errors.velocity,
           .radius = options.radius,
           .test = options.test,
           .friction = options.friction}};
}

Belief BeliefIn(const Pose& X_StationaryMoving, const FineMotionErrors& errors, double multiple) {
  Belief belief{.X_StationaryMoving = X_StationaryMoving,
                .errors = {},
                .kept = {},
                .tolerances = multiple * errors.tolerances};
  belief.errors.setZero(Eigen::NoChange, belief.tolerances.size() + kPoseDimensions);
  belief.errors.rightCols<kPoseDimensions>() = multiple * errors.pose.asDiagonal().toDenseMatrix();
  return belief;
}

}  // namespace assay::finemotion
