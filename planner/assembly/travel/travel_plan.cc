#include "planner/assembly/travel/travel_plan.h"

#include <fmt/format.h>

#include <utility>
#include <variant>

#include "planner/assembly/travel/plan_walk.h"
#include "planner/assembly/travel/way_conditions.h"
#include "planner/plan/certificates/coverage.h"

namespace assay::assembly {
namespace {

using plan::StepId;

std::optional<plan::Travel>& TravelTo(StepId id, plan::Plan& plan) {
  return id.IsNone() ? plan.homing : plan.steps[id.index()].travel;
}

std::string NameOfStep(StepId id, const plan::Plan& plan) {
  return id.IsNone() ? "home" : plan.step(id).name;
}

// A travel other than the usual one is known to be free only in the order of steps for which it was
// planned.
void KeepOrder(plan::Plan& plan) {
  const std::vector<StepId> order = plan.ExecutionOrder();
  plan.ordering.clear();
  for (std::size_t i = 1; i < order.size(); ++i) {
    plan.ordering.emplace_back(order[i - 1], order[i]);
  }
}

// Returns whether error sets were computed. They were not if the plan was made without regard to
// uncertainty, or if it comes from the first phase, which writes only why it moved parts away. Each
// step starts from the error set of a part.
bool IsComputed(const plan::Certificate& certificate) { return !certificate.before.empty(); }

// The preconditions of the way home belong to the last step.
void AddConditions(StepId id, const WayCertainty& certainty, plan::Plan& plan) {
  const StepId owner = id.IsNone() ? plan.ExecutionOrder().back() : id;
  plan::Certificate& certificate = plan.steps[owner.index()].certificate;
  if (!IsComputed(certificate)) return;
  std::vector<plan::CertifiedPrecondition>& all = certificate.preconditions;
  const auto conditions = WayConditions(certainty, WayOf(id));
  all.insert(all.end(), conditions.begin(), conditions.end());
}

// Lists in each certificate the preconditions about ways that are not proved.
void AddExcuses(plan::Plan& plan, uncertainty::Propagation propagation) {
  for (plan::PlannedStep& step : plan.steps) {
    if (!IsComputed(step.certificate)) continue;
    step.certificate.not_needed = plan::NotNeededIn(
        step.certificate.preconditions, step.action, step.strategy ? &*step.strategy : nullptr,
        propagation == uncertainty::Propagation::kPaper);
  }
}

}  // namespace

std::optional<plan::Reason> AddTravels(const domain::Problem& problem, TravelEffort& effort,
                                       plan::Plan& plan, uncertainty::Propagation propagation) {
  for (plan::PlannedStep& step : plan.steps) RemoveWayConditions(step.certificate);
  PlanWalk walk(problem, plan, propagation);
  kinematics::JointVector posture = problem.workcell->home();
  bool only_in_this_order = false;
  for (const StepId id : walk.Steps()) {
    walk.ComeTo(id);
    TravelSearch search(walk, id, posture);
    std::optional<TravelSearch::Found> found = search.GoUsually();
    if (propagation == uncertainty::Propagation::kSound &&
        (!found || !found->certainty.IsComplete())) {
      if (auto certain = search.SearchCertain(effort)) found = std::move(certain);
    }
    if (!found) {
      auto result = search.Search(effort);
      if (const auto* why = std::get_if<plan::Reason>(&result)) {
        return plan::Reason{
            fmt::format("no way to {} was found: {}", NameOfStep(id, plan), why->text),
            why->situation};
      }
      found = std::get<TravelSearch::Found>(std::move(result));
    }
    posture = found->after;
    only_in_this_order |= !found->travel.is_usual;
    TravelTo(id, plan) = std::move(found->travel);
    if (propagation == uncertainty::Propagation::kSound) AddConditions(id, found->certainty, plan);
    if (!id.IsNone()) walk.Do(id);
  }
  AddExcuses(plan, propagation);
  if (only_in_this_order) KeepOrder(plan);
  return std::nullopt;
}

}  // namespace assay::assembly
