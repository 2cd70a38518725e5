#include "planner/motion/travel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "planner/geometry/collision.h"
#include "planner/motion/joint_trajectory.h"
#include "planner/motion/straight_line.h"

namespace assay::motion {
namespace {

using geometry::CollisionShape;

constexpr double kLookTurn = 0.05;  // radians that a joint turns between looks at a way

double LowestPoint(const std::vector<geometry::Box>& boxes, const Pose& X_WorldFrame) {
  double lowest = 1e9;
  for (const geometry::Box& box : boxes) {
    const Pose X_WorldBox = X_WorldFrame * box.X_FrameBox;
    const double reach = X_WorldBox.linear().row(2).cwiseAbs().dot(box.half_extents.transpose());
    lowest = std::min(lowest, X_WorldBox.translation().z() - reach);
  }
  return lowest;
}

double HighestPoint(const domain::Part& part, const Pose& X_WorldPart) {
  double highest = 0;
  for (const Vector3& vertex : part.model->hull().vertices) {
    highest = std::max(highest, (X_WorldPart * vertex).z());
  }
  return highest;
}

// Something rigid that moves with the tool.
struct Mover {
  std::vector<geometry::Box> boxes;
  CollisionShape shape;
  Pose X_ToolMover;
};

// Looks whether what the arm carries stays clear of everything else.
class Clearance {
 public:
  Clearance(const domain::Problem& problem, const Surroundings& surroundings)
      : problem_(problem), surroundings_(surroundings) {
    const kinematics::Gripper& gripper = problem.workcell->gripper();
    std::vector<geometry::Box> hand = gripper.HandBoxes();
    const std::vector<geometry::Box> fingers =
        gripper.FingerBoxes(std::clamp(surroundings.opening, 0.0, gripper.max_opening()));
    hand.insert(hand.end(), fingers.begin(), fingers.end());
    movers_.push_back({hand, CollisionShape(hand), Pose::Identity()});
    if (surroundings.held) {
      const domain::PartModel& held = *problem.part(surroundings.held->part).model;
      movers_.push_back({held.boxes(), held.shape(), surroundings.held->X_PartTool.inverse()});
    }
  }

  bool IsClear(const JointVector& from, const JointVector& to) const {
    const int looks =
        std::max(1, static_cast<int>(std::ceil((to - from).cwiseAbs().maxCoeff() / kLookTurn)));
    for (int i = 0; i <= looks; ++i) {
      const JointVector q = from + static_cast<double>(i) / looks * (to - from);
      const Pose X_WorldTool = ToolAt(*problem_.workcell, q);
      const auto clear = [&](const Mover& mover) { return IsClear(mover, X_WorldTool); };
      if (!std::ranges::all_of(movers_, clear)) return false;
    }
    return true;
  }

 private:
  bool IsClear(const Mover& mover, const Pose& X_WorldTool) const {
    const Pose X_WorldMover = X_WorldTool * mover.X_ToolMover;
    const double lowest = LowestPoint(mover.boxes, X_WorldMover);
    if (lowest < kTravelGap) return false;
    for (const auto& [id, X_WorldPart] : surroundings_.parts) {
      const domain::Part& part = problem_.part(id);
      if (lowest > HighestPoint(part, X_WorldPart) + kTravelGap) continue;
      if (Distance(mover.shape, X_WorldMover, part.model->shape(), X_WorldPart) < kTravelGap) {
        return false;
      }
    }
    return true;
  }

  const domain::Problem& problem_;
  const Surroundings& surroundings_;
  std::vector<Mover> movers_;
};

std::string Where(const Vector3& p) {
  return fmt::format("({:.1f}, {:.1f}, {:.1f}) mm", 1e3 * p.x(), 1e3 * p.y(), 1e3 * p.z());
}

}  // namespace

std::vector<JointVector> PosturesAt(const domain::Workcell& workcell, const Pose& X_WorldTool,
                                    const JointVector& from) {
  std::vector<JointVector> found;
  const kinematics::Arm& arm = workcell.arm();
  for (const auto& s : arm.Inverse(workcell.FlangeFor(X_WorldTool), from)) {
    std::ranges::copy(arm.Representatives(s.q), std::back_inserter(found));
  }
  const JointRates rates = RatesOf(workcell);
  const auto time = [&](const JointVector& q) { return MoveDuration(from, q, rates); };
  std::ranges::stable_sort(found, {}, time);
  return found;
}

bool CanFollow(const domain::Workcell& workcell, JointVector q, const std::vector<Vector3>& corners,
               double step) {
  for (const Vector3& corner : corners) {
    const LineResult line = FollowLine(workcell, q, corner, step);
    if (!line.path) return false;
    q = line.path->q.back();
  }
  return true;
}

TravelResult PlanTravel(const domain::Problem& problem, const Surroundings& surroundings,
                        const TravelRequest& request) {
  const domain::Workcell& workcell = *problem.workcell;
  const std::string where = Where(request.X_WorldTool.translation());
  const Clearance clearance(problem, surroundings);
  std::vector<JointVector> destinations;  // from which the lines can be followed
  for (const JointVector& q : PosturesAt(workcell, request.X_WorldTool, request.from)) {
    if (!CanFollow(workcell, q, request.corners, request.line_step)) continue;
    if (clearance.IsClear(request.from, q)) return JointPath{request.from, q};
    destinations.push_back(q);
  }
  if (destinations.empty()) {
    return fmt::format("no configuration of the arm reaches {} and goes on straight from there",
                       where);
  }
  const JointVector& home = workcell.home();
  for (const JointVector& q : destinations) {
    if (clearance.IsClear(request.from, home) && clearance.IsClear(home, q)) {
      return JointPath{request.from, home, q};
    }
  }
  return fmt::format("every way to {} comes within {:.0f} mm of the table or a part", where,
                     1e3 * kTravelGap);
}

}  // namespace assay::motion
