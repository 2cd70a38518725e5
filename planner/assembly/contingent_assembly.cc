#include "planner/assembly/contingent_assembly.h"

#include <fmt/format.h>

#include <algorithm>

#include "planner/assembly/certified_plan.h"
#include "planner/assembly/open_poses.h"
#include "planner/assembly/plan_check.h"
#include "planner/base/check.h"
#include "planner/constraint_posting/resolvers/plan_states.h"
#include "planner/contingent/search/contingent_planner.h"
#include "planner/uncertainty/preconditions/certify.h"

namespace assay::assembly {
namespace {

constexpr std::int64_t kKnowledgeStates = 1'000'000;

// Returns a look at each of the parts, by the first available sensor.
std::vector<plan::Action> LooksAt(const domain::Problem& world,
                                  const std::vector<domain::OpenPose>& parts) {
  std::vector<plan::Action> looks;
  if (world.sensors.empty()) return looks;
  for (const domain::OpenPose& open : parts) {
    looks.push_back(constraint_posting::LookAt(open.part, world.sensors.front(),
                                               {"initial", world.part(open.part).X_WorldPart}));
  }
  return looks;
}

// Returns true if each kind of precondition that is completely proved in the plan's own world is
// proved in this world. The preconditions about the arm's ways are not compared, because the plan
// check computes them again.
bool IsAsCertain(const domain::Problem& world, const plan::Plan& plan,
                 const constraint_posting::UncertaintyOptions& options) {
  uncertainty::UncertainWorld uncertain(world, options.propagation);
  return std::ranges::all_of(plan.ExecutionOrder(), [&](plan::StepId id) {
    const plan::PlannedStep& step = plan.step(id);
    const plan::Strategy* strategy = step.strategy ? &*step.strategy : nullptr;
    const auto now = CertifyStep(uncertain, step.action, options.bound, strategy);
    return std::ranges::all_of(now.unproved, [&](const uncertainty::Unproved& unproved) {
      return std::ranges::any_of(step.certificate.preconditions, [&](const auto& claim) {
        return claim.condition == unproved.claim.condition && !claim.holds();
      });
    });
  });
}

bool Works(const domain::Problem& world, const plan::Plan& plan,
           const constraint_posting::UncertaintyOptions& options) {
  constexpr int kOrders = 10;
  return assembly::Check(world, plan, kOrders).flaws.empty() && IsAsCertain(world, plan, options);
}

// Plans first without looks, because such a plan may serve several worlds. If the plan does not
// serve all worlds, it is made again with looks at the beginning.
class WorldPlanner {
 public:
  WorldPlanner(const std::vector<domain::Problem>& worlds,
               const constraint_posting::PlannerOptions& planner,
               const constraint_posting::UncertaintyOptions& uncertainty)
      : worlds_(worlds), planner_(planner), uncertainty_(uncertainty) {}

  ContingentAssembly Plan() {
    assembly_.outcome = Outcome::kFound;
    for (int w = 0; w < std::ssize(worlds_) && assembly_.outcome == Outcome::kFound; ++w) {
      if (!IsPlannedFor(w)) PlanFor(w);
    }
    if (assembly_.outcome == Outcome::kFound) AddTree();
    return std::move(assembly_);
  }

 private:
  bool IsPlannedFor(int world) const {
    return std::ranges::any_of(assembly_.plans, [&](const PlanOfWorlds& planned) {
      return std::ranges::count(planned.worlds, world) > 0;
    });
  }

  void PlanFor(int w) {
    const plan::PlanResult blind = assembly::MakeCertifiedPlan(worlds_[w], planner_, uncertainty_);
    if (blind.outcome != Outcome::kFound) {
      assembly_.outcome = blind.outcome;
      assembly_.unplanned = blind;
      if (!worlds_[w].open_poses.empty()) TellWorld(NameOf(worlds_[w]));
      return;
    }
    PlanOfWorlds planned = {WorldsOf(blind.plan, w), blind.plan};
    const auto matter = PosesThatMatter(worlds_, planned.worlds);
    if (!matter.empty()) {
      constraint_posting::UncertaintyOptions looking = uncertainty_;
      looking.looks = LooksAt(worlds_[w], matter);
      planned.plan = assembly::MakeCertifiedPlan(worlds_[w], planner_, looking).plan;
    }
    assembly_.errors += planned.plan.errors;
    assembly_.plans.push_back(std::move(planned));
  }

  // Adds the world to the reasons, because the constraints conflict only in this world.
  void TellWorld(const std::string& world) {
    plan::PlanResult& unplanned = assembly_.unplanned;
    const std::string text = "the world is: " + world;
    if (unplanned.outcome == Outcome::kNone) {
      unplanned.conflict.push_back({text});
    } else if (!unplanned.limits.empty()) {
      unplanned.limits.push_back(text);
    }
  }

  std::vector<int> WorldsOf(const plan::Plan& plan, int made_for) const {
    std::vector<int> worlds;
    for (int w = 0; w < std::ssize(worlds_); ++w) {
      if (w == made_for || (!IsPlannedFor(w) && Works(worlds_[w], plan, uncertainty_))) {
        worlds.push_back(w);
      }
    }
    return worlds;
  }

  void AddTree() {
    assembly_.knowledge = KnowledgeOf(worlds_, assembly_.plans);
    Budget budget(kKnowledgeStates);
    contingent::ContingentPlan contingent =
        contingent::MakePlan(assembly_.knowledge.task, contingent::Wanted::kFirst, budget);
    assembly_.tree = std::move(contingent.tree);
    if (contingent.outcome != Outcome::kNone) {
      assembly_.outcome = contingent.outcome;
      return;
    }
    assembly_.outcome = Outcome::kBudget;
    assembly_.unplanned.limits.push_back(
        "only one plan is considered for each world, and its steps do not distinguish the worlds");
    for (const domain::OpenPose& open : worlds_.front().open_poses) AddLimits(open);
  }

  void AddLimits(const domain::OpenPose& open) {
    const domain::Problem& first = worlds_.front();
    const std::string& part = first.part(open.part).name;
    bool is_told = false;
    for (const std::string& sensor : first.sensors) {
      const auto alike = FindAlike(worlds_, open.part, sensor);
      is_told |= !alike;
      if (!alike) continue;
      assembly_.unplanned.limits.push_back(
          fmt::format("sensor {} cannot distinguish pose {} of part {} from pose {} within the "
                      "part's error and the sensor's promise",
                      sensor, alike->first, part, alike->second));
    }
    if (!is_told) {
      assembly_.unplanned.limits.push_back(fmt::format("no sensor tells which pose {} has", part));
    }
  }

  const std::vector<domain::Problem>& worlds_;
  const constraint_posting::PlannerOptions& planner_;
  const constraint_posting::UncertaintyOptions& uncertainty_;
  ContingentAssembly assembly_;
};

}  // namespace

std::string NameOf(const domain::Problem& world) {
  std::string name;
  for (const domain::OpenPose& open : world.open_poses) {
    if (!name.empty()) name += ", ";
    name += fmt::format("{} {}", world.part(open.part).name, open.names[open.chosen]);
  }
  return name;
}

ContingentAssembly MakeContingentPlan(const std::vector<domain::Problem>& worlds,
                                      const constraint_posting::PlannerOptions& planner,
                                      const constraint_posting::UncertaintyOptions& uncertainty) {
  ASSAY_CHECK(!worlds.empty());
  return WorldPlanner(worlds, planner, uncertainty).Plan();
}

}  // namespace assay::assembly
