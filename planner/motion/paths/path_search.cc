#include "planner/motion/paths/path_search.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "planner/base/random.h"
#include "planner/motion/collision/collision_scene.h"
#include "planner/motion/paths/tree_search.h"

namespace assay::motion {
namespace {

constexpr std::int64_t kUnlikely = 20;  // divisor of the budget where a path is unlikely
// Greatest length in the trees, metres as measured with JointWeights.
constexpr double kLongestMotion = 1.5;

// The weight of a joint is the greatest distance between its axis and a body that it moves.
// Distances in the trees are then roughly metres.
JointVector JointWeights(const CollisionScene& scene) {
  JointVector weights = JointVector::Zero();
  for (const Body& body : scene.bodies()) {
    for (int k = 0; k < 6; ++k) weights[k] = std::max(weights[k], body.reach[k]);
  }
  return weights;
}

// Points of the trees are the joints' values times their weights.
class WeightedJoints {
 public:
  explicit WeightedJoints(const CollisionScene& scene) : weights_(JointWeights(scene)) {}

  JointVector Posture(const JointVector& point) const { return point.cwiseQuotient(weights_); }
  JointVector Point(const JointVector& q) const { return weights_.cwiseProduct(q); }
  // The box is wider than the limits by rounding, which MotionCheck allows, too.
  JointVector Lower(const kinematics::Arm& arm) const {
    JointVector lower;
    for (int k = 0; k < 6; ++k) lower[k] = weights_[k] * (arm.limits()[k].lower - 1e-8);
    return lower;
  }
  JointVector Upper(const kinematics::Arm& arm) const {
    JointVector upper;
    for (int k = 0; k < 6; ++k) upper[k] = weights_[k] * (arm.limits()[k].upper + 1e-8);
    return upper;
  }

 private:
  JointVector weights_;
};

// Draws postures from the project's own random stream.
class PostureSampler {
 public:
  PostureSampler(const CollisionScene& scene, const PathRequest& request)
      : scene_(scene), request_(request), random_(request.seed, "gross motion") {}

  JointVector Draw() {
    JointVector q = Uniform();
    while (request_.rules.upright && !SetUpright(q)) q = Uniform();
    return q;
  }

 private:
  JointVector Uniform() {
    JointVector q;
    for (int k = 0; k < 6; ++k) {
      const kinematics::JointLimits& limits = scene_.arm().limits()[k];
      q[k] = random_.Uniform(limits.lower, limits.upper);
    }
    return q;
  }

  // Turns the tool by the least angle, about the arm's center at its present place, until it is
  // upright. Returns false if the arm cannot do this.
  bool SetUpright(JointVector& q) {
    const domain::Workcell& workcell = scene_.workcell();
    const Vector3 up_Flange =
        workcell.gripper().X_FlangeTool().linear() * request_.rules.upright->up_Tool;
    const Vector3 up_Base = workcell.X_WorldBase().linear().transpose() * Vector3::UnitZ();
    const Pose X_BaseFlange = scene_.arm().Forward(q);
    const Vector3 center = X_BaseFlange * scene_.arm().p_FlangeCenter();
    Pose upright = X_BaseFlange;
    upright.linear() =
        Eigen::Quaterniond::FromTwoVectors(X_BaseFlange.linear() * up_Flange, up_Base) *
        X_BaseFlange.linear();
    upright.translation() = center - upright.linear() * scene_.arm().p_FlangeCenter();
    std::vector<JointVector> found;
    for (const auto& solution : scene_.arm().Inverse(upright, q)) {
      for (const JointVector& r : scene_.arm().Representatives(solution.q)) found.push_back(r);
    }
    if (found.empty()) return false;
    q = found[static_cast<std::size_t>(random_.Index(static_cast<int>(found.size())))];
    return true;
  }

  const CollisionScene& scene_;
  const PathRequest& request_;
  RandomStream random_;
};

// Counts which obstructions ended motions, and how often.
class ObstructionTally {
 public:
  void Count(const Obstruction& obstruction) {
    for (auto& [known, count] : counts_) {
      if (known.kind != obstruction.kind || known.pair != obstruction.pair) continue;
      ++count;
      return;
    }
    counts_.emplace_back(obstruction, 1);
  }
  const Obstruction& MostFrequent() const {
    return std::ranges::max_element(counts_, {}, &std::pair<Obstruction, int>::second)->first;
  }

 private:
  std::vector<std::pair<Obstruction, int>> counts_;  // by the order of their first occurrence
};

// Returns RRT-Connect's path; empty if the budget was spent before one was found.
JointPath Connect(MotionCheck& check, ObstructionTally& tally, const PathRequest& request,
                  std::int64_t budget) {
  const CollisionScene& scene = check.scene();
  const WeightedJoints joints(scene);
  PostureSampler sampler(scene, request);
  const std::int64_t limit = check.postures() + budget;
  const auto is_free = [&](const JointVector& from, const JointVector& to) {
    const auto obstruction = check.FindObstruction(joints.Posture(from), joints.Posture(to));
    if (obstruction) tally.Count(*obstruction);
    return !obstruction;
  };
  JointPath path =
      TreeSearchOfOmpl().FindPath({.lower = joints.Lower(scene.arm()),
                                   .upper = joints.Upper(scene.arm()),
                                   .start = joints.Point(request.from),
                                   .goal = joints.Point(request.to),
                                   .longest_motion = kLongestMotion,
                                   .draw = [&] { return joints.Point(sampler.Draw()); },
                                   .is_free = is_free,
                                   .is_over = [&] { return check.postures() >= limit; }});
  if (path.empty()) return path;
  for (JointVector& point : path) point = joints.Posture(point);
  path.front() = request.from;
  path.back() = request.to;
  return path;
}

PathFailure Failure(PathFailure::Reason reason, const MotionCheck& check,
                    const Obstruction& obstruction) {
  const std::int64_t postures = check.postures();
  const std::string what = Describe(check.scene(), check.rules(), obstruction);
  switch (reason) {
    case PathFailure::Reason::kStart:
      return {reason, obstruction, "at the start, " + what, postures};
    case PathFailure::Reason::kGoal:
      return {reason, obstruction, "at the goal, " + what, postures};
    case PathFailure::Reason::kConfiguration:
      return {reason, obstruction,
              fmt::format("the goal is in another configuration of the arm, into which no upright "
                          "path was found after {} postures; the most frequent obstacle: {}",
                          postures, what),
              postures};
    case PathFailure::Reason::kBudget:
      break;
  }
  return {reason, obstruction,
          fmt::format("no path was found after {} postures; the most frequent obstacle: {}",
                      postures, what),
          postures};
}

// Upright postures of two configurations meet only where the arm is singular: stretched, or with
// the forearm in line with the upright direction, or over its own axis.
bool NeedsAnotherConfiguration(const CollisionScene& scene, const PathRequest& request) {
  return request.rules.upright &&
         scene.arm().IndicatorsOf(request.from) != scene.arm().IndicatorsOf(request.to);
}

}  // namespace

PathResult FindPath(const CollisionScene& scene, const PathRequest& request) {
  MotionCheck check(scene, request.rules);
  if (const auto obstruction = check.FindObstruction(request.from, request.from)) {
    return Failure(PathFailure::Reason::kStart, check, *obstruction);
  }
  if (const auto obstruction = check.FindObstruction(request.to, request.to)) {
    return Failure(PathFailure::Reason::kGoal, check, *obstruction);
  }
  ObstructionTally tally;
  const auto straight = check.FindObstruction(request.from, request.to);
  if (!straight) return JointPath{request.from, request.to};
  tally.Count(*straight);
  const bool is_elsewhere = NeedsAnotherConfiguration(scene, request);
  const std::int64_t budget = is_elsewhere ? request.budget / kUnlikely : request.budget;
  const JointPath path = Connect(check, tally, request, budget);
  if (path.empty()) {
    const auto reason =
        is_elsewhere ? PathFailure::Reason::kConfiguration : PathFailure::Reason::kBudget;
    return Failure(reason, check, tally.MostFrequent());
  }
  return Shortened(path, check, request.shortening);
}

}  // namespace assay::motion
