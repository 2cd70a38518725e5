#pragma once

#include "planner/base/random.h"
#include "planner/finemotion/strategy_search/fine_motion_plan.h"

namespace assay::finemotion {

// A start of a strategy relative to the entry: how far it is turned, and how far beside the entry.
struct Start {
  Vector3 turn = Vector3::Zero();    // rotation vector, radians
  Vector3 beside = Vector3::Zero();  // metres across the way in
};

// Draws perturbed approaches (Dakin and Popplestone, section 4). The paper samples them about the
// nominal approach.
class Starts {
 public:
  Starts(const Passage& passage, const FineMotionErrors& errors, const StrategyOptions& options,
         RandomStream& random)
      : passage_(passage), errors_(errors), options_(options), random_(random) {}

  // Returns the start for errors that are less than the play.
  Start Upright() const;
  // Returns a start that is tilted in any direction, and shifted so that its lowest corner is
  // inside the entry.
  Start Random();
  // Returns another start. Its distance from `start` is drawn, in proportion to `size`.
  Start Near(const Start& start, double size);

  // Returns the believed pose at a start, with `multiple` times the errors. The start is so far up
  // that the part is free for all of these errors.
  BelievedPose BelievedPoseAt(const Start& start, double multiple) const;

 private:
  Vector3 LowestCorner(const Vector3& turn) const;
  Pose Entered(const Start& start) const;
  // Returns how far the part can be beyond the entry at this pose, in metres along the way in, with
  // `multiple` times the errors. An error of rotation moves a corner by the angle times the
  // corner's distance from the tip. If this distance is more than `lever` metres, `lever` takes its
  // place.
  double Deepest(const Pose& X_StationaryMoving, double multiple, double lever) const;

  const Passage& passage_;
  const FineMotionErrors& errors_;
  const StrategyOptions& options_;
  RandomStream& random_;
};

}  // namespace assay::finemotion
