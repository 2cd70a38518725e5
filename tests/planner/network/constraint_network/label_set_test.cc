#include "planner/network/constraint_network/label_set.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "planner/base/random.h"

namespace assay::network::label_set_test {
namespace {

TEST(LabelSet, HasAllOrNoLabels) {
  for (int size : {0, 1, 63, 64, 65, 128, 130}) {
    EXPECT_EQ(LabelSet::All(size).count(), size);
    EXPECT_EQ(LabelSet::None(size).count(), 0);
    EXPECT_TRUE(LabelSet::None(size).empty());
    EXPECT_EQ(LabelSet::All(size).empty(), size == 0);
    EXPECT_FALSE(LabelSet::All(size).contains(size));
    EXPECT_FALSE(LabelSet::All(size).contains(-1));
  }
}

TEST(LabelSet, IteratesInOrder) {
  const LabelSet labels = LabelSet::Of(200, {199, 3, 64, 63, 128});
  EXPECT_THAT(std::vector<Label>(labels.begin(), labels.end()),
              testing::ElementsAre(3, 63, 64, 128, 199));
  EXPECT_EQ(labels.first(), 3);
}

TEST(LabelSet, SetsOfDifferentSizesDiffer) {
  EXPECT_NE(LabelSet::Of(3, {1}), LabelSet::Of(4, {1}));
  EXPECT_EQ(LabelSet::Of(3, {1, 2}), LabelSet::Of(3, {2, 1}));
}

TEST(LabelSet, BehavesLikeASetOfIntegers) {
  RandomStream random(1, "label-set");
  for (int trial = 0; trial < 200; ++trial) {
    const int size = 1 + random.Index(150);
    LabelSet a = LabelSet::None(size), b = LabelSet::None(size);
    std::set<Label> members_a, members_b;
    for (int i = 0; i < 100; ++i) {
      const Label label = random.Index(size);
      switch (random.Index(3)) {
        case 0:
          a.insert(label);
          members_a.insert(label);
          break;
        case 1:
          a.erase(label);
          members_a.erase(label);
          break;
        default:
          b.insert(label);
          members_b.insert(label);
      }
    }
    ASSERT_THAT(std::vector<Label>(a.begin(), a.end()), testing::ElementsAreArray(members_a));
    LabelSet both = a;
    both.intersect(b);
    for (Label label = 0; label < size; ++label) {
      ASSERT_EQ(both.contains(label), members_a.contains(label) && members_b.contains(label));
    }
  }
}

TEST(LabelSetDeathTest, RefusesLabelsOutside) {
  LabelSet labels = LabelSet::All(3);
  EXPECT_DEATH(labels.insert(3), "label 3 of 3");
  EXPECT_DEATH(labels.intersect(LabelSet::All(4)), "3 and 4 labels");
}

}  // namespace
}  // namespace assay::network::label_set_test
