#include "planner/assembly/travel/unproved_ways.h"

#include <optional>
#include <string>
#include <utility>

#include "planner/assembly/travel/plan_walk.h"
#include "planner/assembly/travel/travel_search.h"
#include "planner/assembly/travel/way_conditions.h"
#include "planner/plan/certificates/condition_table.h"

namespace assay::assembly {
namespace {

using plan::StepId;

// Returns what is not proved about a way of the arm; none if all is proved.
std::optional<UnprovedWay> UnprovedIn(StepId id, const Way& way, double clearance,
                                      TravelSearch& search) {
  const auto certainty = search.CertaintyOf(way, clearance);
  if (!certainty || certainty->kept > 0) return std::nullopt;
  if (!certainty->Reaches()) {
    return UnprovedWay{
        id, plan::condition::kReach, {std::string(plan::condition::kReach.left_open)}};
  }
  const plan::Reason why = search.in_the_way();
  return UnprovedWay{id, plan::condition::kWayClear, why, search.ClearShareOfErrors(way)};
}

}  // namespace

std::vector<UnprovedWay> UnprovedWays(const domain::Problem& problem, const plan::Plan& plan) {
  std::vector<UnprovedWay> unproved;
  if (!HasSoundCertificates(plan)) return unproved;
  PlanWalk walk(problem, plan, uncertainty::Propagation::kSound);
  kinematics::JointVector posture = problem.workcell->home();
  for (const StepId id : walk.Steps()) {
    walk.ComeTo(id);
    const std::optional<plan::Travel>& travel = id.IsNone() ? plan.homing : plan.step(id).travel;
    if (!travel) return unproved;
    TravelSearch search(walk, id, posture);
    const std::optional<Way> way = search.WayBy(*travel);
    if (!way) return unproved;
    if (auto found = UnprovedIn(id, *way, travel->clearance, search)) {
      unproved.push_back(std::move(*found));
    }
    posture = way->after();
    if (!id.IsNone()) walk.Do(id);
  }
  return unproved;
}

}  // namespace assay::assembly
