#include "planner/base/id.h"

#include <gtest/gtest.h>

#include <type_traits>
#include <unordered_set>

namespace assay::id_test {
namespace {

using PartId = Id<struct PartTag>;
using StepId = Id<struct StepTag>;

static_assert(!std::is_convertible_v<int, PartId>, "an index becomes an id only by name");
static_assert(!std::is_convertible_v<PartId, int>);
static_assert(!std::is_convertible_v<PartId, StepId>, "a part is not a step");
static_assert(!std::is_constructible_v<StepId, PartId>);
static_assert(PartId(3).index() == 3);

TEST(IdTest, NoneNamesNoThing) {
  EXPECT_TRUE(PartId::None().IsNone());
  EXPECT_EQ(PartId(), PartId::None());
  EXPECT_FALSE(PartId(0).IsNone());
  EXPECT_NE(PartId(0), PartId::None());
}

TEST(IdTest, IsOrderedByIndexWithNoneFirst) {
  EXPECT_LT(PartId::None(), PartId(0));
  EXPECT_LT(PartId(1), PartId(2));
  EXPECT_EQ(PartId(2), PartId(std::size_t{2}));
}

TEST(IdTest, CanBeHashed) {
  std::unordered_set<PartId> ids;
  for (int i = 0; i < 100; ++i) ids.insert(PartId(i % 10));
  ids.insert(PartId::None());
  EXPECT_EQ(ids.size(), 11u);
  EXPECT_TRUE(ids.contains(PartId(9)));
  EXPECT_FALSE(ids.contains(PartId(10)));
}

}  // namespace
}  // namespace assay::id_test
