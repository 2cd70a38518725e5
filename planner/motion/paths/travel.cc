#include "planner/motion/paths/travel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "planner/geometry/box.h"
#include "planner/geometry/collision.h"
#include "planner/geometry/hull.h"
#include "planner/motion/collision/collision_scene.h"
#include "planner/motion/paths/joint_trajectory.h"
#include "planner/motion/paths/path_search.h"
#include "planner/motion/paths/straight_line.h"

namespace assay::motion {
namespace {

using geometry::CollisionShape;

constexpr double kLookTurn = 0.05;  // greatest turn of a joint between tested postures, radians

double LowestVertex(const std::vector<Vector3>& vertices, const Pose& X_WorldFrame) {
  const auto height = [&](const Vector3& p) { return (X_WorldFrame * p).z(); };
  return height(*std::ranges::min_element(vertices, {}, height));
}

double HighestPoint(const domain::Part& part, const Pose& X_WorldPart) {
  double highest = 0;
  for (const Vector3& vertex : part.model->corners()) {
    highest = std::max(highest, (X_WorldPart * vertex).z());
  }
  return highest;
}

// A rigid body that moves with the tool.
struct Mover {
  std::vector<Vector3> vertices;
  CollisionShape shape;
  Pose X_ToolMover;
};

// Tests whether the load of the arm stays clear of everything else.
class Clearance {
 public:
  Clearance(const domain::Problem& problem, const Surroundings& surroundings)
      : problem_(problem), surroundings_(surroundings) {
    const kinematics::Gripper& gripper = problem.workcell->gripper();
    std::vector<geometry::Box> hand = gripper.HandBoxes();
    const std::vector<geometry::Box> fingers =
        gripper.FingerBoxes(std::clamp(surroundings.opening, 0.0, gripper.max_opening()));
    hand.insert(hand.end(), fingers.begin(), fingers.end());
    movers_.push_back(
        {geometry::VerticesOf(geometry::HullsOf(hand)), CollisionShape(hand), Pose::Identity()});
    if (surroundings.held) {
      const domain::PartModel& held = *problem.part(surroundings.held->part).model;
      movers_.push_back({geometry::VerticesOf(held.pieces()), held.shape(),
                         surroundings.held->X_PartTool.inverse()});
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
    const double lowest = LowestVertex(mover.vertices, X_WorldMover);
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

// Tests the whole arm with all that it carries: against other robots always, and against everything
// if the request says so. On lines only the arm's links are tested, since what the arm carries is
// tested at its work elsewhere.
class ArmWatch {
 public:
  ArmWatch(const domain::Problem& problem, const Surroundings& surroundings,
           const TravelRequest& request)
      : request_(request), scene_(problem, surroundings) {
    using Bodies = MotionRules::Bodies;
    on_lines_.push_back(CheckOf(Bodies::kRobots));
    if (request.is_arm_watched) on_lines_.push_back(CheckOf(Bodies::kArm));
    on_ways_.push_back(CheckOf(request.is_arm_watched ? Bodies::kAll : Bodies::kRobots));
  }

  bool IsClearOnLines(const JointPath& path) { return IsClear(path, on_lines_); }
  bool IsClear(const JointPath& path) { return IsClear(path, on_ways_); }
  PathResult FindPathTo(const JointVector& q) const {
    constexpr std::int64_t kBudget = 20'000;  // postures
    return FindPath(scene_, {.from = request_.from,
                             .to = q,
                             .rules = {.clearance = kTravelGap, .given = {request_.from, q}},
                             .budget = kBudget});
  }
  // Returns what obstructed the last way; empty if it was free.
  const std::string& in_the_way() const { return in_the_way_; }

 private:
  MotionCheck CheckOf(MotionRules::Bodies bodies) const {
    return {scene_, {.clearance = kTravelGap, .given = {request_.from}, .bodies = bodies}};
  }

  bool IsClear(const JointPath& path, std::vector<MotionCheck>& checks) {
    for (MotionCheck& check : checks) {
      for (std::size_t i = 0; i + 1 < path.size(); ++i) {
        const auto obstruction = check.FindObstruction(path[i], path[i + 1]);
        if (!obstruction) continue;
        in_the_way_ = Describe(scene_, check.rules(), *obstruction);
        return false;
      }
    }
    return true;
  }

  const TravelRequest& request_;
  CollisionScene scene_;
  std::vector<MotionCheck> on_lines_;
  std::vector<MotionCheck> on_ways_;
  std::string in_the_way_;
};

std::string Where(const Vector3& p) {
  return fmt::format("({:.1f}, {:.1f}, {:.1f}) mm", 1e3 * p.x(), 1e3 * p.y(), 1e3 * p.z());
}

class TravelSearch {
 public:
  TravelSearch(const domain::Problem& problem, const Surroundings& surroundings,
               const TravelRequest& request)
      : workcell_(*problem.workcell), request_(request), clearance_(problem, surroundings) {
    if (request.is_arm_watched || workcell_.robots().size() > 1) {
      arm_.emplace(problem, surroundings, request);
    }
  }

  TravelResult Plan() {
    std::vector<JointVector> destinations;  // postures from which the lines can be followed
    for (const JointVector& q : PosturesAt(workcell_, request_.X_WorldTool, request_.from)) {
      const auto lines = FollowLines(workcell_, q, request_.corners, request_.line_step);
      if (!lines || (arm_ && !arm_->IsClearOnLines(*lines))) continue;
      if (IsFree({request_.from, q})) return JointPath{request_.from, q};
      destinations.push_back(q);
    }
    for (const JointVector& q : destinations) {
      if (const JointPath by_home = {request_.from, workcell_.home(), q}; IsFree(by_home)) {
        return by_home;
      }
    }
    if (arm_) {
      for (const JointVector& q : destinations) {
        PathResult around = arm_->FindPathTo(q);
        if (auto* path = std::get_if<JointPath>(&around)) return std::move(*path);
      }
    }
    return WhyNot(destinations.empty());
  }

 private:
  bool IsFree(const JointPath& path) {
    for (std::size_t i = 0; i + 1 < path.size(); ++i) {
      if (!clearance_.IsClear(path[i], path[i + 1])) return false;
    }
    return !arm_ || arm_->IsClear(path);
  }

  std::string WhyNot(bool has_no_destination) const {
    const std::string where = Where(request_.X_WorldTool.translation());
    if (arm_ && !arm_->in_the_way().empty()) {
      return fmt::format("no way to {} that was tried is free: {}", where, arm_->in_the_way());
    }
    if (has_no_destination) {
      return fmt::format(
          "no configuration of the arm reaches {} and can follow the next straight line", where);
    }
    return fmt::format("every way to {} comes within {:.0f} mm of the table or a part", where,
                       1e3 * kTravelGap);
  }

  const domain::Workcell& workcell_;
  const TravelRequest& request_;
  const Clearance clearance_;
  std::optional<ArmWatch> arm_;  // only if the arm is watched
};

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

std::optional<JointPath> FollowLines(const domain::Workcell& workcell, const JointVector& q,
                                     const std::vector<Vector3>& corners, double step) {
  JointPath path = {q};
  for (const Vector3& corner : corners) {
    const LineResult line = FollowLine(workcell, path.back(), corner, step);
    if (!line.path) return std::nullopt;
    path.insert(path.end(), line.path->q.begin() + 1, line.path->q.end());
  }
  return path;
}

TravelResult PlanTravel(const domain::Problem& problem, const Surroundings& surroundings,
                        const TravelRequest& request) {
  return TravelSearch(problem, surroundings, request).Plan();
}

TravelResult PlanWayHome(const domain::Problem& problem, const Surroundings& surroundings,
                         const JointVector& from) {
  const CollisionScene scene(problem, surroundings);
  PathResult found = FindPath(
      scene, {.from = from, .to = problem.workcell->home(), .rules = {.clearance = kTravelGap}});
  if (auto* path = std::get_if<JointPath>(&found)) return std::move(*path);
  return "no way home: " + std::get<PathFailure>(found).what;
}

}  // namespace assay::motion
