#include "planner/constraint_posting/posting_planner.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>

#include "planner/base/budget.h"
#include "planner/constraint_posting/impossibility/impossibility.h"
#include "planner/constraint_posting/instance_search.h"
#include "planner/constraint_posting/least_actions.h"
#include "planner/constraint_posting/partial_plan.h"
#include "planner/constraint_posting/plan_instance.h"
#include "planner/constraint_posting/world.h"
#include "planner/domain/matings/mating_classes.h"

namespace assay::constraint_posting {
namespace {

using domain::Problem;

// The number of limits on the number of actions among which the judge's snapshots are divided. Five
// parts in the way take ten more actions than the least limit.
constexpr int kTurns = 12;
// The instances of one partial plan may take at most 1 / kMostOfOneTurn of what is left of a turn's
// budget.
constexpr int kMostOfOneTurn = 2;

// Returns the labels of grasps and positions from which LeastActions computes its lower bound on
// the number of actions.
LabelGeometry Geometry(const Problem& problem, const GeometricRelations& relations) {
  LabelGeometry geometry;
  for (std::size_t p = 0; p < problem.parts.size(); ++p) {
    geometry.reachable.push_back(relations.Reachable(domain::PartId(p)));
    geometry.start.push_back({domain::InitialLabel(problem.parts[p])});
    geometry.movable.push_back(!World(problem).mated(domain::PartId(p)));
  }
  geometry.located.resize(problem.parts.size());
  for (const domain::Goal& goal : problem.goals) {
    if (const auto* located = std::get_if<domain::LocatedGoal>(&goal)) {
      geometry.located[located->part.index()] = LocatedLabels(problem, *located);
    }
  }
  for (std::size_t m = 0; m < problem.matings.size(); ++m) {
    geometry.mate_reachable.push_back(relations.MateReachable(domain::MatingId(m)));
    geometry.grasp_list.push_back(GraspList(problem, problem.matings[m]));
    geometry.position_list.push_back(PositionList(problem, problem.matings[m]));
  }
  return geometry;
}

void TellWhy(ImpossibilityAnswer answer, plan::PlanResult& result) {
  result.limits = std::move(answer.limits);
  if (!answer.proof) return;
  result.outcome = Outcome::kNone;
  result.conflict = std::move(answer.proof->conflict);
  result.hypotheses = std::move(answer.proof->hypotheses);
  result.near_misses = std::move(answer.proof->near_misses);
}

// Returns the actions and labels in the order of execution. Actions and labels together identify an
// instance.
std::string Signature(const Problem& problem, const plan::Plan& plan) {
  std::string signature;
  for (plan::StepId id : plan.ExecutionOrder()) {
    const plan::Action& action = plan.step(id).action;
    signature += fmt::format("{} {} ", action.mating.index(), ShortText(problem, action));
  }
  return signature;
}

class PostingPlanner {
 public:
  PostingPlanner(const Problem& problem, const GeometricRelations& relations,
                 const PlannerOptions& options)
      : problem_(problem),
        options_(options),
        relations_(relations),
        partial_plans_(options.partial_plans),
        instance_choices_(options.instance_choices) {
    if (!options.judge) return;
    judge_ = [this](std::span<const plan::Action> actions) {
      Judgement judgement = options_.judge(actions);
      Charge(turn_, judgement);
      snapshots_ += judgement.snapshots;
      return judgement;
    };
  }

  plan::PlanResult Run() {
    const std::optional<int> least = LeastActions(problem_, Geometry(problem_, relations_));
    plan::PlanResult result;
    if (least && Deepen(*least)) {
      result.outcome = Outcome::kFound;
      result.plan = std::move(*plan_);
    } else if (instances_ == 0 && !judge_) {
      TellWhy(ProveImpossible(problem_), result);
      if (!least && result.outcome != Outcome::kNone && result.limits.empty()) {
        result.limits.push_back(
            "the planner found no way to the goal, and no proof that there is none");
      }
    }
    result.counters = {{"partial_plans", partial_plans_.spent()},
                       {"instance_choices", instance_choices_.spent()},
                       {"complete_plans", complete_plans_},
                       {"instances", instances_},
                       {"least_actions", least.value_or(-1)}};
    if (judge_) result.counters["moments"] = snapshots_;
    return result;
  }

 private:
  // Repeats the search with a growing limit on the number of actions. Returns false if the budget
  // was spent, or if every refinement was tried and none needed more actions than the limit.
  // Neither case is a proof, because refinements do not cover everything that a plan could do.
  bool Deepen(int least) {
    const PartialPlan null_plan(problem_, relations_);
    for (limit_ = least;; ++limit_) {
      cut_off_ = false;
      BeginTurn(limit_ - least + 1);
      Trace("plans of at most {} actions", limit_);
      if (Refine(null_plan)) return true;
      const bool is_longer_worth_it = judge_ ? LongerPlansMayPass(limit_ - least + 1) : cut_off_;
      if (!is_longer_worth_it || partial_plans_.Exhausted() || instance_choices_.Exhausted()) {
        return false;
      }
    }
  }

  // The unused snapshots of earlier turns are added to this turn's share.
  void BeginTurn(int turn) {
    met_objections_ = false;
    are_parts_in_the_way_ = false;
    turn_ = Budget(options_.snapshots * turn / kTurns - snapshots_);
  }
  bool LongerPlansMayPass(int turn) const {
    if (turn == kTurns || (met_objections_ && !are_parts_in_the_way_)) return false;
    return cut_off_ || turn_.Exhausted();
  }

  // Refines the partial plan to satisfy one more goal, in every possible way until one leads to a
  // plan. The goals come in the order of the stacks.
  bool Refine(const PartialPlan& plan) {
    if (turn_.Exhausted() || !partial_plans_.Spend()) return false;
    ++depth_;
    PartialPlan next = plan;
    bool found = false;
    if (const auto threat = next.PopThreat()) {
      found = Protect(next, *threat);
    } else if (const auto operational = next.PopOperational()) {
      found = Satisfy(next, *operational);
    } else if (const auto geometric = next.PopGeometric()) {
      found = Satisfy(next, *geometric);
    } else if (const auto ordering = next.PopOrdering()) {
      found = Satisfy(next, *ordering);
    } else {
      found = Complete(next);
    }
    --depth_;
    return found;
  }

  bool Protect(const PartialPlan& plan, const Threat& threat) {
    Trace("{} threatens {} of {}", plan.Text(threat.violator),
          plan.Text(plan.ConditionOf(threat.link.consumer, threat.link.precondition)),
          plan.Text(threat.link.consumer));
    if (PartialPlan promoted = plan; promoted.Promote(threat)) {
      Trace("promotion: {} before {}", plan.Text(threat.link.consumer), plan.Text(threat.violator));
      if (Refine(promoted)) return true;
    }
    if (PartialPlan separated = plan; separated.Separate(threat)) {
      Trace("separation");
      if (Refine(separated)) return true;
    }
    PartialPlan reopened = plan;
    reopened.Reopen(threat);
    Trace("re-establishment after {}", plan.Text(threat.violator));
    return Refine(reopened);
  }

  bool Satisfy(const PartialPlan& plan, const OperationalGoal& goal) {
    Trace("goal {} of {}", plan.Text(plan.ConditionOf(goal.consumer, goal.precondition)),
          plan.Text(goal.consumer));
    return SatisfyByPresentStep(plan, goal) || SatisfyByNewStep(plan, goal);
  }

  // Tries the steps of the plan, the latest added first. The initial world comes last.
  bool SatisfyByPresentStep(const PartialPlan& plan, const OperationalGoal& goal) {
    for (int s = static_cast<int>(plan.steps().size()) - 1; s >= 0; --s) {
      const StepId producer(s);
      if (!plan.CanEstablish(producer, goal)) continue;
      PartialPlan established = plan;
      if (!established.Establish(producer, goal)) continue;
      Trace("established by {}", plan.Text(producer));
      if (Refine(established)) return true;
    }
    return false;
  }

  bool SatisfyByNewStep(const PartialPlan& plan, const OperationalGoal& goal) {
    if (plan.action_count() >= limit_) {
      cut_off_ = true;
      return false;
    }
    const std::size_t choices = PartialPlan(plan).Establishers(goal).size();
    for (std::size_t i = 0; i < choices; ++i) {
      PartialPlan extended = plan;
      const StepId step = extended.AddStep(extended.Establishers(goal)[i]);
      if (!extended.Establish(step, goal)) continue;
      Trace("established by a new action: {}", extended.Text(step));
      if (Refine(extended)) return true;
    }
    return false;
  }

  bool Satisfy(const PartialPlan& plan, const GeometricGoalRef& goal) {
    PartialPlan posted = plan;
    const bool consistent = posted.Post(goal);
    if (options_.trace) {
      Trace("post {}: {}", plan.Text(plan.ConstraintOf(goal)),
            consistent ? "consistent" : "inconsistent with");
      if (!consistent) {
        for (const std::string& reason : plan.WhyRefused(goal)) Trace("  {}", reason);
      }
    }
    return consistent && Refine(posted);
  }

  bool Complete(const PartialPlan& plan) {
    ++complete_plans_;
    Budget snapshots((turn_.limit() - turn_.spent()) / kMostOfOneTurn);
    InstanceSearch search(plan, judge_, {instance_choices_, snapshots});
    bool has_instance = false;
    const bool accepted = search.Find([&](const PlanInstance& instance) {
      has_instance = true;
      return Accept(WriteOut(plan, instance));
    });
    if (accepted && options_.show_family) options_.show_family(plan);
    if (accepted) return true;
    met_objections_ |= search.met_objections();
    are_parts_in_the_way_ |= !search.blockers().empty();
    return !has_instance && !instance_choices_.Exhausted() && ClearTheWay(plan, search.blockers());
  }

  // Decisions in another order can lead to the same instance again, so known instances are
  // rejected.
  bool Accept(plan::Plan instance) {
    if (!seen_.insert(Signature(problem_, instance)).second) return false;
    ++instances_;
    if (options_.accept && !options_.accept(instance)) return false;
    plan_ = std::move(instance);
    return true;
  }

  // Tries to move the parts one after another. When all plans that move a part have been tried, the
  // part is kept in its place.
  bool ClearTheWay(PartialPlan plan, const Blockers& blockers) {
    for (const auto& [blocker, why] : blockers) {
      const auto& [step, part] = blocker;
      if (plan.IsKept(step, part)) continue;
      Trace("{} is in the way of {}{}{}", problem_.part(part).name, plan.Text(step),
            why.empty() ? "" : ": ", why);
      PartialPlan cleared = plan;
      cleared.RequireMoved(step, part, why);
      if (Refine(cleared)) return true;
      plan.Keep(step, part);
    }
    return false;
  }

  template <class... Values>
  void Trace(fmt::format_string<Values...> format, Values&&... values) const {
    if (!options_.trace) return;
    options_.trace(std::string(2 * depth_, ' ') +
                   fmt::format(format, std::forward<Values>(values)...));
  }

  const Problem& problem_;
  const PlannerOptions& options_;
  const GeometricRelations& relations_;
  Budget partial_plans_;
  Budget instance_choices_;
  // Calls options_.judge and adds its snapshots to snapshots_; empty if the options have no judge.
  Judge judge_ = {};
  Budget turn_{0};              // the judge's budget in snapshots until a longer plan's turn
  std::int64_t snapshots_ = 0;  // the number of snapshots that the judge has computed
  std::int64_t complete_plans_ = 0;
  std::int64_t instances_ = 0;
  std::set<std::string> seen_;         // the signatures of instances
  int limit_ = 0;                      // greatest number of actions in this round of the search
  bool cut_off_ = false;               // true if a refinement was left out because of the limit
  bool met_objections_ = false;        // true if the judge objected in this round
  bool are_parts_in_the_way_ = false;  // true if parts were in the way in this round
  std::size_t depth_ = 0;
  std::optional<plan::Plan> plan_;
};

}  // namespace

plan::PlanResult MakePlan(const Problem& problem, const PlannerOptions& options) {
  return MakePlan(problem, GeometricRelations(problem), options);
}

plan::PlanResult MakePlan(const Problem& problem, const GeometricRelations& relations,
                          const PlannerOptions& options) {
  return PostingPlanner(problem, relations, options).Run();
}

}  // namespace assay::constraint_posting
