#include "planner/base/budget.h"

#include <gtest/gtest.h>

namespace assay::budget_test {
namespace {

TEST(BudgetTest, GrantsExactlyItsLimit) {
  for (int limit : {0, 1, 2, 10}) {
    Budget budget(limit);
    for (int i = 0; i < limit; ++i) {
      EXPECT_EQ(budget.spent(), i);
      EXPECT_TRUE(budget.Spend());
      EXPECT_FALSE(budget.Exhausted()) << "the last unit granted was still within the budget";
    }
    EXPECT_FALSE(budget.Spend());
    EXPECT_TRUE(budget.Exhausted());
  }
}

TEST(BudgetTest, StaysExhausted) {
  Budget budget(3);
  for (int i = 0; i < 10; ++i) budget.Spend();
  EXPECT_FALSE(budget.Spend());
  EXPECT_TRUE(budget.Exhausted());
  EXPECT_EQ(budget.spent(), 3);
  EXPECT_EQ(budget.limit(), 3);
}

}  // namespace
}  // namespace assay::budget_test
