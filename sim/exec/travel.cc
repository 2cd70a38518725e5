#include "sim/exec/travel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "planner/geometry/collision.h"
#include "sim/exec/straight_line.h"

namespace assay::exec {
namespace {

using geometry::CollisionShape;
using motion::JointRates;

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
  Clearance(const domain::Problem& problem, const WorldModel& world, double opening)
      : problem_(problem), world_(world) {
    const kinematics::Gripper& gripper = problem.workcell->gripper();
    std::vector<geometry::Box> hand = gripper.HandBoxes();
    const std::vector<geometry::Box> fingers =
        gripper.FingerBoxes(std::clamp(opening, 0.0, gripper.max_opening()));
    hand.insert(hand.end(), fingers.begin(), fingers.end());
    movers_.push_back({hand, CollisionShape(hand), Pose::Identity()});
    if (!world.held().IsNone()) {
      const domain::PartModel& held = *problem.part(world.held()).model;
      movers_.push_back({held.boxes(), held.shape(), world.hold().X_PartTool.inverse()});
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
    for (int i = 0; i < world_.part_count(); ++i) {
      if (PartId(i) == world_.held()) continue;
      const domain::Part& part = problem_.part(PartId(i));
      const Pose X_WorldPart = world_.PartPose(PartId(i), X_WorldTool);
      if (lowest > HighestPoint(part, X_WorldPart) + kTravelGap) continue;
      if (Distance(mover.shape, X_WorldMover, part.model->shape(), X_WorldPart) < kTravelGap) {
        return false;
      }
    }
    return true;
  }

  const domain::Problem& problem_;
  const WorldModel& world_;
  std::vector<Mover> movers_;
};

// Whether the arm can go on from q along all lines, each from the end of the one before.
bool CanFollow(const domain::Workcell& workcell, JointVector q,
               const std::vector<Vector3>& corners) {
  for (const Vector3& corner : corners) {
    const LineResult line = FollowLine(workcell, q, corner);
    if (!line.path) return false;
    q = line.path->q.back();
  }
  return true;
}

// Joint values over the destination from which the lines can be followed, nearest first.
std::vector<JointVector> Destinations(const domain::Workcell& workcell,
                                      const TravelRequest& request, const JointRates& rates) {
  std::vector<JointVector> found;
  const kinematics::Arm& arm = workcell.arm();
  for (const auto& s : arm.Inverse(workcell.FlangeFor(request.X_WorldTool), request.from)) {
    for (const JointVector& q : arm.Representatives(s.q)) {
      if (CanFollow(workcell, q, request.corners)) found.push_back(q);
    }
  }
  const auto time = [&](const JointVector& q) { return MoveDuration(request.from, q, rates); };
  std::ranges::stable_sort(found, {}, time);
  return found;
}

std::string Where(const Vector3& p) {
  return fmt::format("({:.1f}, {:.1f}, {:.1f}) mm", 1e3 * p.x(), 1e3 * p.y(), 1e3 * p.z());
}

}  // namespace

TravelResult PlanTravel(const domain::Problem& problem, const WorldModel& world,
                        const TravelRequest& request) {
  const domain::Workcell& workcell = *problem.workcell;
  const JointRates rates = motion::RatesOf(workcell);
  const std::string where = Where(request.X_WorldTool.translation());
  const std::vector<JointVector> destinations = Destinations(workcell, request, rates);
  if (destinations.empty()) {
    return fmt::format("no configuration of the arm reaches {} and goes on straight from there",
                       where);
  }
  const Clearance clearance(problem, world, request.opening);
  for (const JointVector& q : destinations) {
    if (clearance.IsClear(request.from, q)) {
      return std::vector{SynchronizedMove(request.from, q, rates)};
    }
  }
  const JointVector& home = workcell.home();
  for (const JointVector& q : destinations) {
    if (clearance.IsClear(request.from, home) && clearance.IsClear(home, q)) {
      return std::vector{SynchronizedMove(request.from, home, rates),
                         SynchronizedMove(home, q, rates)};
    }
  }
  return fmt::format("every way to {} comes within {:.0f} mm of the table or a part", where,
                     1e3 * kTravelGap);
}

}  // namespace assay::exec
