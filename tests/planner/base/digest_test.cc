#include "planner/base/digest.h"

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <cstdlib>
#include <set>
#include <string>

namespace assay::digest_test {
namespace {

std::string Of(std::initializer_list<std::string_view> texts) {
  Digest digest;
  for (const std::string_view text : texts) digest.Add(text);
  return digest.Hex();
}

TEST(Digest, IsTheSameForTheSameTexts) {
  EXPECT_EQ(Of({"one", "two"}), Of({"one", "two"}));
  EXPECT_EQ(Of({}).size(), 32u);
}

TEST(Digest, KnowsOrderAndEndsOfTexts) {
  const std::set<std::string> all = {
      Of({}),           Of({""}),         Of({"", ""}),         Of({"ab"}),
      Of({"a", "b"}),   Of({"b", "a"}),   Of({"ab", ""}),       Of({"", "ab"}),
      Of({"12345678"}), Of({"1234567"}),  Of({"12345678", ""}), Of({{"a\0", 2}}),
      Of({"a"}),        Of({"123456789"})};
  EXPECT_EQ(all.size(), 14u);
}

// A change of any bit of the text changes about half of the 64 bits in each half of the hash.
TEST(Digest, IsChangedByEveryBit) {
  const std::string text = "the quick brown fox";
  const auto half = [](const std::string& hex, int which) {
    return std::strtoull(hex.substr(16 * static_cast<std::size_t>(which), 16).c_str(), nullptr, 16);
  };
  const std::string whole = Of({text});
  for (std::size_t bit = 0; bit < 8 * text.size(); ++bit) {
    std::string other = text;
    other[bit / 8] = static_cast<char>(other[bit / 8] ^ (1 << bit % 8));
    for (const int which : {0, 1}) {
      const int changed = std::popcount(half(whole, which) ^ half(Of({other}), which));
      EXPECT_GT(changed, 12) << bit;
      EXPECT_LT(changed, 52) << bit;
    }
  }
}

}  // namespace
}  // namespace assay::digest_test
