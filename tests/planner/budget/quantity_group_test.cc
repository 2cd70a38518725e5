#include "planner/budget/quantity_group.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace assay::budget::quantity_group_test {
namespace {

using ::testing::ElementsAre;

const std::vector<ErrorQuantity> kQuantities = {
    {"camera.x", domain::Dimension::kLength, {-0.001, 0.001}},
    {"camera.y", domain::Dimension::kLength, {-0.001, 0.001}},
    {"clearance", domain::Dimension::kLength, {-0.1, 0.1}}};

TEST(QuantityGroup, HasOneQuantityOrSeveralCoordinates) {
  EXPECT_THAT(FindGroup("clearance", kQuantities)->quantities, ElementsAre(2U));
  EXPECT_THAT(FindGroup("camera.y", kQuantities)->quantities, ElementsAre(1U));
  EXPECT_THAT(FindGroup("camera.yx", kQuantities)->quantities, ElementsAre(1U, 0U));
}

TEST(QuantityGroup, OfUnknownNamesIsNone) {
  for (const char* name : {"", "camera", "camera.", "camera.z", "camera.xz", "clearance.x", "x"})
    EXPECT_FALSE(FindGroup(name, kQuantities)) << name;
}

}  // namespace
}  // namespace assay::budget::quantity_group_test
