#include "planner/network/constraint_network/relation.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace assay::network::relation_test {
namespace {

TEST(Relation, IsTheSameHoweverItIsGiven) {
  const auto below = Relation::Where(3, 70, [](Label row, Label column) { return row < column; });
  std::vector<LabelPair> allowed, forbidden;
  for (Label row = 0; row < 3; ++row) {
    for (Label column = 0; column < 70; ++column) {
      EXPECT_EQ(below->Allows(row, column), row < column);
      (row < column ? allowed : forbidden).emplace_back(row, column);
    }
  }
  EXPECT_EQ(*below, *Relation::Allowing(3, 70, allowed));
  EXPECT_EQ(*below, *Relation::Forbidding(3, 70, forbidden));
}

TEST(Relation, AgreesInBothDirections) {
  const auto relation =
      Relation::Where(90, 70, [](Label row, Label column) { return row * column % 7 == 3; });
  int most_by_row = 0, most_by_column = 0;
  for (Label row = 0; row < 90; ++row) {
    int forbidden = 0;
    for (Label column = 0; column < 70; ++column) {
      const bool allowed = row * column % 7 == 3;
      ASSERT_EQ(relation->Allows(row, column), allowed);
      ASSERT_EQ((relation->by_row().Of(row)[column / 64] >> column % 64 & 1) != 0, allowed);
      ASSERT_EQ((relation->by_column().Of(column)[row / 64] >> row % 64 & 1) != 0, allowed);
      if (!allowed) ++forbidden;
    }
    most_by_row = std::max(most_by_row, forbidden);
  }
  for (Label column = 0; column < 70; ++column) {
    int forbidden = 0;
    for (Label row = 0; row < 90; ++row) {
      if (!relation->Allows(row, column)) ++forbidden;
    }
    most_by_column = std::max(most_by_column, forbidden);
  }
  EXPECT_EQ(relation->by_row().most_unsupporting, most_by_row);
  EXPECT_EQ(relation->by_column().most_unsupporting, most_by_column);
}

TEST(RelationDeathTest, RefusesPairsOutside) {
  const std::vector<LabelPair> pairs = {{0, 2}};
  EXPECT_DEATH(Relation::Allowing(2, 2, pairs), "pair \\(0, 2\\) of a 2 x 2 relation");
}

}  // namespace
}  // namespace assay::network::relation_test
