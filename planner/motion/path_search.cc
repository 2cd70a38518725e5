#include "planner/motion/path_search.h"

#include <fmt/format.h>
#include <ompl/base/MotionValidator.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/datastructures/NearestNeighborsLinear.h>
#include <ompl/geometric/PathGeometric.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/util/Console.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "planner/base/check.h"
#include "planner/base/random.h"

namespace assay::motion {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;

constexpr std::int64_t kUnlikely = 20;  // the budget's divisor where a path is unlikely
constexpr double kLongestMotion = 1.5;  // of the trees, metres as JointWeights measures

// Joints count by how far they can move the flange: OMPL's distances are then near to metres.
JointVector JointWeights(const CollisionScene& scene) {
  JointVector weights = JointVector::Zero();
  for (const Body& body : scene.bodies()) {
    for (int k = 0; k < 6; ++k) weights[k] = std::max(weights[k], body.reach[k]);
  }
  return weights;
}

// OMPL's states hold the joints' values times their weights.
class WeightedJoints {
 public:
  explicit WeightedJoints(const CollisionScene& scene) : weights_(JointWeights(scene)) {}

  JointVector Read(const ob::State* state) const {
    const double* values = state->as<ob::RealVectorStateSpace::StateType>()->values;
    return Eigen::Map<const JointVector>(values).cwiseQuotient(weights_);
  }
  void Write(const JointVector& q, ob::State* state) const {
    Eigen::Map<JointVector> values(state->as<ob::RealVectorStateSpace::StateType>()->values);
    values = weights_.cwiseProduct(q);
  }
  std::shared_ptr<ob::RealVectorStateSpace> Space(const kinematics::Arm& arm) const {
    auto space = std::make_shared<ob::RealVectorStateSpace>(6);
    ob::RealVectorBounds bounds(6);
    for (int k = 0; k < 6; ++k) {
      // Wider than the limits by rounding, which MotionCheck forgives, too.
      bounds.setLow(k, weights_[k] * (arm.limits()[k].lower - 1e-8));
      bounds.setHigh(k, weights_[k] * (arm.limits()[k].upper + 1e-8));
    }
    space->setBounds(bounds);
    return space;
  }

 private:
  JointVector weights_;
};

// Draws postures from our own stream.
class PostureSampler : public ob::StateSampler {
 public:
  PostureSampler(const ob::StateSpace* space, const CollisionScene& scene,
                 const PathRequest& request)
      : StateSampler(space),
        scene_(scene),
        joints_(scene),
        request_(request),
        random_(request.seed, "gross motion") {}

  void sampleUniform(ob::State* state) override {
    JointVector q = Uniform();
    while (request_.rules.upright && !SetUpright(q)) q = Uniform();
    joints_.Write(q, state);
  }
  // RRT-Connect never asks for these.
  void sampleUniformNear(ob::State*, const ob::State*, double) override { ASSAY_CHECK(false); }
  void sampleGaussian(ob::State*, const ob::State*, double) override { ASSAY_CHECK(false); }

 private:
  JointVector Uniform() {
    JointVector q;
    for (int k = 0; k < 6; ++k) {
      const kinematics::JointLimits& limits = scene_.arm().limits()[k];
      q[k] = random_.Uniform(limits.lower, limits.upper);
    }
    return q;
  }

  // Turns the tool until it is upright, by the least angle, about the wrist's centre as it stands.
  // False if the arm cannot.
  bool SetUpright(JointVector& q) {
    const domain::Workcell& workcell = scene_.workcell();
    const Vector3 up_Flange =
        workcell.gripper().X_FlangeTool().linear() * request_.rules.upright->up_Tool;
    const Vector3 up_Base = workcell.X_WorldBase().linear().transpose() * Vector3::UnitZ();
    const Pose X_BaseFlange = scene_.arm().Forward(q);
    const Vector3 wrist = X_BaseFlange * Vector3(0, 0, -scene_.arm().geometry().d6);
    Pose upright = X_BaseFlange;
    upright.linear() =
        Eigen::Quaterniond::FromTwoVectors(X_BaseFlange.linear() * up_Flange, up_Base) *
        X_BaseFlange.linear();
    upright.translation() = wrist + upright.linear() * Vector3(0, 0, scene_.arm().geometry().d6);
    std::vector<JointVector> found;
    for (const auto& solution : scene_.arm().Inverse(upright, q)) {
      for (const JointVector& r : scene_.arm().Representatives(solution.q)) found.push_back(r);
    }
    if (found.empty()) return false;
    q = found[static_cast<std::size_t>(random_.Index(static_cast<int>(found.size())))];
    return true;
  }

  const CollisionScene& scene_;
  WeightedJoints joints_;
  const PathRequest& request_;
  RandomStream random_;
};

// What ended motions, and how often.
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
  std::vector<std::pair<Obstruction, int>> counts_;  // in the order of their first
};

// MotionCheck in OMPL's terms.
class FreeMotions : public ob::MotionValidator {
 public:
  FreeMotions(ob::SpaceInformation* space, MotionCheck& check, ObstructionTally& tally)
      : MotionValidator(space), joints_(check.scene()), check_(check), tally_(tally) {}

  bool checkMotion(const ob::State* from, const ob::State* to) const override {
    const auto obstruction = check_.FindObstruction(joints_.Read(from), joints_.Read(to));
    if (obstruction) tally_.Count(*obstruction);
    return !obstruction;
  }
  bool checkMotion(const ob::State* from, const ob::State* to,
                   std::pair<ob::State*, double>& /*last_valid*/) const override {
    return checkMotion(from, to);
  }

 private:
  WeightedJoints joints_;
  MotionCheck& check_;
  ObstructionTally& tally_;
};

std::shared_ptr<ob::SpaceInformation> SpaceOf(MotionCheck& check, ObstructionTally& tally,
                                              const PathRequest& request) {
  const CollisionScene& scene = check.scene();
  const auto space = WeightedJoints(scene).Space(scene.arm());
  space->setStateSamplerAllocator([&scene, &request](const ob::StateSpace* of) {
    return std::make_shared<PostureSampler>(of, scene, request);
  });
  auto information = std::make_shared<ob::SpaceInformation>(space);
  information->setStateValidityChecker([](const ob::State*) { return true; });  // see FreeMotions
  information->setMotionValidator(std::make_shared<FreeMotions>(information.get(), check, tally));
  information->setup();
  return information;
}

// RRT-Connect's path; empty if the budget was spent before.
JointPath Connect(MotionCheck& check, ObstructionTally& tally, const PathRequest& request,
                  std::int64_t budget) {
  ompl::msg::noOutputHandler();
  const WeightedJoints joints(check.scene());
  const auto space = SpaceOf(check, tally, request);
  const auto problem = std::make_shared<ob::ProblemDefinition>(space);
  ob::ScopedState<> start(space->getStateSpace());
  ob::ScopedState<> goal(space->getStateSpace());
  joints.Write(request.from, start.get());
  joints.Write(request.to, goal.get());
  problem->setStartAndGoalStates(start, goal);
  og::RRTConnect planner(space);
  planner.setNearestNeighbors<ompl::NearestNeighborsLinear>();  // the others draw random pivots
  planner.setRange(kLongestMotion);
  planner.setProblemDefinition(problem);
  planner.setup();
  const std::int64_t limit = check.postures() + budget;
  planner.solve(ob::PlannerTerminationCondition([&] { return check.postures() >= limit; }));
  JointPath path;
  if (!problem->hasExactSolution()) return path;
  for (const ob::State* state : problem->getSolutionPath()->as<og::PathGeometric>()->getStates()) {
    path.push_back(joints.Read(state));
  }
  path.front() = request.from;
  path.back() = request.to;
  return path;
}

PathFailure Failure(PathFailure::Reason reason, const MotionCheck& check,
                    const Obstruction& obstruction) {
  const std::string what = Describe(check.scene(), check.rules(), obstruction);
  switch (reason) {
    case PathFailure::Reason::kStart:
      return {reason, obstruction, "at the start, " + what};
    case PathFailure::Reason::kGoal:
      return {reason, obstruction, "at the goal, " + what};
    case PathFailure::Reason::kConfiguration:
      return {reason, obstruction,
              fmt::format("the goal is in another configuration of the arm, into which no upright "
                          "path was found, looking at {} postures; most often, {}",
                          check.postures(), what)};
    case PathFailure::Reason::kBudget:
      return {reason, obstruction,
              fmt::format("no path was found, looking at {} postures; most often, {}",
                          check.postures(), what)};
  }
  ASSAY_CHECK(false, "no such reason");
}

// Upright postures of two configurations meet where the arm is singular: stretched, or with the
// forearm in line with what is kept upright, or over its own axis.
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
