#include <gtest/gtest.h>

#include <algorithm>

#include "planner/domain/parts/part_file.h"
#include "planner/finemotion/strategy_search/mating.h"
#include "tests/planner/domain/scenario.h"

// The critical points of the matings of the parts in the repository. The expected values follow
// from the dimensions in the part files.
namespace assay::finemotion::model_critical_points_test {
namespace {

constexpr double kInch = 0.0254;

// Returns the critical points along the mating vector of the goal of the scenario, for parts
// without clearance.
std::vector<CriticalPoint> CriticalPointsIn(const std::string& scenario) {
  const domain::Problem problem = domain::LoadScenario(scenario);
  const domain::Mating& mating = problem.matings.front();
  const auto outside = [&](domain::PartId part) {
    return OutsideOf(*domain::PartFile::WithClearance(*problem.part(part).model, 0));
  };
  return CriticalPoints(outside(mating.held), outside(mating.fixed), mating.X_FixedHeld,
                        mating.mating_vector);
}

// For each critical point: the distance that is left to the seat, in inches, and the number of
// pairs of faces that touch after the point.
struct Expected {
  const char* scenario;
  std::vector<double> left;
  std::vector<std::size_t> touching;
};

class ModelCriticalPoints : public testing::TestWithParam<Expected> {};

TEST_P(ModelCriticalPoints, AreWhereTheDimensionsSay) {
  const std::vector<CriticalPoint> points = CriticalPointsIn(GetParam().scenario);
  ASSERT_EQ(points.size(), GetParam().left.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_NEAR(points[i].travel, (4 - GetParam().left[i]) * kInch, 1e-9) << i;
    EXPECT_EQ(points[i].after.size(), GetParam().touching[i]) << i;
    EXPECT_EQ(points[i].before, i == 0 ? std::vector<TouchingFaces>() : points[i - 1].after);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Scenarios, ModelCriticalPoints,
    testing::Values(
        // The shaft enters, and then the plate lands.
        Expected{"spar-fig15", {2.75, 0}, {4, 5}},
        // Shaft and key enter together. Three sides of each touch. The fourth side of the shaft
        // touches to the left and to the right of the key.
        Expected{"keyed", {2.75, 0}, {8, 9}}, Expected{"mate-keyed", {2.75, 0}, {8, 9}},
        // First the narrow shaft enters its hole in the step, which is 1.65 deep. Then the wide
        // shaft enters its hole, and then the plate lands.
        Expected{"mate-stepped", {1.65, 1.05, 0}, {4, 8, 9}},
        Expected{"mate-octagonal", {2.75, 0}, {8, 9}},
        // The head enters the mouth with both ends and the back. Then it goes under the two lips,
        // with the stem between them. Then the plate lands.
        Expected{"mate-t-slot", {2.75, 1.95, 0}, {3, 7, 8}}),
    [](const auto& test) {
      std::string name = test.param.scenario;
      std::ranges::replace(name, '-', '_');
      return name;
    });

}  // namespace
}  // namespace assay::finemotion::model_critical_points_test
