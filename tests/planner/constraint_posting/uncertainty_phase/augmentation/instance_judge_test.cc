#include "planner/constraint_posting/uncertainty_phase/augmentation/instance_judge.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/planner/constraint_posting/scenarios.h"

namespace assay::constraint_posting::instance_judge_test {
namespace {

// Returns the judgements on the beginnings of one instance, from the shortest one to the first with
// an objection.
std::vector<Judgement> JudgedInTurn(InstanceJudge& judge,
                                    const std::vector<plan::Action>& actions) {
  std::vector<Judgement> judgements;
  for (std::size_t n = 1; n <= actions.size(); ++n) {
    judgements.push_back(judge(std::span(actions).first(n)));
    if (!judgements.back().objections.empty()) break;
  }
  return judgements;
}

void ExpectSame(const std::vector<Judgement>& a, const std::vector<Judgement>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_EQ(a[i].objections.size(), b[i].objections.size());
    for (std::size_t o = 0; o < a[i].objections.size(); ++o) {
      EXPECT_EQ(a[i].objections[o].action, b[i].objections[o].action);
      EXPECT_EQ(a[i].objections[o].parts, b[i].objections[o].parts);
      EXPECT_EQ(a[i].objections[o].why, b[i].objections[o].why);
    }
  }
}

class JudgeLaws : public ::testing::TestWithParam<const char*> {};

INSTANTIATE_TEST_SUITE_P(Scenarios, JudgeLaws,
                         ::testing::Values("uncertain-known", "uncertain-failing", "spar-fig16"),
                         [](const auto& scenario) {
                           std::string name = scenario.param;
                           std::ranges::replace(name, '-', '_');
                           return name;
                         });

// A judgement does not depend on earlier judgements: a new judge gives the same judgement. If the
// beginning of an instance has been judged before, it costs one snapshot.
TEST_P(JudgeLaws, SaysTheSameAgainAndAnew) {
  const domain::Problem problem = LoadScenario(GetParam());
  const UncertaintyOptions options = WithDefaults({});
  UncertaintyTask task(problem, options);
  InstanceJudge judge(task, {.errors = 1, .by_place = 1}, IfUnproved::kObject);
  const std::vector<plan::Plan> instances = Instances(problem, 4);
  ASSERT_GT(instances.size(), 1u);
  std::vector<std::vector<Judgement>> first;
  for (const plan::Plan& instance : instances) {
    first.push_back(JudgedInTurn(judge, ActionsOf(instance)));
  }
  for (std::size_t i = instances.size(); i-- > 0;) {
    const std::vector<plan::Action> actions = ActionsOf(instances[i]);
    const std::vector<Judgement> again = JudgedInTurn(judge, actions);
    ExpectSame(again, first[i]);
    for (const Judgement& judgement : again) EXPECT_EQ(judgement.snapshots, 1);

    UncertaintyTask new_task(problem, options);
    InstanceJudge anew(new_task, {.errors = 1, .by_place = 1}, IfUnproved::kObject);
    ExpectSame(JudgedInTurn(anew, actions), first[i]);
  }
}

// The judge objects to steps that are not proved. It objects to none if all steps may fail.
TEST_P(JudgeLaws, ObjectsToNoMoreThanIsNotAllowed) {
  const domain::Problem problem = LoadScenario(GetParam());
  const UncertaintyOptions options = WithDefaults({});
  UncertaintyTask task(problem, options);
  for (const plan::Plan& instance : Instances(problem, 2)) {
    const std::vector<plan::Action> actions = ActionsOf(instance);
    Allowance all = {.errors = std::ssize(actions), .by_place = std::ssize(actions)};
    for (const plan::Action& action : actions) all.anywhere.push_back(SubjectOf(problem, action));
    InstanceJudge lenient(task, all, IfUnproved::kObject);
    EXPECT_EQ(JudgedInTurn(lenient, actions).size(), actions.size());

    InstanceJudge strict(task, {}, IfUnproved::kObject);
    const std::vector<Judgement> judged = JudgedInTurn(strict, actions);
    const bool is_proved = Augmentation(task, instance).standing().errors == 0;
    EXPECT_EQ(judged.back().objections.empty(), is_proved);
  }
}

}  // namespace
}  // namespace assay::constraint_posting::instance_judge_test
