#include "sim/report/charts/front_chart.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>

namespace assay::report::front_chart_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

FrontPicture OneCurve() {
  FrontPicture picture = {{"hand.x, mm", "peg.theta, deg"}, {1, 1}, {}};
  picture.curves.push_back({"", {{0, 4}, {1, 3}, {2, 2}, {3, 0}}, {{0, 4.04}, {1.01, 3.03}}});
  return picture;
}

// Returns the coordinates of the path of this class.
std::vector<std::array<double, 2>> PathOf(const std::string& kind, const std::string& markup) {
  std::smatch path;
  std::vector<std::array<double, 2>> corners;
  if (!std::regex_search(markup, path, std::regex("class=\"" + kind + "\" d=\"([^\"]*)\"")))
    return corners;
  const std::string d = path[1];
  const std::regex corner("([-0-9.]+) ([-0-9.]+)");
  for (std::sregex_iterator at(d.begin(), d.end(), corner), end; at != end; ++at)
    corners.push_back({std::stod((*at)[1]), std::stod((*at)[2])});
  return corners;
}

// The outline of what is proved has only corners at the points, and goes down to the right. A
// smaller error is never outside.
TEST(FrontChart, WhatIsProvedIsAStaircase) {
  const auto corners = PathOf("proved", FrontChart(OneCurve()).Markup());
  ASSERT_EQ(corners.size(), 2 + 2 * 4U);
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    EXPECT_LE(corners[i][0], corners[i + 1][0]);
    if (i > 1) {
      EXPECT_LE(corners[i - 1][1], corners[i][1]) << "y grows downwards";
    }
    EXPECT_TRUE(corners[i][0] == corners[i + 1][0] || corners[i][1] == corners[i + 1][1]);
  }
}

TEST(FrontChart, NamesAxesAndTheDeclaredErrors) {
  const std::string markup = FrontChart(OneCurve()).Markup();
  for (const char* words : {"hand.x, mm", "peg.theta, deg", "declared", "class=\"unproved\""})
    EXPECT_THAT(markup, HasSubstr(words));
}

TEST(FrontChart, LabelsCurvesIfThereAreSeveral) {
  FrontPicture picture = OneCurve();
  picture.curves[0].label = "clearance 1 mm";
  picture.curves.push_back({"clearance 2 mm", {{0, 2}, {1, 0}}, {}});
  const std::string markup = FrontChart(picture).Markup();
  EXPECT_THAT(markup, HasSubstr("clearance 1 mm"));
  EXPECT_THAT(markup, HasSubstr("clearance 2 mm"));
  EXPECT_THAT(markup, Not(HasSubstr("class=\"unproved\"")));
}

}  // namespace
}  // namespace assay::report::front_chart_test
