#include "sim/execution/trial/trial_outcome.h"

#include <gtest/gtest.h>

#include <set>

namespace assay::execution::trial_outcome_test {
namespace {

TEST(TrialOutcome, NamesDiffer) {
  std::set<std::string_view> names;
  constexpr int kCount = 1 + static_cast<int>(TrialOutcome::kMissed);
  for (int i = 0; i < kCount; ++i) names.insert(Name(static_cast<TrialOutcome>(i)));
  EXPECT_EQ(names.size(), kCount);
}

TEST(TrialOutcome, NamesAreThoseOfTheirOutcomes) {
  EXPECT_EQ(Name(TrialOutcome::kSucceeded), "succeeded");
  EXPECT_EQ(Name(TrialOutcome::kOperatorCalled), "operator-called");
  EXPECT_EQ(Name(TrialOutcome::kJammed), "jammed");
  EXPECT_EQ(Name(TrialOutcome::kDropped), "dropped");
  EXPECT_EQ(Name(TrialOutcome::kFalseClaim), "false-claim");
  EXPECT_EQ(Name(TrialOutcome::kNotAtRest), "not-at-rest");
  EXPECT_EQ(Name(TrialOutcome::kMissed), "missed");
}

TEST(TrialOutcome, TheEndOfAnExecutionIsDoneOrNamedAsItsOutcome) {
  EXPECT_EQ(NameOfEnd(TrialOutcome::kSucceeded), "done");
  EXPECT_EQ(NameOfEnd(TrialOutcome::kWedged), "wedged");
}

}  // namespace
}  // namespace assay::execution::trial_outcome_test
