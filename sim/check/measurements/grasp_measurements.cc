#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "planner/geometry/box.h"
#include "planner/kinematics/grippers/gripper.h"
#include "planner/plan/certificates/condition_table.h"
#include "sim/check/measurements/fit.h"
#include "sim/check/measurements/measurement.h"

namespace assay::check {
namespace {

using geometry::Pose;
using geometry::Vector2;
using geometry::Vector3;

// Positions along the tool's y axis, as the grasp numbers contacts and fingers.
constexpr double kFirstContact = 0.5;  // of the width
constexpr double kFirstFinger = -1;    // of half the opening

// Returns the grasp frame of the true part in the frame of the true tool.
Pose GraspInTool(const MeasuredStep& step, const execution::Snapshot& snapshot) {
  return snapshot.tool.truth.inverse() * step.PartAt(snapshot) * step.hold().X_PartTool;
}

// Both contacts lie between the pads when these begin to close.
std::vector<MeasuredMargin> BetweenFingers(const MeasuredStep& step) {
  const execution::Snapshot* reached = step.events().reached;
  if (reached == nullptr) return {};
  const Pose X_ToolGrasp = GraspInTool(step, *reached);
  std::vector<MeasuredMargin> measured;
  for (const int contact : {1, 2}) {
    const double side = contact == 1 ? kFirstContact : -kFirstContact;
    const double at = (X_ToolGrasp * Vector3(0, side * step.hold().width, 0)).y();
    for (const int finger : {1, 2}) {
      const double inward = finger == 1 ? kFirstFinger * at : -kFirstFinger * at;
      AddFinite(fmt::format("contact {} lies on the inner side of finger {}", contact, finger),
                reached->opening / 2 - inward, measured);
    }
  }
  return measured;
}

// The inner corners of the open pads lie outside the faces on which the pads close.
std::vector<MeasuredMargin> FingerClear(const MeasuredStep& step) {
  const execution::Snapshot* reached = step.events().reached;
  if (reached == nullptr) return {};
  const Pose X_GraspTool = GraspInTool(step, *reached).inverse();
  const Vector2& pad = step.gripper().pad_half_extents();
  std::vector<MeasuredMargin> measured;
  for (const int finger : {1, 2}) {
    const double side = finger == 1 ? kFirstFinger : -kFirstFinger;
    double worst = kInfinity;
    for (const double x : {-pad.x(), pad.x()}) {
      for (const double z : {-pad.y(), pad.y()}) {
        const Vector3 corner = X_GraspTool * Vector3(x, side * reached->opening / 2, z);
        worst = std::min(worst, side * corner.y() - step.hold().width / 2);
      }
    }
    AddFinite(fmt::format("finger {} comes down beside the part", finger), worst, measured);
  }
  return measured;
}

// Measures how far the lowest points of the fingers are above the table when the pads close.
// Nothing measures the fingers when the pads open.
std::vector<MeasuredMargin> Fingertip(const MeasuredStep& step) {
  const execution::Snapshot* reached = step.events().reached;
  if (!step.step().action.kind->ClosesPads() || reached == nullptr) return {};
  double lowest = kInfinity;
  for (const geometry::Box& box : step.gripper().FingerBoxes(step.OpeningAt(*reached))) {
    for (const Vector3& corner : box.Corners()) {
      lowest = std::min(lowest, (reached->tool.truth * corner).z());
    }
  }
  return OfAll(lowest - reached->table_heights[step.part().index()]);
}

// The closed pads hold the grasped point, with the workcell's margin.
std::vector<MeasuredMargin> PadContact(const MeasuredStep& step) {
  const StepEvents& events = step.events();
  if (events.reached == nullptr || events.acted == nullptr) return {};
  const Vector3 p = GraspInTool(step, *events.acted).translation();
  const Vector2& pad = step.gripper().pad_half_extents();
  const double margin = step.problem().workcell->rules().pad_margin;
  std::vector<MeasuredMargin> measured;
  AddFinite("the grasped point stays within the pads' width", pad.x() - margin - std::abs(p.x()),
            measured);
  AddFinite("the grasped point stays within the pads' height", pad.y() - margin - std::abs(p.z()),
            measured);
  return measured;
}

}  // namespace

std::vector<Measurement> GraspMeasurements() {
  return {{plan::condition::kBetweenFingers, BetweenFingers},
          {plan::condition::kFingerClear, FingerClear},
          {plan::condition::kFingertip, Fingertip},
          {plan::condition::kPadContact, PadContact},
          {plan::condition::kUpright},
          {plan::condition::kPushedClear}};
}

}  // namespace assay::check
