#include "planner/constraint_posting/plan_instance.h"

#include <fmt/format.h>

#include <algorithm>

#include "planner/constraint_posting/step_geometry.h"
#include "planner/constraint_posting/world.h"

namespace assay::constraint_posting {

using domain::ActionTemplate;
using domain::GraspId;

namespace {

plan::Hold HoldOf(const domain::Part& part, int grasp_label) {
  const domain::Grasp& grasp = (*part.grasps)[grasp_label];
  return {.grasp = grasp.label, .X_PartTool = grasp.X_PartTool, .width = grasp.width};
}

plan::Place PlaceOf(const domain::Part& part, const StepValues& values) {
  const bool initial = values.position == domain::InitialLabel(part);
  return {.position = initial ? "initial" : part.model->stable_poses()[values.position].label,
          .X_WorldPart = values.X_WorldPart};
}

}  // namespace

std::vector<std::vector<StepId>> OrdersOf(const PartialPlan& plan) {
  auto orders = plan.ordering().Linearizations(kMostOrders);
  for (std::vector<StepId>& order : orders) {
    std::erase_if(order, [](StepId step) { return step <= PartialPlan::kFinish; });
  }
  return orders;
}

plan::Action WriteAction(const domain::Problem& problem, const ActionTemplate& action,
                         const StepValues& values) {
  plan::Action written{.kind = action.kind, .mating = action.mating};
  if (action.mating.IsNone()) written.part = action.part;
  if (!action.grasp.IsNone()) written.hold = HoldOf(problem.part(action.part), values.grasp);
  written.place = PlaceOf(problem.part(plan::PlacedPart(problem, written)), values);
  return written;
}

namespace {

// Returns true if the instance's values also work in another order of its steps.
bool WorksInOrder(const PartialPlan& plan, const PlanInstance& instance,
                  const std::vector<StepId>& order) {
  const StepGeometry geometry(plan.problem(), plan.relations().reachability());
  World world(plan.problem());
  Blame blame;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const ActionTemplate& action = plan.step(order[i]);
    const auto& [grasp, position, X_WorldPart] = instance.values[order[i].index()];
    if (!geometry.Works(world, order[i], action, GraspId(grasp), X_WorldPart, blame)) return false;
    world.Do(action, X_WorldPart, static_cast<int>(i));
  }
  return true;
}

plan::StepId WrittenId(StepId step) { return plan::StepId(step.index() - 2); }

// Adds to a step's certificate that a part was moved because some precondition of the step could
// not be proved.
void NoteWhyMoved(const PartialPlan& partial, plan::Plan& written) {
  for (const RequiredMove& move : partial.required_moves()) {
    if (move.why.empty()) continue;
    const StepId mover = partial.ProducerOf(move.consumer, move.precondition);
    auto& resolutions = written.steps[WrittenId(move.consumer).index()].certificate.resolutions;
    if (resolutions.empty()) resolutions.push_back({.resolver = "moving", .why = move.why});
    plan::Resolution& moving = resolutions.front();
    if (!moving.steps.empty()) moving.why += "; " + move.why;
    if (partial.step(mover).kind->Needs(domain::Need::kHolding)) {
      moving.steps.push_back(WrittenId(partial.ProducerOf(mover, 0)));  // the step that takes it
    }
    moving.steps.push_back(WrittenId(mover));
  }
  const auto executed = [&](plan::StepId step) { return written.step(step).executed; };
  for (plan::PlannedStep& step : written.steps) {
    for (plan::Resolution& moving : step.certificate.resolutions) {
      std::ranges::sort(moving.steps, {}, executed);
    }
  }
}

bool EveryOrderWorks(const PartialPlan& plan, const PlanInstance& instance) {
  const auto orders = OrdersOf(plan);
  return orders.size() < kMostOrders && std::ranges::all_of(orders, [&](const auto& order) {
           return order == instance.order || WorksInOrder(plan, instance, order);
         });
}

}  // namespace

plan::Plan WriteOut(const PartialPlan& partial, const PlanInstance& instance) {
  plan::Plan written{.problem = partial.problem().name};
  for (int s = 2; s < static_cast<int>(partial.steps().size()); ++s) {
    const auto executed = std::ranges::find(instance.order, StepId(s)) - instance.order.begin();
    written.steps.push_back(
        {.name = fmt::format("action_{}", s - 1),
         .action = WriteAction(partial.problem(), partial.step(StepId(s)), instance.values[s]),
         .inserted = s - 1,
         .executed = static_cast<int>(executed) + 1});
  }
  NoteWhyMoved(partial, written);
  if (EveryOrderWorks(partial, instance)) {
    for (const auto& [a, b] : partial.ordering().arcs()) {
      if (std::min(a, b) > PartialPlan::kFinish) {
        written.ordering.emplace_back(WrittenId(a), WrittenId(b));
      }
    }
  } else {
    for (std::size_t i = 1; i < instance.order.size(); ++i) {
      written.ordering.emplace_back(WrittenId(instance.order[i - 1]), WrittenId(instance.order[i]));
    }
  }
  return written;
}

}  // namespace assay::constraint_posting
