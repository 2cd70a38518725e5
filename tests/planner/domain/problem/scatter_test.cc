#include "planner/domain/problem/scatter.h"

#include <gtest/gtest.h>

#include "planner/domain/problem/problem_file.h"
#include "planner/domain/resting/resting.h"

namespace assay::domain::scatter_test {
namespace {

Problem Load(const std::string& scenario) {
  const std::string root = ASSAY_SOURCE_DIR;
  return ReadProblem(Document::Load(root + "/scenarios/" + scenario + ".yaml"), root + "/models");
}

TEST(Scatter, KeepsStablePosesAndFindsRoomForAll) {
  const Problem problem = Load("two-pegs");
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    RandomStream random(seed, "scatter");
    const std::optional<Problem> scattered = Scatter(problem, random);
    ASSERT_TRUE(scattered.has_value());
    std::vector<PlacedPart> others;
    for (std::size_t p = 0; p < problem.parts.size(); ++p) {
      const PartId id(p);
      const Part& part = scattered->parts[p];
      EXPECT_EQ(StablePoseAt(part, part.X_WorldPart), problem.parts[p].resting);
      EXPECT_TRUE(OnTable(*scattered, id, part.X_WorldPart));
      EXPECT_TRUE(Crowding(*scattered, id, part.X_WorldPart, others).IsNone());
      EXPECT_GT(
          (part.X_WorldPart.translation() - problem.parts[p].X_WorldPart.translation()).norm(),
          1e-6);
      others.push_back({.part = id, .X_WorldPart = part.X_WorldPart});
    }
  }
}

TEST(Scatter, DependsOnTheStreamAlone) {
  const Problem problem = Load("spar-fig13");
  RandomStream a(5, "scatter"), b(5, "scatter"), c(6, "scatter");
  const Pose X_a = Scatter(problem, a)->parts[0].X_WorldPart;
  EXPECT_TRUE(X_a.isApprox(Scatter(problem, b)->parts[0].X_WorldPart, 0));
  EXPECT_FALSE(X_a.isApprox(Scatter(problem, c)->parts[0].X_WorldPart, 1e-6));
}

TEST(Scatter, SaysWhenThereIsNoRoom) {
  Problem crowded = Load("spar-fig13");
  while (crowded.parts.size() < 120) crowded.parts.push_back(crowded.parts.front());
  RandomStream random(1, "scatter");
  EXPECT_FALSE(Scatter(crowded, random).has_value());
}

}  // namespace
}  // namespace assay::domain::scatter_test
