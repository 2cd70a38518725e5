#include "sim/mujoco/collision/group_filter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>
#include <utility>

#include "sim/mujoco/contact.h"

namespace assay::mujoco::group_filter_test {
namespace {

// Three boxes on the ground that overlap in a row, so that the first touches the second, the second
// touches the third, and all touch the ground. The fourth has no bits and touches nothing.
constexpr char kRow[] = R"(
<mujoco>
  <worldbody>
    <geom type="plane" size="5 5 1"/>
    <body name="a" pos="0 0 0.099"><freejoint/><geom type="box" size="0.1 0.1 0.1"/></body>
    <body name="b" pos="0.199 0 0.099"><freejoint/><geom type="box" size="0.1 0.1 0.1"/></body>
    <body name="c" pos="0.398 0 0.099"><freejoint/><geom type="box" size="0.1 0.1 0.1"/></body>
    <body name="ghost" pos="0 0 0.099"><freejoint/>
      <geom type="box" size="0.1 0.1 0.1" contype="0" conaffinity="0"/></body>
  </worldbody>
</mujoco>)";

std::set<std::pair<int, int>> Pairs(const Data& data) {
  std::set<std::pair<int, int>> pairs;
  for (const Contact& contact : Contacts(data)) {
    pairs.insert(std::minmax({contact.body_a.index(), contact.body_b.index()}));
  }
  return pairs;
}

const std::set<std::pair<int, int>> kAll = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {2, 3}};

TEST(GroupFilter, FindsContactsBetweenGroupsAlone) {
  Data data(Model::FromMjcf(kRow));
  EXPECT_EQ(Pairs(data), kAll);
  // World and the first box; the other two; the last.
  data.FindContacts(std::array{0, 0, 1, 1, 2});
  EXPECT_EQ(Pairs(data), (std::set<std::pair<int, int>>{{0, 2}, {0, 3}, {1, 2}}));
  for (const Contact& contact : Contacts(data)) EXPECT_TRUE(contact.force_on_b.isZero());
}

TEST(GroupFilter, EndsWithTheSearch) {
  Data data(Model::FromMjcf(kRow));
  data.FindContacts(std::array{0, 0, 0, 0, 0});
  EXPECT_TRUE(Pairs(data).empty());
  data.Forward();
  EXPECT_EQ(Pairs(data), kAll);
}

// A search for contacts changes nothing that the next steps depend on.
TEST(GroupFilter, LeavesTheSimulationAsItWas) {
  Data searched(Model::FromMjcf(kRow));
  Data other(Model::FromMjcf(kRow));
  for (int i = 0; i < 20; ++i) {
    searched.FindContacts(std::array{0, 0, 1, 1, 2});
    searched.Resume();
    searched.Step();
    other.Step();
  }
  EXPECT_TRUE(searched.Save() == other.Save());
}

}  // namespace
}  // namespace assay::mujoco::group_filter_test
