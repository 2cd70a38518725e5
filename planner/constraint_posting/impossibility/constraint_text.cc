#include "planner/constraint_posting/impossibility/constraint_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <set>

#include "planner/base/check.h"
#include "planner/domain/matings/mating_classes.h"

namespace assay::constraint_posting {

using domain::GraspCondition;
using domain::Mating;
using domain::Part;
using domain::Problem;
using domain::StablePoseId;
using Kind = Constraint::Kind;

namespace {

enum class Side { kHeld, kFixed };

std::string FeatureList(const Mating& mating, Side side) {
  std::vector<int> numbers;
  for (const auto& [held, fixed] : mating.features) {
    numbers.push_back((side == Side::kHeld ? held : fixed).index());
  }
  return fmt::format("{}", fmt::join(numbers, ", "));
}

// Robots may have different grippers, so the texts may differ.
std::string DescribeOfEach(const std::vector<std::unique_ptr<RelaxedHand>>& hands,
                           GraspCondition condition) {
  std::vector<std::string> by_robot;
  std::set<std::string> distinct;
  for (const auto& hand : hands) {
    const std::string text = domain::Describe(hand->problem(), condition);
    distinct.insert(text);
    by_robot.push_back(fmt::format("{}: {}", hand->problem().workcell->robot().name, text));
  }
  return distinct.size() == 1 ? *distinct.begin() : fmt::format("{}", fmt::join(by_robot, "; "));
}

std::string DescribeLocated(const Problem& problem, const domain::LocatedGoal& goal) {
  std::vector<std::string> poses;
  for (StablePoseId pose : goal.stable_poses) {
    poses.push_back(PoseName(problem.part(goal.part), pose));
  }
  return fmt::format("{} is to end {}", problem.part(goal.part).name, fmt::join(poses, " or "));
}

std::string DescribeMating(const Problem& problem, const Mating& mating, Kind kind) {
  const std::string& held = problem.part(mating.held).name;
  const std::string& fixed = problem.part(mating.fixed).name;
  if (kind == Kind::kFeaturesOffPads) {
    return fmt::format("the pads leave features {} of {} free while it is mated",
                       FeatureList(mating, Side::kHeld), held);
  }
  if (kind == Kind::kFeaturesOffTable) {
    return fmt::format("the table leaves features {} of {} free while {} is mated with it",
                       FeatureList(mating, Side::kFixed), fixed, held);
  }
  return fmt::format(
      "the mating vector of {} into {} points down into the friction cone (friction {:.4g}) and "
      "ends above the table",
      held, fixed, domain::LeastMatingFriction(problem));
}

}  // namespace

std::string PoseName(const Part& part, StablePoseId id) {
  const domain::StablePose& pose = part.model->stable_poses()[id.index()];
  return pose.name.empty() ? pose.label : pose.name;
}

std::string Describe(const RelaxedProblem& relaxed, const Constraint& constraint) {
  const Problem& problem = relaxed.problem();
  const int index = constraint.index;
  switch (constraint.kind) {
    case Kind::kGraspCondition:
      return DescribeOfEach(relaxed.hands(), domain::kGraspConditions[index]);
    case Kind::kGrasps:
      return fmt::format("{} has no two parallel faces between which a hand can hold it",
                         problem.parts[index].name);
    case Kind::kStart:
      return fmt::format("{} starts {}", problem.parts[index].name,
                         PoseName(problem.parts[index], problem.parts[index].resting));
    case Kind::kInTheWay:
      return fmt::format("{} is in the way where it starts", problem.parts[index].name);
    case Kind::kLocated:
      return DescribeLocated(problem, std::get<domain::LocatedGoal>(problem.goals[index]));
    case Kind::kFeaturesOffTable:
    case Kind::kFrictionCone:
    case Kind::kFeaturesOffPads:
      return DescribeMating(problem, problem.matings[index], constraint.kind);
  }
  ASSAY_CHECK(false, "a kind of constraint that the switch does not know");
  return {};
}

}  // namespace assay::constraint_posting
