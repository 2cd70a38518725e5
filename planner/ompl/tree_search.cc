#include "planner/motion/paths/tree_search.h"

#include <ompl/base/MotionValidator.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/datastructures/NearestNeighborsLinear.h>
#include <ompl/geometric/PathGeometric.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/util/Console.h>

#include <memory>
#include <stdexcept>
#include <utility>

namespace assay::motion {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;
using Problem = TreeSearch::Problem;

JointVector Read(const ob::State* state) {
  return Eigen::Map<const JointVector>(state->as<ob::RealVectorStateSpace::StateType>()->values);
}

void Write(const JointVector& point, ob::State* state) {
  Eigen::Map<JointVector>(state->as<ob::RealVectorStateSpace::StateType>()->values) = point;
}

class Sampler : public ob::StateSampler {
 public:
  Sampler(const ob::StateSpace* space, const Problem& problem)
      : StateSampler(space), problem_(problem) {}

  void sampleUniform(ob::State* state) override { Write(problem_.draw(), state); }
  void sampleUniformNear(ob::State*, const ob::State*, double) override { NeverAsked(); }
  void sampleGaussian(ob::State*, const ob::State*, double) override { NeverAsked(); }

 private:
  [[noreturn]] static void NeverAsked() {
    throw std::logic_error("RRT-Connect draws from all of the space");
  }

  const Problem& problem_;
};

class FreeMotions : public ob::MotionValidator {
 public:
  FreeMotions(ob::SpaceInformation* space, const Problem& problem)
      : MotionValidator(space), problem_(problem) {}

  bool checkMotion(const ob::State* from, const ob::State* to) const override {
    return problem_.is_free(Read(from), Read(to));
  }
  bool checkMotion(const ob::State* from, const ob::State* to,
                   std::pair<ob::State*, double>& /*last_valid*/) const override {
    return checkMotion(from, to);
  }

 private:
  const Problem& problem_;
};

std::shared_ptr<ob::SpaceInformation> SpaceOf(const Problem& problem) {
  const auto space = std::make_shared<ob::RealVectorStateSpace>(6);
  ob::RealVectorBounds bounds(6);
  for (int k = 0; k < 6; ++k) {
    bounds.setLow(k, problem.lower[k]);
    bounds.setHigh(k, problem.upper[k]);
  }
  space->setBounds(bounds);
  auto information = std::make_shared<ob::SpaceInformation>(space);
  // FreeMotions decides.
  information->setStateValidityChecker([](const ob::State*) { return true; });
  information->setMotionValidator(std::make_shared<FreeMotions>(information.get(), problem));
  information->setup();
  // The sampler is set after OMPL's set-up, which draws a hundred states for a projection that
  // RRT-Connect does not use. These draws must not come from the project's own stream.
  space->setStateSamplerAllocator(
      [&problem](const ob::StateSpace* of) { return std::make_shared<Sampler>(of, problem); });
  return information;
}

class RrtConnect : public TreeSearch {
 public:
  RrtConnect() { ompl::msg::noOutputHandler(); }

  JointPath FindPath(const Problem& problem) const override {
    const auto space = SpaceOf(problem);
    const auto definition = std::make_shared<ob::ProblemDefinition>(space);
    ob::ScopedState<> start(space->getStateSpace());
    ob::ScopedState<> goal(space->getStateSpace());
    Write(problem.start, start.get());
    Write(problem.goal, goal.get());
    definition->setStartAndGoalStates(start, goal);
    og::RRTConnect planner(space);
    // OMPL's other structures for nearest neighbours draw random pivots.
    planner.setNearestNeighbors<ompl::NearestNeighborsLinear>();
    planner.setRange(problem.longest_motion);
    planner.setProblemDefinition(definition);
    planner.setup();
    planner.solve(ob::PlannerTerminationCondition(problem.is_over));
    JointPath path;
    if (!definition->hasExactSolution()) return path;
    const auto& states = definition->getSolutionPath()->as<og::PathGeometric>()->getStates();
    for (const ob::State* state : states) path.push_back(Read(state));
    return path;
  }
};

}  // namespace
}  // namespace assay::motion

// The function that motion::TreeSearchOfOmpl looks up in the module.
extern "C" const assay::motion::TreeSearch* AssayTreeSearch() {
  static const assay::motion::RrtConnect search;
  return &search;
}
