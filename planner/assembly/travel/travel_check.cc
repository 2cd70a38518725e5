#include "planner/assembly/travel/travel_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "planner/algebra/expression/text.h"
#include "planner/assembly/travel/plan_walk.h"
#include "planner/assembly/travel/travel_search.h"
#include "planner/assembly/travel/way_conditions.h"
#include "planner/motion/paths/straight_line.h"

namespace assay::assembly {
namespace {

using geometry::Pose;
using kinematics::JointVector;
using plan::StepId;

constexpr double kSamePosture = 1e-6;  // tolerance for equal postures, radians
constexpr char kNoWay[] = "the plan has ways of the arm, but none to this step";
constexpr char kNoWayHome[] = "the plan has ways of the arm, but none home (homing)";
constexpr double kSameClaim = 1e-6;  // tolerance for equal claims, metres or radians

bool IsAtEnds(const plan::Travel& travel, const PlanWalk& walk, const plan::ToolRoute& route,
              std::vector<std::string>& flaws) {
  const domain::Workcell& workcell = walk.workcell();
  const auto high = [&](bool is_high, const Pose& X_WorldTool) {
    return is_high ? plan::AtSafeHeight(workcell, X_WorldTool) : X_WorldTool;
  };
  const Pose start = high(travel.is_usual && walk.rises(), walk.left());
  const Pose end = high(travel.is_usual && !route.to_work.empty(), route.poised);
  if (!plan::PosesAgree(motion::ToolAt(workcell, travel.path.front()), start)) {
    flaws.push_back("the path does not start where the step before leaves the tool");
  }
  if (!plan::PosesAgree(motion::ToolAt(workcell, travel.path.back()), end)) {
    flaws.push_back("the path does not end where the tool is poised");
  }
  return flaws.empty();
}

// Returns true if the two claims differ only in the bound.
bool IsSaidOf(const plan::CertifiedPrecondition& claim, plan::CertifiedPrecondition other) {
  other.expression = algebra::Text(algebra::Expression(claim.bound));
  other.bound = other.margin = claim.bound;
  return claim == other;
}

// Adds a flaw for each claim about a way that differs from the recomputed one.
void CheckClaims(const WayCertainty& certainty, plan::Circumstance circumstance,
                 const plan::PlannedStep& step, std::vector<std::string>& flaws) {
  const auto anew = WayConditions(certainty, circumstance);
  for (const plan::CertifiedPrecondition& claim : step.certificate.preconditions) {
    if (!IsWayCondition(claim.condition) || claim.circumstance != circumstance) continue;
    const auto own =
        std::ranges::find(anew, claim.condition, &plan::CertifiedPrecondition::condition);
    if (own == anew.end() || claim.bound > own->bound + kSameClaim) {
      flaws.push_back(fmt::format(
          "the file says that {} is above {:.6g}, but the new computation does not confirm this",
          claim.condition.name(), claim.bound));
    } else if (!IsSaidOf(claim, *own)) {
      flaws.push_back(
          fmt::format("{} in the file differs from the new computation", claim.condition.name()));
    }
  }
}

// Returns the flaws of a travel. Updates `posture` to the posture after the step, or to none if
// that is unknown.
std::vector<std::string> FlawsOfTravel(const plan::Travel& travel, const PlanWalk& walk, StepId id,
                                       std::optional<JointVector>& posture) {
  if (travel.path.size() < 2) return {"a path of less than two postures"};
  std::vector<std::string> flaws;
  if (!posture) {
    posture = motion::PostureLike(walk.workcell(), walk.left(), travel.path.front());
    if (!posture)
      return {"the step before does not leave the arm in a posture in which the path can start"};
  }
  TravelSearch search(walk, id, *std::exchange(posture, std::nullopt));
  const std::optional<Way> way = search.WayBy(travel);
  if (!IsAtEnds(travel, walk, search.route(), flaws)) return flaws;
  if (!way) return {search.in_the_way().text};
  if (!(travel.path.front() - way->rise.back()).isZero(kSamePosture)) {
    flaws.push_back("the path does not start in the posture in which the arm then is");
  }
  if (travel.clearance < search.clearance()) {
    flaws.push_back(fmt::format("a clearance of {:.2f} mm is less than {:.2f} mm",
                                1e3 * travel.clearance, 1e3 * search.clearance()));
  }
  const auto certainty = search.CertaintyOf(*way, travel.clearance);
  if (!certainty) {
    flaws.push_back(search.in_the_way().text);
    return flaws;
  }
  const StepId owner = id.IsNone() ? walk.plan().ExecutionOrder().back() : id;
  CheckClaims(*certainty, WayOf(id), walk.plan().step(owner), flaws);
  posture = way->after();
  return flaws;
}

// Returns whether the plan says anything about the arm's ways. If it does, it must contain all the
// ways.
bool HasWays(const plan::Plan& plan) {
  const auto has_travel = [](const plan::PlannedStep& step) { return step.travel.has_value(); };
  return plan.homing || std::ranges::any_of(plan.steps, has_travel) || ClaimsWays(plan);
}

}  // namespace

std::vector<plan::Flaw> FlawsOfTravels(const domain::Problem& problem, const plan::Plan& plan) {
  std::vector<plan::Flaw> flaws;
  PlanWalk walk(problem, plan,
                HasSoundCertificates(plan) ? uncertainty::Propagation::kSound
                                           : uncertainty::Propagation::kPaper);
  const bool has_ways = HasWays(plan);
  std::optional<JointVector> posture = problem.workcell->home();
  for (const StepId id : walk.Steps()) {
    walk.ComeTo(id);
    const std::optional<plan::Travel>& travel = id.IsNone() ? plan.homing : plan.step(id).travel;
    if (travel) {
      for (std::string& what : FlawsOfTravel(*travel, walk, id, posture)) {
        flaws.push_back({id, "the travel: " + std::move(what)});
      }
    } else {
      if (has_ways) flaws.push_back({id, id.IsNone() ? kNoWayHome : kNoWay});
      posture.reset();
    }
    if (!id.IsNone()) walk.Do(id);
  }
  return flaws;
}

}  // namespace assay::assembly
