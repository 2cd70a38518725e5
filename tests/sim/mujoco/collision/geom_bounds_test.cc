#include "sim/mujoco/collision/geom_bounds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "planner/base/random.h"
#include "planner/geometry/pose.h"
#include "sim/mujoco/contact.h"
#include "sim/mujoco/data.h"

namespace assay::mujoco::geom_bounds_test {
namespace {

using geometry::Pose;
using geometry::Vector3;

// A body of several kinds of solids, a plane, and two bodies that float about them. The tetrahedron
// is far from the middle of its frame.
constexpr char kBodies[] = R"(<mujoco>
  <asset><mesh name="tetrahedron" vertex="0.2 0 0  0.25 0 0  0.2 0.06 0  0.2 0 0.07"/></asset>
  <worldbody>
    <geom type="plane" size="1 1 1" pos="0 0 -0.3"/>
    <geom type="box" size="0.05 0.03 0.02"/>
    <geom type="cylinder" size="0.03 0.05" pos="0.2 0 0" euler="30 0 0"/>
    <geom type="capsule" size="0.02 0.04" pos="-0.2 0 0" euler="0 50 0"/>
    <geom type="sphere" size="0.04" pos="0 0.2 0"/>
    <body name="a"><freejoint/>
      <geom type="box" size="0.02 0.05 0.04" pos="0.05 0 0" euler="0 0 20" mass="1"/>
      <geom type="box" size="0.3 0.3 0.3" contype="0" conaffinity="0" mass="1"/></body>
    <body name="b"><freejoint/><geom type="mesh" mesh="tetrahedron" mass="1"/></body>
  </worldbody></mujoco>)";

std::vector<double> Qpos(const Pose& X) {
  const Vector3 p = X.translation();
  const Eigen::Quaterniond turn(X.linear());
  return {p.x(), p.y(), p.z(), turn.w(), turn.x(), turn.y(), turn.z()};
}

Vector3 Drawn(RandomStream& random, double most) {
  return {random.Uniform(-most, most), random.Uniform(-most, most), random.Uniform(-most, most)};
}

Pose Anywhere(RandomStream& random, double most) {
  const Vector3 axis = Drawn(random, 1).normalized();
  Pose X(Eigen::AngleAxisd(random.Uniform(0, 3), axis));
  X.pretranslate(Drawn(random, most));
  return X;
}

class GeomBoundsTest : public testing::Test {
 protected:
  void Put(const Pose& X_WorldA, const Pose& X_WorldB) {
    const std::vector<double> a = Qpos(X_WorldA);
    const std::vector<double> b = Qpos(X_WorldB);
    std::ranges::copy(a, data_.qpos().begin());
    std::ranges::copy(b, data_.qpos().begin() + 7);
    data_.MoveBodies();
  }

  bool Touches(const std::vector<int>& groups) {
    data_.FindContacts(groups);
    return !Contacts(data_).empty();
  }

  const Model model_ = Model::FromMjcf(kBodies);
  Data data_{model_};
};

// The engine's own search for contacts is the oracle: bodies that keep a distance do not touch
// wherever they move by less.
TEST_F(GeomBoundsTest, BodiesThatMoveByLessDoNotTouch) {
  const std::vector<int> groups = {0, 1, 2};
  RandomStream random(31, "bodies apart");
  int apart = 0;
  for (int i = 0; i < 20000; ++i) {
    const Pose X_WorldA = Anywhere(random, 0.3);
    const Pose X_WorldB = Anywhere(random, 0.3);
    Put(X_WorldA, X_WorldB);
    SCOPED_TRACE(testing::Message() << "pose " << i << " of seed 31");
    const double separation = data_.LeastSeparation(groups);
    const bool may_touch = separation == 0;
    ASSERT_TRUE(may_touch || !Touches(groups));
    if (may_touch) continue;
    ++apart;
    const Vector3 a = 0.49 * separation * Drawn(random, 1).normalized();
    const Vector3 b = 0.49 * separation * Drawn(random, 1).normalized();
    Put(geometry::Translation(a) * X_WorldA, geometry::Translation(b) * X_WorldB);
    ASSERT_FALSE(Touches(groups));
  }
  EXPECT_GT(apart, 2000);
}

TEST_F(GeomBoundsTest, IsTheGapOfParallelFaces) {
  const std::vector<int> groups = {0, 1, 1};
  const Pose level = Pose(geometry::RotationZ(-20 * std::numbers::pi / 180));
  Put(geometry::Translation(0, 0, 0.02 + 0.04 + 0.013) * level, geometry::Translation(0, 0, 1));
  EXPECT_NEAR(data_.LeastSeparation(groups), 0.013, 1e-12);
  Put(geometry::Translation(0, -0.5, -0.3 + 0.04 + 0.011), geometry::Translation(0, 0, 1));
  EXPECT_NEAR(data_.LeastSeparation(groups), 0.011, 1e-12);
}

TEST_F(GeomBoundsTest, BodiesOfOneGroupMayTouch) {
  Put(Pose::Identity(), Pose::Identity());
  EXPECT_EQ(data_.LeastSeparation(std::vector<int>{0, 0, 0}),
            std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace assay::mujoco::geom_bounds_test
