#pragma once

#include "planner/base/random.h"
#include "planner/finemotion/search/fine_motion_plan.h"

namespace assay::finemotion {

// Where a strategy starts, against the entry: turned, and beside it.
struct Start {
  Vector3 turn = Vector3::Zero();    // rotation vector
  Vector3 beside = Vector3::Zero();  // metres, across the way in
};

// Perturbed approaches (Dakin and Popplestone, section 4): they are drawn here, the paper samples
// them about the nominal one.
class Starts {
 public:
  Starts(const Passage& passage, const FineMotionErrors& errors, const StrategyOptions& options,
         RandomStream& random)
      : passage_(passage), errors_(errors), options_(options), random_(random) {}

  // For errors that are less than the play.
  Start Upright() const;
  // Tilted any way, and shifted so that the corner that is then the lowest is inside the entry.
  Start Random();
  // Another one, `size` times as far away as starts are drawn.
  Start Near(const Start& start, double size);

  // So far up that the part is free, whatever the errors; with so many times these.
  Belief BeliefAt(const Start& start, double multiple) const;

 private:
  Vector3 LowestCorner(const Vector3& turn) const;

  const Passage& passage_;
  const FineMotionErrors& errors_;
  const StrategyOptions& options_;
  RandomStream& random_;
};

}  // namespace assay::finemotion
