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

BelievedPose BelievedPoseIn(const Pose& X_StationaryMoving, const FineMotionErrors& errors,
                            double multiple) {
  BelievedPose believed{.X_StationaryMoving = X_StationaryMoving,
                        .errors = {},
                        .kept = {},
                        .tolerances = multiple * errors.tolerances};
  believed.errors.setZero(Eigen::NoChange, believed.tolerances.size() + kPoseDimensions);
  believed.errors.rightCols<kPoseDimensions>() =
      multiple * errors.pose.asDiagonal().toDenseMatrix();
  return believed;
}

}  // namespace assay::finemotion
