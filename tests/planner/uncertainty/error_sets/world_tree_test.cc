#include "planner/uncertainty/error_sets/world_tree.h"
#include "planner/algebra/expression/nodes.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/planner/plan/actions.h"
#include "tests/planner/uncertainty/action_lists.h"

namespace assay::uncertainty::world_tree_test {
namespace {

// Metres and radians; rounding may differ with the order of the variables.
constexpr double kSame = 1e-12;

std::vector<std::vector<plan::Action>> ListsOf(const domain::Problem& problem) {
  const std::vector<plan::Action> first = FirstPlan(problem);
  std::vector<std::vector<plan::Action>> lists = {first};
  for (std::size_t p = 0; p < problem.parts.size(); ++p) {
    std::vector<plan::Action> looking = first;
    const plan::Place at = {"initial", problem.parts[p].X_WorldPart};
    looking.insert(looking.begin(), plan::Sense(PartId(p), problem.sensors.at(0), at));
    lists.push_back(looking);
  }
  lists.push_back(first);
  return lists;
}

void ExpectSame(const std::vector<Unproved>& a, const std::vector<Unproved>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].claim.condition, b[i].claim.condition);
    EXPECT_EQ(a[i].claim.meaning, b[i].claim.meaning);
    EXPECT_EQ(algebra::VariablesOf(a[i].expression).size(),
              algebra::VariablesOf(b[i].expression).size());
    EXPECT_NEAR(a[i].claim.bound, b[i].claim.bound, kSame);
  }
}

class WorldTreeLaws : public ::testing::TestWithParam<const char*> {
 protected:
  const domain::Problem problem_ = LoadScenario(GetParam());
};

INSTANTIATE_TEST_SUITE_P(Scenarios, WorldTreeLaws,
                         ::testing::Values("uncertain-sensing", "uncertain-known"),
                         [](const auto& scenario) {
                           std::string name = scenario.param;
                           std::ranges::replace(name, '-', '_');
                           return name;
                         });

// The lists of actions follow one after another; some begin with the same actions and some do not.
TEST_P(WorldTreeLaws, TellWhatStartingAnewTells) {
  WorldTree tree(problem_, Propagation::kSound, {});
  for (const std::vector<plan::Action>& actions : ListsOf(problem_)) {
    UncertainWorld anew(problem_, Propagation::kSound);
    SnapshotId snapshot = tree.Beginning();
    for (const plan::Action& action : actions) {
      snapshot = tree.After(snapshot, action, nullptr);
      const std::vector<Unproved> unproved = CertifyStep(anew, action, {}).unproved;
      EXPECT_EQ(tree.IsProved(snapshot), unproved.empty());
      EXPECT_EQ(tree.UnprovedAt(snapshot).size(), unproved.size());
      std::vector<Unproved> told;
      for (const Unproved& goal : tree.UnprovedAt(snapshot))
        told.push_back(tree.Certified(snapshot, goal));
      ExpectSame(told, unproved);
    }
  }
}

TEST_P(WorldTreeLaws, KeepTheErrorsOfEveryPart) {
  WorldTree tree(problem_, Propagation::kSound, {});
  for (const std::vector<plan::Action>& actions : ListsOf(problem_)) {
    UncertainWorld anew(problem_, Propagation::kSound);
    SnapshotId snapshot = tree.Beginning();
    for (const plan::Action& action : actions) {
      snapshot = tree.After(snapshot, action, nullptr);
      Propagate(anew, action);
    }
    for (std::size_t p = 0; p < problem_.parts.size(); ++p) {
      const plan::ErrorSet kept = ErrorSetOf(tree.WorldAt(snapshot), PartId(p));
      const plan::ErrorSet fresh = ErrorSetOf(anew, PartId(p));
      EXPECT_NEAR(kept.x.low, fresh.x.low, kSame);
      EXPECT_NEAR(kept.y.high, fresh.y.high, kSame);
      EXPECT_NEAR(kept.theta.high, fresh.theta.high, kSame);
    }
  }
}

// The same actions lead to the same snapshot, and nothing is computed twice.
TEST_P(WorldTreeLaws, MeetTheSameMomentAgain) {
  WorldTree tree(problem_, Propagation::kSound, {});
  const std::vector<plan::Action> actions = FirstPlan(problem_);
  for (int round = 0; round < 3; ++round) {
    SnapshotId snapshot = tree.Beginning();
    for (const plan::Action& action : actions) snapshot = tree.After(snapshot, action, nullptr);
    EXPECT_EQ(snapshot.index(), std::ssize(actions));
  }
  EXPECT_EQ(tree.size(), std::ssize(actions) + 1);
}

}  // namespace
}  // namespace assay::uncertainty::world_tree_test
