#include "planner/constraint_posting/impossibility/planner_limits.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace assay::constraint_posting {

using domain::LocatedGoal;
using domain::Mating;
using domain::MatingId;
using domain::PartId;
using domain::Problem;

namespace {

bool IsMatedAtStart(const Problem& problem, MatingId mating) {
  return std::ranges::count(problem.assembled, mating) > 0;
}

std::string MatingText(const Problem& problem, const Mating& mating) {
  return fmt::format("{} is mated into {}", problem.part(mating.held).name,
                     problem.part(mating.fixed).name);
}

// The roles of one part in the start and in the goals.
struct PartRoles {
  std::vector<std::string> at_start = {};  // the part's matings at the start
  std::vector<std::string> goals = {};     // goals that do not hold at the start
  // true if the part is a fixed part in the goals' matings and has no other role
  bool is_only_fixed = true;
};

PartRoles RolesOf(const Problem& problem, PartId part) {
  PartRoles roles;
  for (MatingId id : problem.assembled) {
    const Mating& mating = problem.mating(id);
    if (mating.held == part || mating.fixed == part) {
      roles.at_start.push_back(MatingText(problem, mating));
    }
  }
  for (const domain::Goal& goal : problem.goals) {
    if (const auto* located = std::get_if<LocatedGoal>(&goal)) {
      if (located->part != part) continue;
      roles.goals.push_back(problem.part(part).name + " is to end in a stable pose");
      roles.is_only_fixed = false;
      continue;
    }
    const auto id = std::get<MatingId>(goal);
    const Mating& mating = problem.mating(id);
    if (IsMatedAtStart(problem, id) || (mating.held != part && mating.fixed != part)) continue;
    roles.goals.push_back(MatingText(problem, mating));
    if (mating.held == part) roles.is_only_fixed = false;
  }
  return roles;
}

void AddLimitsOf(const Problem& problem, PartId part, std::vector<std::string>& limits) {
  const std::string& name = problem.part(part).name;
  const PartRoles roles = RolesOf(problem, part);
  if (!roles.at_start.empty() && !roles.goals.empty()) {
    limits.push_back(
        fmt::format("{} at the start, and {}: this planner neither takes a mated part alone nor "
                    "carries mated parts together",
                    fmt::join(roles.at_start, ", "), fmt::join(roles.goals, ", ")));
  } else if (roles.goals.size() > 1) {
    limits.push_back(fmt::format(
        "{}: this planner neither takes a mated part alone nor carries mated parts together{}",
        fmt::join(roles.goals, ", "),
        roles.is_only_fixed ? "" : ", and mates nothing with a part that is on another part"));
  }
  if (roles.at_start.empty() && problem.part(part).resting.IsNone()) {
    limits.push_back(fmt::format(
        "{} starts in none of its stable poses: whether it leans, lies on another part or falls is "
        "not followed",
        name));
  }
}

}  // namespace

std::vector<std::string> LimitsOf(const Problem& problem, const RelaxedProblem& relaxed) {
  std::vector<std::string> limits;
  const domain::RobotId acting = problem.workcell->acting();
  if (!relaxed.IsPossibleWith({.constraints = relaxed.Constraints(), .robot = acting.index()})) {
    limits.push_back(fmt::format(
        "robot {} does not reach all places that the plan needs, and a plan uses only one robot",
        problem.workcell->robot().name));
  }
  for (std::size_t p = 0; p < problem.parts.size(); ++p) AddLimitsOf(problem, PartId(p), limits);
  return limits;
}

}  // namespace assay::constraint_posting
