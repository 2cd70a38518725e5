#pragma once

#include "planner/domain/problem/problem.h"
#include "planner/plan/data/plan.h"
#include "sim/check/measurements/step_events.h"

namespace assay::check {

// A step of a plan, and where parts and hand truly were in it.
class MeasuredStep {
 public:
  // The problem, the step and the events must outlive this object.
  MeasuredStep(const domain::Problem& problem, const plan::PlannedStep& step,
               const StepEvents& events);

  const domain::Problem& problem() const { return problem_; }
  const plan::PlannedStep& step() const { return step_; }
  const StepEvents& events() const { return events_; }
  const kinematics::Gripper& gripper() const { return problem_.workcell->gripper(); }

  // The part that the step handles, and how the hand holds it. A look has no hold (checked).
  domain::PartId part() const { return part_; }
  const geometry::CollisionShape& shape() const;
  const plan::Hold& hold() const;
  // The mating of a step that assembles.
  const domain::Mating& mating() const;

  // Returns the true pose of the handled part.
  const geometry::Pose& PartAt(const execution::Snapshot& snapshot) const;
  // Returns the opening of the pads, within what the gripper can open.
  double OpeningAt(const execution::Snapshot& snapshot) const;

 private:
  const domain::Problem& problem_;
  const plan::PlannedStep& step_;
  const StepEvents& events_;
  domain::PartId part_;
  const plan::Hold* hold_;
};

// The end of a guarded motion as planned.
struct GuardedEnd {
  geometry::Pose X_WorldExpected;  // believed pose of the part at the end
  geometry::Pose X_WorldEnd;       // true pose of the part at the end
  geometry::Vector3 direction;     // unit vector of the motion
};

inline constexpr double kStandsOn = 1e-3;  // metres above what a part stands on

// Returns the margin, in metres, by which a guarded motion met something within the guarded travel
// of where that was expected; negative if it met nothing. Pads that bear less than the stop force
// slide down on the part. The motion has then met something where the part stopped. The step must
// have come to where the tool acts (StepEvents::reached).
double MetOnGuardedWay(const MeasuredStep& step, const GuardedEnd& end);

}  // namespace assay::check
