#include "planner/constraint_posting/impossibility/relaxed_hand.h"

#include <algorithm>
#include <utility>

#include "planner/domain/actions/condition.h"

namespace assay::constraint_posting {

using domain::GraspConditions;
using domain::GraspId;
using domain::Mating;
using domain::MatingId;
using domain::Part;
using domain::PartId;
using domain::Pose;
using domain::StablePoseId;

namespace {

bool Contains(const PartSet& set, const PartSet& subset) {
  for (std::size_t p = 0; p < set.size(); ++p) {
    if (subset[p] && !set[p]) return false;
  }
  return true;
}

bool IsEmpty(const PartSet& set) { return std::ranges::count(set, true) == 0; }

// Returns true if one of the ways is free of all parts except those that have moved.
bool SomeIsFree(const std::vector<PartSet>& ways, const PartSet& moved) {
  return std::ranges::any_of(
      ways, [&](const PartSet& in_the_way) { return Contains(moved, in_the_way); });
}

PartSet SetOf(const domain::Problem& problem, std::initializer_list<PartId> parts) {
  PartSet set(problem.parts.size(), false);
  for (PartId part : parts) set[part.index()] = true;
  return set;
}

}  // namespace

std::vector<Pose> PosesAt(const domain::Problem& problem, PartId id, int position) {
  const Part& part = problem.part(id);
  if (position == domain::InitialLabel(part)) return {part.X_WorldPart};
  std::vector<Pose> poses;
  for (const domain::Placement& placement : problem.workcell->placements()) {
    poses.push_back(placement.X_WorldTable() * part.model->stable_poses()[position].X_TablePart);
  }
  return poses;
}

RelaxedHand::RelaxedHand(domain::Problem problem)
    : problem_(std::move(problem)), reachability_(problem_), geometry_(problem_, reachability_) {
  for (std::size_t p = 0; p < problem_.parts.size(); ++p) AddPart(PartId(p));
  for (std::size_t m = 0; m < problem_.matings.size(); ++m) AddMating(MatingId(m));
}

template <class BrokenPair>
RelaxedHand::ConditionTable RelaxedHand::TableOf(const Part& gripped, const Part& placed,
                                                 const BrokenPair& broken) {
  ConditionTable table{.positions = domain::PositionLabelCount(placed)};
  for (int g = 0; g < domain::GraspLabelCount(gripped); ++g) {
    for (int p = 0; p < table.positions; ++p) table.broken.push_back(broken(GraspId(g), p));
  }
  return table;
}

void RelaxedHand::AddPart(PartId id) {
  const Part& part = problem_.part(id);
  // Parts of one model differ only in where they start.
  const auto alike = std::ranges::find(problem_.parts, part.model, &Part::model);
  const PartId first(static_cast<std::size_t>(alike - problem_.parts.begin()));
  parts_.push_back(TableOf(part, part, [&](GraspId grasp, int position) {
    if (position == domain::InitialLabel(part)) {
      return BrokenAt(problem_, id, grasp, part.X_WorldPart);
    }
    return first == id ? BrokenIn(problem_, id, grasp, StablePoseId(position))
                       : Broken(first, grasp.index(), position);
  }));
}

void RelaxedHand::AddMating(MatingId id) {
  const Part& held = problem_.part(problem_.mating(id).held);
  const Part& fixed = problem_.part(problem_.mating(id).fixed);
  matings_.push_back(TableOf(held, fixed, [&](GraspId grasp, int position) {
    return position == domain::InitialLabel(fixed)
               ? BrokenMatingAt(problem_, id, grasp, fixed.X_WorldPart)
               : BrokenMatingIn(problem_, id, grasp, StablePoseId(position));
  }));
}

GraspConditions RelaxedHand::Broken(PartId part, int grasp, int position) const {
  const ConditionTable& table = parts_[part.index()];
  return table.broken[grasp * table.positions + position];
}

GraspConditions RelaxedHand::BrokenMating(MatingId mating, int grasp, int position) const {
  const ConditionTable& table = matings_[mating.index()];
  return table.broken[grasp * table.positions + position];
}

bool RelaxedHand::IsFree(PartId id, int grasp, int position, const PartSet& moved) const {
  const auto [known, is_new] = ways_.try_emplace({id.index(), grasp, position});
  if (is_new) {
    const bool at_start = position == domain::InitialLabel(problem_.part(id));
    known->second = WaysTo(id, position, SetOf(problem_, {id}), [&](World& world, const Pose& X) {
      Blame unused;
      if (at_start) {
        return geometry_.TakingWorks(world, PartialPlan::kFinish, id, GraspId(grasp), unused);
      }
      return geometry_.HasRoom(world, PartialPlan::kFinish, id, X, unused) &&
             geometry_.HandWorks(world, PartialPlan::kFinish, id, GraspId(grasp), X, unused);
    });
  }
  return SomeIsFree(known->second, moved);
}

bool RelaxedHand::IsMatingFree(MatingId id, int grasp, int position, const PartSet& moved) const {
  const auto [known, is_new] = mating_ways_.try_emplace({id.index(), grasp, position});
  if (is_new) {
    const Mating& mating = problem_.mating(id);
    const bool at_start = position == domain::InitialLabel(problem_.part(mating.fixed));
    known->second = WaysTo(
        mating.fixed, position, SetOf(problem_, {mating.held, mating.fixed}),
        [&](World& world, const Pose& X_WorldFixed) {
          Blame unused;
          if (!at_start &&
              !geometry_.HasRoom(world, PartialPlan::kFinish, mating.fixed, X_WorldFixed, unused)) {
            return false;
          }
          world.Rest(mating.fixed, X_WorldFixed, 0);
          return geometry_.MatingWorks(world, PartialPlan::kFinish, id, GraspId(grasp), unused);
        });
  }
  return SomeIsFree(known->second, moved);
}

RelaxedHand::Ways RelaxedHand::WaysTo(PartId placed, int position, const PartSet& involved,
                                      const Works& works) const {
  Ways ways;
  for (const Pose& X_WorldPart : PosesAt(problem_, placed, position)) {
    World alone(problem_);
    for (std::size_t p = 0; p < involved.size(); ++p) alone.Take(PartId(p));
    if (!works(alone, X_WorldPart)) continue;
    PartSet in_the_way = InTheWay(X_WorldPart, involved, works);
    if (IsEmpty(in_the_way)) return {in_the_way};
    const auto is_worse = [&](const PartSet& other) { return Contains(in_the_way, other); };
    if (std::ranges::any_of(ways, is_worse)) continue;
    std::erase_if(ways, [&](const PartSet& other) { return Contains(other, in_the_way); });
    ways.push_back(std::move(in_the_way));
  }
  return ways;
}

PartSet RelaxedHand::InTheWay(const Pose& X_WorldPart, const PartSet& involved,
                              const Works& works) const {
  PartSet in_the_way(involved.size(), false);
  for (std::size_t other = 0; other < involved.size(); ++other) {
    if (involved[other]) continue;
    World with_it(problem_);
    for (std::size_t p = 0; p < involved.size(); ++p) {
      if (p != other) with_it.Take(PartId(p));
    }
    in_the_way[other] = !works(with_it, X_WorldPart);
  }
  return in_the_way;
}

}  // namespace assay::constraint_posting
