#include "planner/finemotion/strategy_search/starts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "bench/workloads/pegs.h"
#include "planner/finemotion/strategy_search/mating.h"

namespace assay::finemotion::starts_test {
namespace {

constexpr std::uint64_t kSeed = 280;
constexpr double kHalf = 0.03;  // half of the width of the peg, metres: wider than the reach
constexpr double kDegree = std::numbers::pi / 180;

Passage WidePegInHole() {
  Passage passage;
  passage.moving = workloads::BoxShape({-kHalf, -kHalf, 0}, {kHalf, kHalf, 0.07});
  passage.stationary = workloads::SquareHoleShape(kHalf + 0.25e-3, 0.06, 0.07);
  passage.seat = 0.06;
  return passage;
}

// Returns the least height of the part above the plane of the entry, in metres, over all corners of
// the error box: an oracle that looks at each corner.
double LeastHeight(const Passage& passage, const Pose& X_StationaryMoving,
                   const PoseChange& errors) {
  double least = std::numeric_limits<double>::infinity();
  for (unsigned corner = 0; corner < 64; ++corner) {
    PoseChange z = errors;
    for (int i = 0; i < 6; ++i) {
      if ((corner >> static_cast<unsigned>(i)) % 2 == 1) z[i] = -z[i];
    }
    const Pose true_pose = Displaced(X_StationaryMoving, z);
    for (const OuterVertex& vertex : passage.moving.vertices) {
      const Vector3 behind = passage.X_StationaryEntry.translation() - true_pose * vertex.p;
      least = std::min(least, behind.dot(passage.mating));
    }
  }
  return least;
}

// No corner of the error box, however it is multiplied, brings the part into the plane of the
// entry.
TEST(Starts, AreFreeForTheMultipleOfTheErrors) {
  const Passage passage = WidePegInHole();
  const StrategyOptions options;
  RandomStream random(kSeed, "errors and multiples");
  for (int i = 0; i < 300; ++i) {
    FineMotionErrors errors;
    errors.pose << Vector3::Constant(random.Uniform(0, 4e-3)),
        Vector3::Constant(random.Uniform(0, 4 * kDegree));
    Starts starts(passage, errors, options, random);
    const Start start = starts.Random();
    const double multiple = random.Uniform(0.1, 4);
    const Pose X_StationaryMoving = starts.BelievedPoseAt(start, multiple).X_StationaryMoving;
    EXPECT_GT(LeastHeight(passage, X_StationaryMoving, multiple * errors.pose), 0)
        << "with " << multiple << " times " << errors.pose.transpose();
  }
}

}  // namespace
}  // namespace assay::finemotion::starts_test
