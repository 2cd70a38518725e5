#include "planner/constraint_posting/impossibility/impossibility.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numbers>

#include "planner/constraint_posting/impossibility/constraint_situation.h"
#include "planner/constraint_posting/impossibility/constraint_text.h"
#include "planner/constraint_posting/impossibility/impossibility_check.h"
#include "planner/constraint_posting/impossibility/near_miss.h"
#include "planner/constraint_posting/impossibility/planner_limits.h"
#include "planner/domain/actions/condition.h"

namespace assay::constraint_posting {

using domain::Problem;

namespace {

std::string RobotsText(const Problem& problem) {
  std::vector<std::string> names;
  for (const domain::Robot& robot : problem.workcell->robots()) names.push_back(robot.name);
  return names.size() == 1 ? "the robot's hand"
                           : fmt::format("the hands of {}", fmt::join(names, ", "));
}

std::string GraspsText(const RelaxedProblem& relaxed) {
  std::vector<std::string> counts;
  for (const auto& hand : relaxed.hands()) {
    const std::string& robot = hand->problem().workcell->robot().name;
    for (const domain::Part& part : hand->problem().parts) {
      counts.push_back(fmt::format("{} of {}{}", part.grasps->size(), part.name,
                                   robot.empty() ? "" : " by " + robot));
    }
  }
  return fmt::format("{}", fmt::join(counts, ", "));
}

std::vector<std::string> Hypotheses(const Problem& problem, const RelaxedProblem& relaxed) {
  const domain::Workcell& workcell = *problem.workcell;
  return {
      fmt::format(
          "actions: pickup, putdown and assemble by {}, in any configuration of the arm; straight "
          "down from {:.4g} mm above the table, and then {:.4g} mm along the tool; each part is in "
          "one hand, rests, or is mated; hand and parts stay above the height of the table, also "
          "beside it",
          RobotsText(problem), 1e3 * workcell.rules().safe_height,
          1e3 * workcell.rules().approach_distance),
      fmt::format("grasps: {}; between parallel faces, approach directions every {:.4g} deg; on "
                  "round sides, along and across the axis",
                  GraspsText(relaxed), workcell.rules().approach_step * 180 / std::numbers::pi),
      fmt::format("places: the starting places of the parts, and the {} placements of workcell "
                  "{}, in the parts' stable poses; errors are ignored",
                  workcell.placements().size(), workcell.name())};
}

// A deletion filter (Chinneck and Dravnieks 1991). It leaves out each constraint whose removal does
// not make the problem possible. The rest is minimal.
std::vector<Constraint> MinimalConflict(const RelaxedProblem& relaxed) {
  std::vector<Constraint> conflict = relaxed.Constraints();
  for (const Constraint& candidate : relaxed.Constraints()) {
    std::vector<Constraint> fewer = conflict;
    std::erase(fewer, candidate);
    if (!relaxed.IsPossibleWith({fewer})) conflict = std::move(fewer);
  }
  return conflict;
}

bool IsMinimalConflict(const RelaxedProblem& relaxed, const std::vector<Constraint>& conflict) {
  return !conflict.empty() && !relaxed.IsPossibleWith({conflict}) &&
         std::ranges::all_of(conflict, [&](const Constraint& constraint) {
           std::vector<Constraint> fewer = conflict;
           std::erase(fewer, constraint);
           return relaxed.IsPossibleWith({fewer});
         });
}

// Returns the problem in which an arm may change its configuration on a straight line. A real arm
// can do so where its joints can turn while the tool stands still, at a singular posture.
Problem InAnyConfiguration(const Problem& problem) {
  domain::WorkcellRules rules = problem.workcell->rules();
  rules.keeps_configuration = false;
  Problem other = problem;
  other.workcell = problem.workcell->WithRules(rules);
  return other;
}

std::vector<std::string> LimitsMet(const Problem& problem, const RelaxedProblem& possible) {
  std::vector<std::string> limits = LimitsOf(problem, possible);
  const RelaxedProblem straight(problem, RelaxedProblem::Grasps::kListed);
  if (!straight.IsPossibleWith({straight.Constraints()})) {
    limits.push_back(
        "this planner's arms keep their configuration on the straight lines of an action: within "
        "their joint limits they do so on none of the lines that a plan could use");
  }
  return limits;
}

}  // namespace

ImpossibilityAnswer ProveImpossible(const Problem& given) {
  const Problem problem = InAnyConfiguration(given);
  if (problem.actions != domain::StandardActions()) {
    return {{}, {"no proof covers actions other than those that every robot can do"}};
  }
  const RelaxedProblem listed(problem, RelaxedProblem::Grasps::kListed);
  if (listed.IsPossibleWith({listed.Constraints()})) return {{}, LimitsMet(given, listed)};
  const RelaxedProblem relaxed(problem, RelaxedProblem::Grasps::kWithMisses);
  const std::vector<Constraint> conflict = MinimalConflict(relaxed);
  Impossibility proof = {.hypotheses = Hypotheses(problem, listed),
                         .attainable = listed.AttainableWith({listed.Constraints()})};
  if (!IsMinimalConflict(relaxed, conflict) || !Confirms(problem, proof.attainable)) {
    return {{}, {"a proof that no plan exists could not be confirmed"}};
  }
  for (const Constraint& constraint : conflict) {
    const std::optional<plan::Reason> miss = NearMissOf(relaxed, conflict, constraint);
    proof.conflict.push_back(
        {Describe(relaxed, constraint), miss ? miss->situation : SituationOf(relaxed, constraint)});
    if (miss) proof.near_misses.push_back(*miss);
  }
  return {std::move(proof), {}};
}

}  // namespace assay::constraint_posting
