#include "planner/network/simd_rows/lanes.h"

#include <gtest/gtest.h>

#include <bit>
#include <vector>

#include "planner/base/random.h"

namespace assay::network::lanes_test {
namespace {

template <class Lane>
Lane RandomSet(RandomStream& random) {
  return static_cast<Lane>(random.Next() & random.Next());
}

template <class Lane>
class Lanes : public testing::Test {
 protected:
  static constexpr int kLanes = kLanesOfBlock<Lane>;

  // Narrows the label sets by definition, one row and one label at a time. Returns false at a
  // wipe-out.
  bool Narrow(std::vector<Lane>& lanes, Word left) const {
    for (std::size_t lane = 0; lane < lanes.size(); ++lane) {
      Lane supported = 0;
      int row = 0;
      for (Label label = 0; label < 8 * static_cast<int>(sizeof(Lane)); ++label) {
        if ((labels & BitOf(label)) == 0) continue;
        if ((left & BitOf(label)) != 0) {
          supported |= rows[row * blocks + lane / kLanes].lanes[lane % kLanes];
        }
        ++row;
      }
      lanes[lane] &= supported;
      if (lanes[lane] == 0) return false;
    }
    return true;
  }

  void Draw(RandomStream& random) {
    blocks = 1 + random.Index(6);
    labels = RandomSet<Lane>(random) | 1;
    rows.resize(std::popcount(labels) * blocks);
    present.resize(blocks);
    for (Block<Lane>& block : rows) {
      for (Lane& lane : block.lanes) lane = RandomSet<Lane>(random);
    }
    for (Block<Lane>& block : present) {
      for (Lane& lane : block.lanes) {
        lane = random.Index(3) == 0 ? RandomSet<Lane>(random) & RandomSet<Lane>(random)
                                    : static_cast<Lane>(~Lane{0});
        lane |= 1;
      }
    }
  }

  std::vector<Lane> Flat() const {
    std::vector<Lane> flat;
    for (const Block<Lane>& block : present) {
      flat.insert(flat.end(), std::begin(block.lanes), std::end(block.lanes));
    }
    return flat;
  }

  int blocks = 0;
  Lane labels = 0;
  std::vector<Block<Lane>> rows, present;
};

using LaneTypes = testing::Types<std::uint16_t, std::uint32_t, std::uint64_t>;
TYPED_TEST_SUITE(Lanes, LaneTypes);

// The test covers the variant that suits the processor.
TYPED_TEST(Lanes, KeepWhatTheLabelsLeftSupport) {
  const NarrowLanes<TypeParam> narrow = QuickestNarrowLanes<TypeParam>();
  RandomStream random(1, "lanes");
  int narrowed = 0, wiped_out = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    this->Draw(random);
    Word left = this->labels;  // half of the trials have few labels left
    if (random.Index(2) == 0) left &= random.Next() & random.Next();
    const std::vector<TypeParam> before = this->Flat();
    std::vector<TypeParam> expected = before;
    const bool consistent = this->Narrow(expected, left);
    std::vector<Word> changed(WordsFor(static_cast<int>(before.size())), 0), single = changed;
    const int empty = narrow(this->present.data(), {this->rows.data(), this->labels, this->blocks},
                             left, {changed.data(), single.data()});
    ASSERT_EQ(empty == kNoWipeOut, consistent);
    if (!consistent) {
      ++wiped_out;
      continue;
    }
    ++narrowed;
    const std::vector<TypeParam> after = this->Flat();
    ASSERT_EQ(after, expected);
    for (int lane = 0; lane < std::ssize(after); ++lane) {
      const auto has = [&](const std::vector<Word>& lanes) {
        return (lanes[lane / kWordBits] & BitOf(lane)) != 0;
      };
      ASSERT_EQ(has(changed), after[lane] != before[lane]);
      ASSERT_EQ(has(single), after[lane] != before[lane] && std::has_single_bit(after[lane]));
    }
  }
  EXPECT_GT(narrowed, 50);
  EXPECT_GT(wiped_out, 100);
}

}  // namespace
}  // namespace assay::network::lanes_test
