#include "planner/domain/matings/mating_classes.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "planner/domain/problem/problem_file.h"
#include "planner/geometry/pose.h"

namespace assay::domain::mating_classes_test {
namespace {

Problem Dowel() {
  return ReadProblem(Document::Load(ASSAY_SOURCE_DIR "/scenarios/dowel.yaml"),
                     ASSAY_SOURCE_DIR "/models");
}

// Returns how many grasps suit the mating of a dowel that is seated `higher` metres above its seat,
// and how many of these touch the shaft.
std::pair<std::ptrdiff_t, std::ptrdiff_t> Suitable(double higher) {
  const Problem problem = Dowel();
  Mating mating = problem.matings.front();
  mating.X_FixedHeld = geometry::Translation(0, 0, higher) * mating.X_FixedHeld;
  const std::vector<int> labels = GraspList(problem, mating);
  const auto touches = [&](int label) {
    const auto& hidden = (*problem.part(mating.held).grasps)[label].hidden;
    return std::ranges::count(hidden, mating.features.front().first) > 0;
  };
  return {std::ssize(labels), std::ranges::count_if(labels, touches)};
}

// Pads may touch the shaft only where the hole leaves it free at the end.
TEST(GraspList, HasGraspsOnWhatStaysOutsideOfTheHole) {
  const auto [seated, on_seated_shaft] = Suitable(0);
  EXPECT_GT(seated, 0);
  EXPECT_EQ(on_seated_shaft, 0);
  const auto [raised, on_raised_shaft] = Suitable(0.02);
  EXPECT_GT(on_raised_shaft, 0);
  EXPECT_EQ(raised - on_raised_shaft, seated);
}

}  // namespace
}  // namespace assay::domain::mating_classes_test
