#include "planner/motion/paths/shortening.h"

#include <gtest/gtest.h>

#include "planner/motion/collision/collision_scene.h"
#include "planner/motion/paths/joint_trajectory.h"
#include "tests/planner/motion/arm_scene.h"

namespace assay::motion::shortening_test {
namespace {

// Returns a random path of free motions.
JointPath WanderingPath(MotionCheck& check, RandomStream& random) {
  JointPath path = {check.scene().workcell().home()};
  while (path.size() < 8) {
    const JointVector next =
        path.back() + 0.2 * (RandomPosture(check.scene().arm(), random) - path.back());
    if (!check.FindObstruction(path.back(), next)) path.push_back(next);
  }
  return path;
}

TEST(Shortening, StaysFreeKeepsTheEndsAndGetsQuicker) {
  const CollisionScene scene(Clutter(), PartsAtTheStart());
  MotionCheck check(scene, {});
  const JointRates rates = RatesOf(scene.workcell());
  RandomStream random(111, "wandering");
  for (int i = 0; i < 5; ++i) {
    const JointPath path = WanderingPath(check, random);
    const JointPath shortened = Shortened(path, check, {});
    EXPECT_EQ(shortened.front(), path.front());
    EXPECT_EQ(shortened.back(), path.back());
    for (std::size_t k = 0; k + 1 < shortened.size(); ++k) {
      EXPECT_FALSE(check.FindObstruction(shortened[k], shortened[k + 1]));
    }
    EXPECT_LT(AlongPath(shortened, rates).duration(), AlongPath(path, rates).duration());
  }
}

TEST(Shortening, WithoutEffortThePathStays) {
  const CollisionScene scene(Clutter(), PartsAtTheStart());
  MotionCheck check(scene, {});
  RandomStream random(112, "wandering");
  const JointPath path = WanderingPath(check, random);
  EXPECT_EQ(Shortened(path, check, {.postures = 0}), path);
}

}  // namespace
}  // namespace assay::motion::shortening_test
