#include "planner/constraint_posting/resolvers/plan_states.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "tests/planner/constraint_posting/scenarios.h"
#include "tests/planner/plan/actions.h"

namespace assay::constraint_posting::plan_states_test {
namespace {

using domain::PartId;

// The state before actions[moment], computed from the actions alone.
class Story {
 public:
  Story(const domain::Problem& problem, const std::vector<plan::Action>& actions, int index)
      : problem_(problem) {
    for (const domain::MatingId id : problem.assembled) Mate(id);
    for (int i = 0; i < index; ++i) {
      if (const auto* pickup = As(domain::kPickup, actions[i])) in_hand_ = pickup->part;
      if (const auto* putdown = As(domain::kPutdown, actions[i])) {
        in_hand_ = PartId::None();
        position_[putdown->part] = putdown->place.position;
      }
      if (const auto* assemble = As(domain::kAssemble, actions[i])) {
        in_hand_ = PartId::None();
        Mate(assemble->mating);
        position_[problem.mating(assemble->mating).held] = "assembled";
      }
    }
  }

  PartId in_hand() const { return in_hand_; }
  bool IsMated(PartId part) const { return mated_.contains(part); }
  bool IsInAnother(PartId part) const { return in_another_.contains(part); }
  std::string PositionOf(PartId part) const {
    const auto known = position_.find(part);
    return known == position_.end() ? "initial" : known->second;
  }

 private:
  void Mate(domain::MatingId id) {
    mated_.insert(problem_.mating(id).held);
    mated_.insert(problem_.mating(id).fixed);
    in_another_.insert(problem_.mating(id).held);
  }

  const domain::Problem& problem_;
  PartId in_hand_;
  std::set<PartId> mated_;
  std::set<PartId> in_another_;
  std::map<PartId, std::string> position_;
};

class PlanStates : public ::testing::TestWithParam<const char*> {
 protected:
  domain::Problem problem_ = LoadScenario(GetParam());
  std::vector<plan::Action> actions_ = ActionsOf(FirstInstance(problem_));
  std::vector<plan::WorldState> states_ = plan::StatesOf(problem_, actions_);

  // Returns the last snapshot up to `step` whose story satisfies `wanted`; none if there is none.
  template <class Wanted>
  std::optional<int> NaiveLatest(int step, const Wanted& wanted) const {
    std::optional<int> latest;
    for (int index = 0; index <= step; ++index) {
      if (wanted(Story(problem_, actions_, index))) latest = index;
    }
    return latest;
  }

  template <class Check>
  void ForAll(const Check& check) const {
    for (int step = 0; step <= std::ssize(actions_); ++step) {
      for (std::size_t p = 0; p < problem_.parts.size(); ++p) {
        SCOPED_TRACE(::testing::Message() << "step " << step << " part " << p);
        check(step, PartId(p));
      }
    }
  }
};

INSTANTIATE_TEST_SUITE_P(, PlanStates,
                         ::testing::Values("spar-fig13", "spar-fig16", "two-pegs", "clutter"),
                         [](const auto& param) {
                           std::string name = param.param;
                           std::erase(name, '-');
                           return name;
                         });

TEST_P(PlanStates, ThereIsAStateBeforeEachActionAndAfterTheLast) {
  EXPECT_EQ(states_.size(), actions_.size() + 1);
  ForAll([&](int step, PartId) {
    EXPECT_EQ(states_[step].in_hand, Story(problem_, actions_, step).in_hand());
  });
}

TEST_P(PlanStates, APartIsFreeAsLongAsItIsNeitherInTheHandNorInAnotherPart) {
  ForAll([&](int step, PartId part) {
    EXPECT_EQ(LatestFree(states_, step, part), NaiveLatest(step, [&](const Story& story) {
                return story.in_hand() != part && !story.IsInAnother(part);
              }));
  });
}

TEST_P(PlanStates, APartIsGraspableWhenTheHandIsEmptyAndItIsAlone) {
  ForAll([&](int step, PartId part) {
    EXPECT_EQ(LatestGraspable(problem_, states_, step, part),
              NaiveLatest(step, [&](const Story& story) {
                return story.in_hand().IsNone() && !story.IsMated(part);
              }));
  });
}

TEST_P(PlanStates, PlacesAreLabelledAsThePlanLabelsThem) {
  const UnmetGoals unmet = {problem_, actions_, 0, {}};
  ForAll([&](int step, PartId part) {
    const Story story(problem_, actions_, step);
    if (story.in_hand() == part) return;
    const plan::Place place = PlaceBefore(unmet, states_, step, part);
    EXPECT_EQ(place.position, story.PositionOf(part));
    EXPECT_TRUE(plan::PosesAgree(place.X_WorldPart, states_[step].part(part).X_WorldPart));
  });
}

TEST_P(PlanStates, WhatIsLeftToDoStartsInThatState) {
  for (int step = 0; step <= std::ssize(actions_); ++step) {
    if (!states_[step].in_hand.IsNone()) continue;
    SCOPED_TRACE(::testing::Message() << "step " << step);
    const domain::Problem left = ProblemFrom(problem_, states_[step]);
    const plan::WorldState start = plan::InitialState(left);
    EXPECT_EQ(start.assembled, states_[step].assembled);
    for (std::size_t p = 0; p < problem_.parts.size(); ++p) {
      EXPECT_EQ(start.parts[p].status, states_[step].parts[p].status);
      EXPECT_TRUE(plan::PosesAgree(start.parts[p].X_WorldPart, states_[step].parts[p].X_WorldPart));
      const domain::Part& before = problem_.parts[p];
      if (step > 0) continue;
      EXPECT_EQ(left.parts[p].resting, before.resting);
      EXPECT_EQ(left.parts[p].hidden, before.hidden);
      EXPECT_EQ(left.parts[p].position_class, before.position_class);
    }
  }
}

TEST(PlanStatesOf, OfPartsThatAreMatedFromTheStartOnlyTheFixedOneIsFree) {
  domain::Problem problem = LoadScenario("uncertain-known");
  problem.assembled.emplace_back(0);
  const std::vector<plan::WorldState> states = plan::StatesOf(problem, {});
  const domain::Mating& mating = problem.mating(domain::MatingId(0));
  EXPECT_EQ(LatestFree(states, 0, mating.fixed), 0);
  EXPECT_EQ(LatestFree(states, 0, mating.held), std::nullopt);
  EXPECT_EQ(LatestGraspable(problem, states, 0, mating.fixed), std::nullopt);
  EXPECT_EQ(LatestGraspable(problem, states, 0, mating.held), std::nullopt);
}

}  // namespace
}  // namespace assay::constraint_posting::plan_states_test
