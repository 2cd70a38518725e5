#include "sim/report/numbers/figures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "sim/report/findings/command.h"
#include "sim/report/html/data_uri.h"
#include "sim/report/html/element.h"

namespace assay::report::figures_test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(Figures, NumbersHaveSensibleDigits) {
  EXPECT_EQ(NumberText(0), "0");
  EXPECT_EQ(NumberText(0.13610226), "0.136");
  EXPECT_EQ(NumberText(-1234.5), "−1,234");
  EXPECT_EQ(NumberText(12.5), "12.5");
  EXPECT_EQ(NumberText(0.5), "0.5");
  EXPECT_EQ(NumberText(2.14e-7), "2.1 × 10⁻⁷");
  EXPECT_EQ(NumberText(kInfinity), "∞");
  EXPECT_EQ(NumberText(std::nan("")), "–");
  EXPECT_EQ(CountText(20000), "20,000");
  EXPECT_EQ(CountText(-1234567), "−1,234,567");
  EXPECT_EQ(CountText(1, "trial"), "1 trial");
}

TEST(Figures, IntervalsAreInTheUnitThatIsShown) {
  EXPECT_EQ(IntervalText({-0.00013, 0.00013}, domain::Dimension::kLength), "±0.13 mm");
  EXPECT_EQ(IntervalText({-0.0002, 0.00031}, domain::Dimension::kLength), "−0.2 to 0.31 mm");
  EXPECT_EQ(IntervalText({0, kInfinity}, domain::Dimension::kLength), "≥ 0 mm");
  EXPECT_EQ(IntervalText({-kInfinity, 0.001}, domain::Dimension::kLength), "≤ 1 mm");
  EXPECT_EQ(IntervalText({0, 0}, domain::Dimension::kAngle), "0°");
  EXPECT_EQ(QuantityText(std::acos(-1.0), domain::Dimension::kAngle), "180°");
}

TEST(Figures, RatesAreAllOrNothingOnlyIfTheyAre) {
  EXPECT_EQ(RateText(10, 10), "100 %");
  EXPECT_EQ(RateText(0, 10), "0 %");
  EXPECT_EQ(RateText(981, 1000), "98.1 %");
  EXPECT_EQ(RateText(9999, 10000), "99.99 %");
  EXPECT_EQ(RateText(1, 10000), "0.01 %");
  EXPECT_EQ(RateText(0, 0), "–");
}

TEST(Element, EscapesTextAndAttributes) {
  const Element element = Element("p", "<&\"'>").Set("title", "<&\"'>");
  EXPECT_EQ(element.Markup(), "<p title=\"&lt;&amp;&quot;&#39;&gt;\">&lt;&amp;&quot;&#39;&gt;</p>");
  EXPECT_EQ(Escaped(std::string("a\0b\x1b", 4)), "a\\x00b\\x1b");
}

TEST(Command, QuotesThePath) {
  EXPECT_EQ(ReplayCommand("out/a-1.sqlite", 7), "assay replay out/a-1.sqlite 7");
  EXPECT_EQ(ReplayCommand("it's.sqlite", 7), "assay replay 'it'\\''s.sqlite' 7");
  EXPECT_EQ(WithDatabase("assay replay DB 7", "a.sqlite"), "assay replay a.sqlite 7");
  EXPECT_EQ(WithDatabase("assay replay DB", "a.sqlite"), "assay replay a.sqlite");
  EXPECT_EQ(WithDatabase("assay run x", "a.sqlite"), "assay run x");
}

// The examples are those of RFC 4648, section 10.
TEST(DataUri, IsBase64) {
  EXPECT_EQ(DataUri("a/b", "f"), "data:a/b;base64,Zg==");
  EXPECT_EQ(DataUri("a/b", "fo"), "data:a/b;base64,Zm8=");
  EXPECT_EQ(DataUri("a/b", "foobar"), "data:a/b;base64,Zm9vYmFy");
}

}  // namespace
}  // namespace assay::report::figures_test
