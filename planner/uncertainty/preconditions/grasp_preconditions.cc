#include <fmt/format.h>

#include <algorithm>

#include "planner/algebra/expression/simplify.h"
#include "planner/geometry/box.h"
#include "planner/uncertainty/preconditions/precondition.h"

namespace assay::uncertainty {
namespace {

constexpr double kLayerRounding = 1e-9;  // metres

class GraspConditions {
 public:
  GraspConditions(const UncertainWorld& world, PartId part, const plan::Hold& hold,
                  const ManipulatorError& draw)
      : world_(world),
        gripper_(world.problem().workcell->gripper()),
        width_(hold.width),
        part_(part),
        X_WorldTool_(world.X_WorldPart(part) * hold.X_PartTool),
        possible_tool_(AsTransform(X_WorldTool_) * draw.AsTransform()),
        X_ToolGrasp_(algebra::Simplify(algebra::Inverse(possible_tool_) *
                                       PossiblePose(world.X_WorldPart(part), world.resting(part)) *
                                       AsTransform(hold.X_PartTool))) {}

  // The contacts lie at half the part's width from the grasp's origin, and the fingers at half the
  // opening from the tool's. So the y of a contact as seen from finger 1 is its y as seen from the
  // tool plus half the opening.
  void RequireContactsBetweenFingers() {
    const double half_opening = gripper_.max_opening() / 2;
    for (const int contact : {1, 2}) {
      const double y = contact == 1 ? width_ / 2 : -width_ / 2;
      const Expression seen = (X_ToolGrasp_ * SymbolicVector{0, y, 0})[1];
      conditions_.Greater(plan::condition::kBetweenFingers,
                          fmt::format("contact {} lies on the inner side of finger 1", contact),
                          half_opening + seen, 0);
      conditions_.Less(plan::condition::kBetweenFingers,
                       fmt::format("contact {} lies on the inner side of finger 2", contact),
                       -half_opening + seen, 0);
    }
  }

  void RequireFingersClear() {
    const Transform X_GraspTool = algebra::Inverse(X_ToolGrasp_);
    const geometry::Vector2& pad = gripper_.pad_half_extents();
    for (const double x : {pad.x(), -pad.x()}) {
      for (const double z : {pad.y(), -pad.y()}) {
        for (const int finger : {1, 2}) {
          const double side = finger == 1 ? -1 : 1;
          const SymbolicVector corner = {x, side * gripper_.max_opening() / 2, z};
          conditions_.Less(plan::condition::kFingerClear,
                           fmt::format("finger {} comes down beside the part", finger),
                           width_ / 2 - side * (X_GraspTool * corner)[1], 0);
        }
      }
    }
  }

  void RequireFingertipsAboveTable() {
    std::vector<Vector3> corners;
    for (const geometry::Box& box : gripper_.FingerBoxes(gripper_.max_opening())) {
      for (const Vector3& corner : box.Corners()) corners.push_back(corner);
    }
    const auto height = [&](const Vector3& corner) { return (X_WorldTool_ * corner).z(); };
    const double lowest = height(*std::ranges::min_element(corners, {}, height));
    // The height of a corner changes by at most as much as the error of the hand's rotation moves
    // the corner. Corners that are higher than the lowest one by more than twice the greatest of
    // these bounds never become the lowest.
    const auto moves = [&](const Vector3& corner) {
      return corner.head<2>().norm() * Magnitude(world_.problem().gripper_error.theta);
    };
    const double layer = 2 * moves(*std::ranges::max_element(corners, {}, moves));
    for (const Vector3& corner : corners) {
      if (height(corner) > lowest + layer + kLayerRounding) continue;
      const SymbolicVector tip =
          possible_tool_ * SymbolicVector{corner.x(), corner.y(), corner.z()};
      conditions_.Greater(plan::condition::kFingertip, "the fingers end above the table",
                          tip[2] - world_.resting(part_).displacement[2], 0);
    }
  }

  void RequirePadContact(const HeldError& held) {
    const double margin = world_.problem().workcell->rules().pad_margin;
    const geometry::Vector2& pad = gripper_.pad_half_extents();
    conditions_.Within(plan::condition::kPadContact,
                       "the grasped point stays within the pads' width", held.x, pad.x() - margin);
    conditions_.Within(plan::condition::kPadContact,
                       "the grasped point stays within the pads' height", held.z, pad.y() - margin);
  }

  std::vector<Precondition> Take() { return conditions_.Take(); }

 private:
  const UncertainWorld& world_;
  const kinematics::Gripper& gripper_;
  double width_;
  PartId part_;
  Pose X_WorldTool_;  // commanded
  Transform possible_tool_;
  Transform X_ToolGrasp_;  // grasp of the displaced part, as seen from the hand with its error
  Preconditions conditions_;
};

}  // namespace

std::vector<Precondition> GraspPreconditions(const UncertainWorld& world, PartId part,
                                             const plan::Hold& hold, const ManipulatorError& draw,
                                             const HeldError& held) {
  GraspConditions conditions(world, part, hold, draw);
  conditions.RequireContactsBetweenFingers();
  if (world.propagation() == Propagation::kSound) {
    conditions.RequireFingersClear();
    conditions.RequireFingertipsAboveTable();
    conditions.RequirePadContact(held);
  }
  return conditions.Take();
}

}  // namespace assay::uncertainty
