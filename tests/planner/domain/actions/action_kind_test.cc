#include "planner/domain/actions/action_kind.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "planner/domain/actions/action_template.h"
#include "planner/domain/actions/actions.h"
#include "tests/planner/domain/scenario.h"

namespace assay::domain::action_kind_test {
namespace {

using ::testing::IsSubsetOf;
using ::testing::SizeIs;

// Returns an action of each kind that the planner searches with, as it is instantiated for a
// mating of two parts.
std::vector<ActionTemplate> Templates() {
  const Problem problem = LoadScenario("spar-fig14");
  const PartId held = problem.matings.front().held;
  std::vector<ActionTemplate> templates;
  PlanVariables variables;
  const VariableId grasp = variables.AddFree(VariableKind::kGrasp, held);
  const VariableId position = variables.AddFree(VariableKind::kPosition, held);
  for (const ActionKind* kind : StandardActions()) {
    if (kind->achieve == nullptr) continue;
    for (const Condition& condition :
         {Condition::Holding(held, grasp), Condition::Located(held, position),
          Condition::Assembled(MatingId(0))}) {
      std::ranges::move(kind->achieve(problem, condition, variables),
                        std::back_inserter(templates));
    }
  }
  return templates;
}

bool Has(const std::vector<Condition>& conditions, Predicate predicate) {
  return std::ranges::count(conditions, predicate, &Condition::predicate) > 0;
}

TEST(ActionKind, NamesAreDistinct) {
  std::set<std::string_view> names;
  for (const ActionKind* kind : StandardActions()) names.insert(kind->name);
  EXPECT_THAT(names, SizeIs(StandardActions().size()));
}

TEST(ActionKind, AShortTextGivesSomeOfTheArguments) {
  for (const ActionKind* kind : StandardActions()) {
    EXPECT_THAT(kind->short_arguments, IsSubsetOf(kind->arguments)) << kind->name;
  }
}

TEST(ActionKind, HasTheArgumentsOfWhichItsNeedsSpeak) {
  for (const ActionKind* kind : StandardActions()) {
    EXPECT_NE(kind->Has(Argument::kPart), kind->Has(Argument::kMating)) << kind->name;
    EXPECT_EQ(kind->Has(Argument::kMating), kind->leaves == Leaves::kMated) << kind->name;
    EXPECT_EQ(kind->Has(Argument::kSensor), kind->Needs(Need::kSensor)) << kind->name;
    EXPECT_TRUE(kind->Has(Argument::kPosition)) << kind->name;
    EXPECT_FALSE(kind->Needs(Need::kHolding) && kind->Needs(Need::kOpenHand)) << kind->name;
  }
}

// The needs are for the checker, and the templates for the planner. They say the same (Spar,
// figure 2).
TEST(ActionKind, NeedsAndTemplatesAgree) {
  const std::vector<ActionTemplate> templates = Templates();
  ASSERT_THAT(templates, SizeIs(3));
  for (const ActionTemplate& action : templates) {
    const ActionKind& kind = *action.kind;
    SCOPED_TRACE(kind.name);
    EXPECT_EQ(kind.Needs(Need::kOpenHand), Has(action.preconditions, Predicate::kGripperOpen));
    EXPECT_EQ(kind.Needs(Need::kHolding), Has(action.preconditions, Predicate::kHolding));
    EXPECT_EQ(kind.Needs(Need::kAtPlace), Has(action.preconditions, Predicate::kPartLocation));
    EXPECT_EQ(kind.leaves == Leaves::kInHand, Has(action.adds, Predicate::kHolding));
    EXPECT_EQ(kind.leaves == Leaves::kAtPlace, Has(action.adds, Predicate::kPartLocation));
    EXPECT_EQ(kind.leaves == Leaves::kMated, Has(action.adds, Predicate::kAssembled));
    EXPECT_EQ(kind.leaves == Leaves::kInHand, Has(action.deletes, Predicate::kGripperOpen));
    EXPECT_EQ(kind.Has(Argument::kGrasp), !action.grasp.IsNone());
    EXPECT_EQ(kind.Has(Argument::kMating), !action.mating.IsNone());
  }
}

TEST(ActionKind, TextsHaveTheArgumentsInOrder) {
  const auto text_of = [](Argument argument) { return argument == Argument::kPart ? "p" : "g"; };
  EXPECT_EQ(Text(kPickup, kPickup.short_arguments, text_of), "pickup(p, g)");
  EXPECT_EQ(Text(kPickup, {}, text_of), "pickup");
}

}  // namespace
}  // namespace assay::domain::action_kind_test
