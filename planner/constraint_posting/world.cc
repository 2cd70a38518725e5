#include "planner/constraint_posting/world.h"

#include <algorithm>

namespace assay::constraint_posting {

using domain::Mating;
using domain::MatingId;
using domain::PartId;
using domain::PlacedPart;
using domain::Pose;

World::World(const domain::Problem& problem) : problem_(&problem), matings_(problem.assembled) {
  for (const domain::Part& part : problem.parts) poses_.push_back(part.X_WorldPart);
  choices_.assign(problem.parts.size(), kStartChoice);
  in_hand_.assign(problem.parts.size(), false);
}

bool World::mated(PartId part) const {
  return std::ranges::any_of(matings_, [&](MatingId id) {
    const Mating& mating = problem_->mating(id);
    return mating.held == part || mating.fixed == part;
  });
}

void World::Do(const domain::ActionTemplate& action, const Pose& X_WorldPart, int choice) {
  switch (action.kind->leaves) {
    case domain::Leaves::kWhereItWas:
      return;
    case domain::Leaves::kInHand:
      return Take(action.part);
    case domain::Leaves::kAtPlace:
      return Rest(action.part, X_WorldPart, choice);
    case domain::Leaves::kMated:
      return Mate(action.mating);
  }
}

void World::Take(PartId part) { in_hand_[part.index()] = true; }

void World::Rest(PartId part, const Pose& X_WorldPart, int choice) {
  in_hand_[part.index()] = false;
  poses_[part.index()] = X_WorldPart;
  choices_[part.index()] = choice;
}

void World::Mate(MatingId id) {
  const Mating& mating = problem_->mating(id);
  Rest(mating.held, X_WorldPart(mating.fixed) * mating.X_FixedHeld, choice(mating.fixed));
  matings_.push_back(id);
}

std::vector<PlacedPart> World::Others(PartId part, PartId except) const {
  std::vector<PlacedPart> others;
  for (std::size_t p = 0; p < poses_.size(); ++p) {
    const PartId other(p);
    if (other == part || other == except || in_hand_[p]) continue;
    others.push_back({.part = other, .X_WorldPart = poses_[p]});
  }
  return others;
}

}  // namespace assay::constraint_posting
