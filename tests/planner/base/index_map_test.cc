#include "planner/base/index_map.h"

#include <gtest/gtest.h>

#include <map>

#include "planner/base/random.h"

namespace assay::index_map_test {
namespace {

TEST(IndexMapTest, DoesWhatAMapDoes) {
  RandomStream random(1, "index map");
  IndexMap<int> indexed;
  std::map<int, int> map;
  for (int i = 0; i < 2000; ++i) {
    const int index = random.Index(1000);
    ASSERT_EQ(indexed.Find(index) == nullptr, !map.contains(index)) << index;
    const auto [value, is_new] = indexed.Insert(index);
    EXPECT_EQ(is_new, !map.contains(index));
    EXPECT_EQ(value, map[index]);
    indexed[index] = map[index] = i;
  }
}

}  // namespace
}  // namespace assay::index_map_test
