#include "planner/network/constraint_network/support.h"

#include <gtest/gtest.h>

#include <bit>
#include <vector>

#include "planner/base/random.h"

namespace assay::network::support_test {
namespace {

Word WordOfLength(int labels) { return labels == 0 ? 0 : ~Word{0} >> (kWordBits - labels); }

// The test covers the variant that the loader chose. The words end after the last label, so that
// the address sanitizer finds reads beyond it.
TEST(Support, IsThereForLabelsWithACommonBitAndNoOthers) {
  RandomStream random(1, "support");
  for (int size = 1; size <= kWordBits; ++size) {
    for (int trial = 0; trial < 20; ++trial) {
      std::vector<Word> supports(size);
      for (Word& word : supports) word = random.Next() & random.Next() & random.Next();
      const Word labels = random.Next() & WordOfLength(size);
      const Word others = random.Next() & random.Next();
      Word expected = 0;
      for (Label label = 0; label < size; ++label) {
        if ((labels & BitOf(label)) != 0 && (supports[label] & others) != 0) {
          expected |= BitOf(label);
        }
      }
      ASSERT_EQ(Supported(supports.data(), labels, others), expected) << size << " labels";
    }
  }
}

}  // namespace
}  // namespace assay::network::support_test
