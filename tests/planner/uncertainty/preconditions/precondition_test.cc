#include "planner/uncertainty/preconditions/precondition.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace assay::uncertainty::precondition_test {
namespace {

using ::testing::SizeIs;

TEST(Preconditions, ThatSayTheSameAreKeptOnce) {
  algebra::ExpressionPool pool;
  const Expression x = pool.Declare("x", {0, 1});
  Preconditions all;
  all.Less(plan::condition::kSeat, "first", x, 2);
  all.Less(plan::condition::kSeat, "first", x, 2);
  all.Greater(plan::condition::kSeat, "first", x, 2);
  all.Less(plan::condition::kSeat, "first", x, 3);
  all.Less(plan::condition::kEntry, "first", x, 2);
  all.Less(plan::condition::kSeat, "first", x + 1, 2);
  EXPECT_THAT(all.Take(), SizeIs(5));
}

TEST(Preconditions, WithinIsBothSides) {
  algebra::ExpressionPool pool;
  const Expression x = pool.Declare("x", {0, 1});
  Preconditions all;
  all.Within(plan::condition::kSeat, "inside", x, 2);
  const auto both = all.Take();
  ASSERT_THAT(both, SizeIs(2));
  EXPECT_EQ(both[0].relation, plan::Relation::kLess);
  EXPECT_EQ(both[0].limit, 2);
  EXPECT_EQ(both[1].relation, plan::Relation::kGreater);
  EXPECT_EQ(both[1].limit, -2);
}

}  // namespace
}  // namespace assay::uncertainty::precondition_test
