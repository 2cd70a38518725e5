#include "sim/check/measurements/measured_step.h"

#include <algorithm>
#include <cmath>

#include "planner/base/check.h"
#include "planner/domain/parts/part_model.h"
#include "planner/geometry/collision.h"
#include "planner/kinematics/grippers/gripper.h"
#include "planner/plan/certificates/pushing.h"

namespace assay::check {

using geometry::Vector3;

MeasuredStep::MeasuredStep(const domain::Problem& problem, const plan::PlannedStep& step,
                           const StepEvents& events)
    : problem_(problem),
      step_(step),
      events_(events),
      part_(HandledPart(problem, step.action)),
      hold_(HoldIn(step.action)) {}

const geometry::CollisionShape& MeasuredStep::shape() const {
  return problem_.part(part_).model->shape();
}

const plan::Hold& MeasuredStep::hold() const {
  ASSAY_CHECK(hold_ != nullptr, "a look leaves no part in the hand");
  return *hold_;
}

const domain::Mating& MeasuredStep::mating() const { return problem_.mating(step_.action.mating); }

const geometry::Pose& MeasuredStep::PartAt(const execution::Snapshot& snapshot) const {
  return snapshot.parts[part_.index()].truth;
}

double MeasuredStep::OpeningAt(const execution::Snapshot& snapshot) const {
  return std::clamp(snapshot.opening, 0.0, gripper().max_opening());
}

double MetOnGuardedWay(const MeasuredStep& step, const GuardedEnd& end) {
  const execution::Snapshot& reached = *step.events().reached;
  const Vector3& direction = end.direction;
  const double travel = step.problem().workcell->rules().guarded_travel;
  const Vector3 expected = (end.X_WorldExpected * step.hold().X_PartTool).translation();
  const double beyond = direction.dot(reached.tool.believed.translation() - expected);
  if (step.events().resisted.value_or(false)) return travel - std::abs(beyond);
  const Vector3 place = step.PartAt(reached).translation();
  const double missing = direction.dot(end.X_WorldEnd.translation() - place);
  const bool may_have_slid = !plan::PadsBearResistance(step.problem()) && missing <= kStandsOn;
  if (step.events().poised == nullptr || !may_have_slid) {
    return std::min(0.0, travel - std::abs(beyond)) - travel;
  }
  const execution::Snapshot& poised = *step.events().poised;
  const double way = direction.dot(place - step.PartAt(poised).translation());
  const double expected_way = direction.dot(expected - poised.tool.believed.translation());
  return travel - std::abs(way - expected_way);
}

}  // namespace assay::check
