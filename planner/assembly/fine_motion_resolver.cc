#include "planner/assembly/fine_motion_resolver.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "planner/assembly/strategy_reach.h"
#include "planner/constraint_posting/resolvers/sensing_resolver.h"
#include "planner/domain/matings/mating_classes.h"
#include "planner/finemotion/strategy_checks/sequence_replay.h"
#include "planner/finemotion/strategy_checks/strategy_check.h"
#include "planner/finemotion/strategy_search/likely_errors.h"
#include "planner/plan/certificates/condition_table.h"
#include "planner/plan/checker/world_state.h"

namespace assay::assembly {
namespace {

using constraint_posting::Insertion;
using constraint_posting::Remedy;
using constraint_posting::UnmetGoals;
using finemotion::FineMotionErrors;
using finemotion::FineMotionPlan;
using finemotion::MatingGeometry;
using geometry::Pose;
using uncertainty::TipBox;
using uncertainty::TipWay;
using uncertainty::UncertainWorld;

// the greatest number of rounds; each computes the errors at a start and searches for a start with
// them
constexpr int kRounds = 4;
// factor on errors, because they differ a little at every start
constexpr double kSpare = 1.05;
constexpr double kLeastShift = 5e-5;  // metres; smaller errors do not make a search easier
constexpr double kLeastTurn = 5e-4;   // radians; smaller turns do not make a search easier
// metres; half of the range in which contacts are searched for
constexpr double kGreatestShift = 0.006;
constexpr double kGreatestTurn = 0.2;  // radians; contacts are linear only up to this turn

// Returns true for absorbed conditions and for the conditions that replace them.
bool IsAnswered(plan::Condition condition) {
  return condition->absorbed_by == plan::AbsorbedBy::kFineMotion ||
         condition->needed_by == plan::NeededBy::kStrategy;
}

bool IsWithin(const TipBox& box, const TipBox& limits) {
  return (box.d.array() < limits.d.array()).all() && (box.w.array() < limits.w.array()).all();
}

TipBox WithSpare(const TipBox& box) { return {kSpare * box.d, kSpare * box.w}; }

plan::Strategy StrategyFrom(const MatingGeometry& geometry, const FineMotionPlan& plan,
                            const plan::StrategyCertificate& certificate, double friction) {
  plan::Strategy strategy = finemotion::StrategyOf(geometry, plan, {.friction = friction});
  strategy.certificate = certificate;
  strategy.certificate.friction = plan.friction_limit;
  strategy.certificate.absorbed = plan.absorbed;
  return strategy;
}

// Reduces what the strategy claims to absorb until the checker of plans agrees. The checker replays
// the strategy as it stands in a file, with slightly smaller errors than the search. With such
// errors a replay may deviate although it did not with the larger ones. Returns whether all errors
// are absorbed.
bool AbsorbWhatIsChecked(const MatingGeometry& geometry, plan::Strategy& strategy) {
  double& absorbed = strategy.certificate.absorbed;
  while (!FlawsOfStrategy(geometry, strategy).empty()) {
    if (absorbed <= 1) return false;
    absorbed = std::max(1.0, absorbed / finemotion::kGrowth);
  }
  return true;
}

bool CanBeReached(const UnmetGoals& unmet, const plan::Action& assemble,
                  const plan::Strategy& strategy) {
  const auto states = plan::StatesOf(unmet.problem, unmet.actions);
  const plan::WorldState& before = states[static_cast<std::size_t>(unmet.step)];
  return !std::holds_alternative<Unreached>(ReachOf(unmet.problem, assemble, strategy, before));
}

// The plan with the actions that remedies insert, and the index in this plan of the step that needs
// fine motion.
struct Prepared {
  std::vector<plan::Action> actions;
  std::vector<std::optional<plan::Strategy>> strategies;
  int step = 0;
};

Prepared With(const UnmetGoals& unmet, const std::vector<Insertion>& insertions) {
  Prepared prepared;
  for (int i = 0; i < std::ssize(unmet.actions); ++i) {
    for (const Insertion& insertion : insertions) {
      if (insertion.before != i) continue;
      prepared.actions.push_back(insertion.action);
      prepared.strategies.emplace_back();
    }
    if (i == unmet.step) prepared.step = static_cast<int>(prepared.actions.size());
    prepared.actions.push_back(unmet.actions[static_cast<std::size_t>(i)]);
    prepared.strategies.push_back(
        unmet.strategies.empty() ? std::nullopt : unmet.strategies[static_cast<std::size_t>(i)]);
  }
  return prepared;
}

// Returns the insertions of one look at either part, and those of two looks, one at each part.
std::vector<std::vector<Insertion>> LooksAtPartsOf(const UnmetGoals& unmet,
                                                   const domain::Mating& mating) {
  std::vector<std::vector<Insertion>> looks;
  if (std::ranges::count(unmet.problem.resolvers, domain::ResolverKind::kSensing) == 0)
    return looks;
  const std::vector<Remedy> remedies = constraint_posting::SensingResolver().Propose(unmet);
  for (const Remedy& remedy : remedies) {
    if (remedy.part == mating.held || remedy.part == mating.fixed) {
      looks.push_back(remedy.insertions);
    }
  }
  for (const Remedy& first : remedies) {
    for (const Remedy& second : remedies) {
      if (first.part != mating.held || second.part != mating.fixed) continue;
      std::vector<Insertion> both = first.insertions;
      both.insert(both.end(), second.insertions.begin(), second.insertions.end());
      looks.push_back(std::move(both));
    }
  }
  return looks;
}

}  // namespace

TipBox TipBoxAt(const UnmetGoals& unmet, uncertainty::Propagation propagation, const TipWay& way) {
  UncertainWorld world(unmet.problem, propagation);
  for (int i = 0; i < unmet.step; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const bool has_strategy = at < unmet.strategies.size() && unmet.strategies[at];
    Propagate(world, unmet.actions[at], has_strategy ? &*unmet.strategies[at] : nullptr);
  }
  const plan::Action& assemble = unmet.actions[static_cast<std::size_t>(unmet.step)];
  const auto grasp = PossibleGrasp(world.held(), world.DrawManipulator(), propagation);
  return BoxOf(world, TipErrors(world, assemble.mating, assemble.hold, grasp, way));
}

std::vector<Remedy> FineMotionResolver::Propose(const UnmetGoals& unmet) {
  const domain::MatingId id = unmet.actions[static_cast<std::size_t>(unmet.step)].mating;
  if (id.IsNone()) return {};
  if (!std::ranges::all_of(unmet.goals, [](const uncertainty::Unproved& goal) {
        return IsAnswered(goal.claim.condition);
      })) {
    return {};
  }
  const domain::Mating& mating = unmet.problem.mating(id);
  std::vector<std::vector<Insertion>> preparations = {{}};
  std::ranges::move(LooksAtPartsOf(unmet, mating), std::back_inserter(preparations));
  for (std::vector<Insertion>& insertions : preparations) {
    const Prepared prepared = With(unmet, insertions);
    auto strategy = StrategyFor({unmet.problem, prepared.actions, prepared.step, unmet.goals,
                                 unmet.parts, prepared.strategies});
    if (!strategy) continue;
    return {{.part = mating.held,
             .insertions = std::move(insertions),
             .absorbs = plan::AbsorbedByFineMotion(),
             .strategy = std::move(strategy)}};
  }
  return {};
}

// The start determines the errors there, and the errors determine the start. So the two are
// computed alternately.
std::optional<plan::Strategy> FineMotionResolver::StrategyFor(const UnmetGoals& unmet) {
  const plan::Action& assemble = unmet.actions[static_cast<std::size_t>(unmet.step)];
  const domain::Mating& mating = unmet.problem.mating(assemble.mating);
  const MatingGeometry geometry = finemotion::GeometryOf(unmet.problem, mating);
  const double friction = domain::GreatestMatingFriction(unmet.problem, mating);
  TipBox box = WithSpare(TipBoxAt(
      unmet, propagation_,
      {geometry.X_HeldTip, geometry.passage.X_StationaryEntry, geometry.X_FixedSeat.linear()}));
  for (int round = 0; round < kRounds; ++round) {
    if (box.d.norm() >= kGreatestShift || box.w.norm() >= kGreatestTurn) return std::nullopt;
    box = {box.d.cwiseMax(kLeastShift), box.w.cwiseMax(kLeastTurn)};
    const plan::StrategyCertificate certificate = {
        .absorbs = plan::AbsorbedByFineMotion(),
        .d = box.d,
        .w = box.w,
        .velocity = unmet.problem.mating_errors.velocity};
    const FineMotionErrors errors = finemotion::ErrorsOf(certificate, geometry);
    const FineMotionPlan& plan = PlanFor(assemble.mating, geometry, errors, friction);
    if (!plan.found()) return std::nullopt;
    plan::Strategy strategy = StrategyFrom(geometry, plan, certificate, friction);
    const TipBox there = TipBoxAt(unmet, propagation_, uncertainty::WayOf(strategy));
    if (IsWithin(there, box)) {
      if (!CanBeReached(unmet, assemble, strategy)) return std::nullopt;
      if (!AbsorbWhatIsChecked(geometry, strategy)) return std::nullopt;
      TellLikelyErrors(geometry, plan, errors, {.friction = friction}, strategy);
      return strategy;
    }
    box = WithSpare({box.d.cwiseMax(there.d), box.w.cwiseMax(there.w)});
  }
  return std::nullopt;
}

const FineMotionPlan& FineMotionResolver::PlanFor(domain::MatingId mating,
                                                  const MatingGeometry& geometry,
                                                  const FineMotionErrors& errors, double friction) {
  const std::string key =
      fmt::format("{} {:.17g} {:.17g}", mating.index(), fmt::join(errors.pose, " "), friction);
  const auto [plan, is_new] = plans_.try_emplace(key);
  if (is_new) {
    plan->second = SearchStrategy(geometry.passage, errors,
                                  {.friction = friction, .diverse_rounds = 0, .thorough_nodes = 0});
  }
  return plan->second;
}

}  // namespace assay::assembly
