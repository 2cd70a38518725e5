#include "planner/base/input_files/quotation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planner/base/input_files/input_error.h"
#include "planner/base/random.h"

namespace assay::quotation_test {
namespace {

// Returns bytes of all kinds, many of which matter: escapes, and starts and middles of characters.
std::string RandomBytes(RandomStream& random) {
  static const std::string kLikely =
      "\x1b[31m\x07\r\n\t\x7f\xc2\x9b\xe2\x80\xae\xff\xc0\x80\xed\xa0";
  std::string bytes;
  for (int i = random.Index(40); i > 0; --i) {
    bytes += random.Index(2) == 0
                 ? kLikely[static_cast<std::size_t>(random.Index(static_cast<int>(kLikely.size())))]
                 : static_cast<char>(random.Index(256));
  }
  return bytes;
}

// Returns whether the text is UTF-8, by the table of RFC 3629, section 4, one production after the
// other.
bool IsUtf8(const std::string& text) {
  const auto in = [&](std::size_t i, int low, int high) {
    const int byte = i < text.size() ? static_cast<unsigned char>(text[i]) : -1;
    return byte >= low && byte <= high;
  };
  const auto tail = [&](std::size_t i) { return in(i, 0x80, 0xbf); };
  for (std::size_t i = 0; i < text.size();) {
    const bool two = in(i, 0xc2, 0xdf) && tail(i + 1);
    const bool three =
        ((in(i, 0xe0, 0xe0) && in(i + 1, 0xa0, 0xbf)) || (in(i, 0xe1, 0xec) && tail(i + 1)) ||
         (in(i, 0xed, 0xed) && in(i + 1, 0x80, 0x9f)) || (in(i, 0xee, 0xef) && tail(i + 1))) &&
        tail(i + 2);
    const bool four =
        ((in(i, 0xf0, 0xf0) && in(i + 1, 0x90, 0xbf)) || (in(i, 0xf1, 0xf3) && tail(i + 1)) ||
         (in(i, 0xf4, 0xf4) && in(i + 1, 0x80, 0x8f))) &&
        tail(i + 2) && tail(i + 3);
    const std::size_t bytes = in(i, 0, 0x7f) ? 1 : two ? 2 : three ? 3 : four ? 4 : 0;
    if (bytes == 0) return false;
    i += bytes;
  }
  return true;
}

// Returns whether the text has no control characters of a terminal: C0 except `allowed`, DEL, C1,
// and U+202A to U+202E.
bool IsHarmless(const std::string& text, const std::string& allowed) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    if ((byte < 0x20 && allowed.find(text[i]) == std::string::npos) || byte == 0x7f) return false;
    const auto next = static_cast<unsigned char>(i + 1 < text.size() ? text[i + 1] : 0);
    if (byte == 0xc2 && next < 0xa0) return false;
    if (text.compare(i, 2, "\xe2\x80") == 0 && i + 2 < text.size() &&
        static_cast<unsigned char>(text[i + 2]) >= 0xaa &&
        static_cast<unsigned char>(text[i + 2]) <= 0xae) {
      return false;
    }
  }
  return true;
}

TEST(Shown, IsUtf8WithoutControlCharactersWhateverTheBytes) {
  RandomStream random(1, "shown");
  for (int i = 0; i < 2'000; ++i) {
    const std::string bytes = RandomBytes(random);
    EXPECT_TRUE(IsUtf8(Show(bytes)) && IsHarmless(Show(bytes), ""));
    EXPECT_TRUE(IsUtf8(ShowLines(bytes)) && IsHarmless(ShowLines(bytes), "\n\t"));
    EXPECT_EQ(Show(Show(bytes)), Show(bytes));
    EXPECT_EQ(ShowLines(ShowLines(bytes)), ShowLines(bytes));
  }
}

TEST(Shown, KeepsWhatIsPlain) {
  const std::string text = "Größe 5 µm, 组装";
  EXPECT_EQ(Show(text), text);
  EXPECT_EQ(ShowLines("a\tb\n" + text), "a\tb\n" + text);
}

TEST(Shown, NamesWhatIsNot) {
  EXPECT_EQ(Show("a\x1b[31m\nb\xff"), "a\\x1b[31m\\nb\\xff");
  EXPECT_EQ(ShowLines("a\x1b\nb"), "a\\x1b\nb");
}

TEST(Shown, IsCutByCharacters) {
  EXPECT_EQ(Show("äöü", 3), "äöü");
  EXPECT_EQ(Show("äöü", 2), "äö...");
  EXPECT_EQ(Quote(std::string(100'000, 'A')), "'" + std::string(60, 'A') + "...'");
}

// The message is readable whatever bytes the error contains.
TEST(InputErrors, AreShownAndCut) {
  const InputError error({.file = "a\x1b\n", .line = 1, .column = 2}, "no \xff",
                         std::string(1'000'000, 'A'));
  EXPECT_THAT(error.what(), ::testing::StartsWith("a\\x1b\\n:1:2: no \\xff; allowed: AAA"));
  EXPECT_LT(std::string(error.what()).size(), 3 * kMessageCharacters);
}

}  // namespace
}  // namespace assay::quotation_test
