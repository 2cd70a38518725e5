#include "planner/constraint_posting/resolvers/plan_states.h"

#include <algorithm>

#include "planner/domain/parts/occlusion.h"
#include "planner/domain/resting/resting.h"

namespace assay::constraint_posting {
namespace {

using domain::PartId;
using plan::PartStatus;
using plan::WorldState;

bool IsMated(const domain::Problem& problem, const WorldState& state, PartId part) {
  return std::ranges::any_of(state.assembled, [&](domain::MatingId id) {
    const domain::Mating& mating = problem.mating(id);
    return mating.held == part || mating.fixed == part;
  });
}

template <class Condition>
std::optional<int> Latest(int step, const Condition& holds) {
  for (int index = step; index >= 0; --index) {
    if (holds(index)) return index;
  }
  return std::nullopt;
}

}  // namespace

std::optional<int> LatestFree(const std::vector<WorldState>& states, int step, PartId part) {
  return Latest(step,
                [&](int index) { return states[index].part(part).status == PartStatus::kResting; });
}

std::optional<int> LatestGraspable(const domain::Problem& problem,
                                   const std::vector<WorldState>& states, int step, PartId part) {
  return Latest(step, [&](int index) {
    return states[index].in_hand.IsNone() && !IsMated(problem, states[index], part);
  });
}

domain::Problem ProblemFrom(domain::Problem problem, const WorldState& state) {
  for (std::size_t p = 0; p < problem.parts.size(); ++p) {
    domain::Part& part = problem.parts[p];
    part.X_WorldPart = state.parts[p].X_WorldPart;
    const bool is_mated = state.parts[p].status == PartStatus::kMated;
    part.resting = is_mated ? domain::StablePoseId::None() : StablePoseAt(part, part.X_WorldPart);
  }
  problem.assembled = state.assembled;
  NoteOcclusions(problem);
  return problem;
}

plan::Place PlaceBefore(const UnmetGoals& unmet, const std::vector<WorldState>& states, int index,
                        PartId part) {
  std::string position = "initial";
  for (const plan::Action& action : unmet.actions.first(index)) {
    if (HandledPart(unmet.problem, action) != part) continue;
    if (action.kind->leaves == domain::Leaves::kAtPlace) position = action.place.position;
    if (action.kind->leaves == domain::Leaves::kMated) position = "assembled";
  }
  return {position, states[index].part(part).X_WorldPart};
}

plan::Action LookAt(PartId part, const std::string& sensor, const plan::Place& at) {
  return {.kind = &domain::kSense, .part = part, .place = at, .sensor = sensor};
}

}  // namespace assay::constraint_posting
