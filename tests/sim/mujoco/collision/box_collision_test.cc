#include "sim/mujoco/collision/box_collision.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "planner/base/random.h"
#include "planner/geometry/box.h"
#include "planner/geometry/pose.h"
#include "sim/mujoco/contact.h"

namespace assay::mujoco::box_collision_test {
namespace {

using geometry::Pose;
using geometry::Vector3;

// Returns a model in which only these two boxes can touch. A test puts the upper box into place.
std::string Pair(const Vector3& lower, const Vector3& upper) {
  return fmt::format(R"(<mujoco><worldbody>
    <geom name="lower" type="box" size="{} {} {}"/>
    <body name="upper"><freejoint/><geom type="box" size="{} {} {}" mass="1"/></body>
    </worldbody></mujoco>)",
                     lower.x(), lower.y(), lower.z(), upper.x(), upper.y(), upper.z());
}

void Put(const Pose& X_WorldUpper, Data& data) {
  const Vector3 p = X_WorldUpper.translation();
  const Eigen::Quaterniond turn(X_WorldUpper.linear());
  const double values[7] = {p.x(), p.y(), p.z(), turn.w(), turn.x(), turn.y(), turn.z()};
  std::copy(values, values + 7, data.qpos().begin());
  data.Forward();
}

double Magnitude(RandomStream& random, double low, double high) {
  return std::exp(random.Uniform(std::log(low), std::log(high)));
}

struct Case {
  double tilt = 0;   // radians
  double depth = 0;  // metres
  Pose X_WorldUpper = Pose::Identity();
};

constexpr double kLowerHeight = 0.02;  // half of the height
const Vector3 kUpper(0.03556, 0.009275, 0.08255);

// Returns a random pose of the upper box, with its x face on the lower box's z face, at any place
// and yaw. The box is slightly tilted about one of its edges or about any direction.
Case Draw(RandomStream& random) {
  Case drawn;
  drawn.tilt = Magnitude(random, 1e-18, 1e-4);
  drawn.depth = Magnitude(random, 1e-10, 1e-6) + 0.04 * drawn.tilt;
  const double yaw = random.Uniform(-3.2, 3.2);
  const double directions[] = {yaw, yaw + std::numbers::pi / 2, random.Uniform(0, 6.3)};
  const double direction = directions[random.Index(3)];
  const Vector3 axis(std::cos(direction), std::sin(direction), 0);
  const Pose tilt(Eigen::AngleAxisd(drawn.tilt, axis));
  const double x = random.Uniform(-0.25, 0.25);
  const double y = random.Uniform(-0.5, 0.5);
  drawn.X_WorldUpper = geometry::Translation(x, y, kLowerHeight + kUpper.x() - drawn.depth) * tilt *
                       geometry::RotationZ(yaw) * geometry::RotationY(std::numbers::pi / 2);
  return drawn;
}

// Returns how many corners of the upper box are in the lower one by more than `depth` metres.
std::size_t CornersDeeperThan(double depth, const Pose& X_WorldUpper) {
  const geometry::Box box{X_WorldUpper, kUpper};
  const auto corners = box.Corners();
  return static_cast<std::size_t>(std::ranges::count_if(
      corners, [&](const Vector3& corner) { return kLowerHeight - corner.z() > depth; }));
}

// Exactly the corners that are in the lower box touch, and no deeper than they are in.
TEST(BoxCollision, OfNearlyParallelFacesTheCornersTouch) {
  constexpr double kRounding = 1e-11;  // metres
  const Model model = Model::FromMjcf(Pair({0.375, 0.65, kLowerHeight}, kUpper));
  Data data(model);
  RandomStream random(20, "nearly parallel boxes");
  for (int i = 0; i < 100000; ++i) {
    const Case drawn = Draw(random);
    Put(drawn.X_WorldUpper, data);
    const auto contacts = ContactsBetween(data, BodyId(0), model.Body("upper"));
    SCOPED_TRACE(testing::Message() << "pose " << i << " of seed 20, tilt " << drawn.tilt);
    ASSERT_GE(contacts.size(), CornersDeeperThan(kRounding, drawn.X_WorldUpper));
    ASSERT_LE(contacts.size(), CornersDeeperThan(-kRounding, drawn.X_WorldUpper));
    for (const Contact& contact : contacts) {
      ASSERT_GE(contact.distance, -drawn.depth - 0.1 * drawn.tilt - kRounding);
      const Vector3 corner = (drawn.X_WorldUpper.inverse() * contact.position).cwiseAbs();
      ASSERT_LT((corner - kUpper).norm(), 2e-5);
    }
  }
}

// Returns how deep the corner of the upper box that is nearest to a point lies in the lower box.
double DepthOfCornerAt(const Vector3& at, const Pose& X_WorldUpper) {
  const auto corners = geometry::Box{X_WorldUpper, kUpper}.Corners();
  const auto distance = [&](const Vector3& corner) { return (corner - at).norm(); };
  return kLowerHeight - std::ranges::min_element(corners, {}, distance)->z();
}

TEST(BoxCollision, ContactsOfNearlyParallelFacesHaveHalfOfTheDepth) {
  const Model model = Model::FromMjcf(Pair({0.375, 0.65, kLowerHeight}, kUpper));
  Data data(model);
  RandomStream random(22, "depth of nearly parallel boxes");
  for (int i = 0; i < 100000; ++i) {
    const Case drawn = Draw(random);
    Put(drawn.X_WorldUpper, data);
    SCOPED_TRACE(testing::Message() << "pose " << i << " of seed 22, tilt " << drawn.tilt);
    for (const Contact& contact : ContactsBetween(data, BodyId(0), model.Body("upper"))) {
      const double depth = DepthOfCornerAt(contact.position, drawn.X_WorldUpper);
      ASSERT_NEAR(-2 * contact.distance, depth, 1e-3 * depth + 1e-11);
    }
  }
}

// Returns how far a box reaches in a direction.
double Reach(const geometry::Box& box, const Vector3& direction) {
  double reach = -std::numeric_limits<double>::infinity();
  for (const Vector3& corner : box.Corners()) reach = std::max(reach, corner.dot(direction));
  return reach;
}

Vector3 Drawn(RandomStream& random, const Vector3& most) {
  return {random.Uniform(-most.x(), most.x()), random.Uniform(-most.y(), most.y()),
          random.Uniform(-most.z(), most.z())};
}

const Vector3 kLower(0.3, 0.4, kLowerHeight);

// Returns a random pose of the upper box with one corner in the lower box's upper face.
Pose CornerInFace(RandomStream& random, double depth) {
  Pose X(geometry::RotationZ(random.Uniform(-3, 3)) * geometry::RotationX(random.Uniform(0.1, 1)) *
         geometry::RotationY(random.Uniform(0.1, 1)));
  const auto corners = geometry::Box{X, kUpper}.Corners();
  const auto height = [](const Vector3& corner) { return corner.z(); };
  const Vector3 lowest = *std::ranges::min_element(corners, {}, height);
  const Vector3 at = Drawn(random, 0.9 * kLower);
  X.pretranslate(Vector3(at.x(), at.y(), kLowerHeight - depth) - lowest);
  return X;
}

// Returns a random pose of the upper box with an edge along its z axis across the lower box's edge
// along the x axis.
Pose EdgeAcrossEdge(RandomStream& random, double depth) {
  const Vector3 outward = Vector3(0, 1, 1).normalized();
  Eigen::Matrix3d R;
  R.col(2) = outward.cross(Vector3::UnitX());
  R.col(0) = (outward + Vector3::UnitX()).normalized();
  R.col(1) = R.col(2).cross(R.col(0));
  const Vector3 turn = Drawn(random, {0.3, 0.3, 0.3});
  Pose X(Eigen::AngleAxisd(turn.norm(), turn.normalized()) * R);
  const Vector3 normal = Vector3::UnitX().cross(X.linear().col(2)).normalized();
  const Vector3 below(-kUpper.x(), kUpper.y(), random.Uniform(-0.05, 0.05));
  const Vector3 at(random.Uniform(-0.2, 0.2), kLower.y(), kLower.z());
  X.pretranslate(at - std::copysign(depth, normal.z()) * normal - X * below);
  return X;
}

// The contact's normal is the direction of the boxes' least common depth.
TEST(BoxCollision, AContactOfACornerOrTwoEdgesHasHalfOfTheDepth) {
  const Model model = Model::FromMjcf(Pair(kLower, kUpper));
  const geometry::Box lower{Pose::Identity(), kLower};
  Data data(model);
  RandomStream random(23, "corners and edges");
  for (int i = 0; i < 50000; ++i) {
    const double depth = Magnitude(random, 1e-8, 1e-6);
    const Pose X = i % 2 == 0 ? CornerInFace(random, depth) : EdgeAcrossEdge(random, depth);
    Put(X, data);
    SCOPED_TRACE(testing::Message() << "pose " << i << " of seed 23, depth " << depth);
    const auto contacts = ContactsBetween(data, BodyId(0), model.Body("upper"));
    ASSERT_EQ(contacts.size(), 1);
    const Vector3 normal = contacts[0].normal;
    ASSERT_NEAR(Reach(lower, normal) + Reach({X, kUpper}, -normal), depth, 1e-3 * depth);
    ASSERT_NEAR(-2 * contacts[0].distance, depth, 1e-3 * depth + 1e-11);
  }
}

// Two pieces of one body are flush. The lowest corner of a box slides over their seam.
TEST(BoxCollision, APieceIsNotStoppedByTheEndOfAnother) {
  const Model model = Model::FromMjcf(R"(<mujoco><worldbody>
    <geom name="left" type="box" size="0.05 0.05 0.02" pos="-0.05 0 0"/>
    <geom name="right" type="box" size="0.05 0.05 0.02" pos="0.05 0 0"/>
    <body name="upper"><freejoint/><geom type="box" size="0.03 0.02 0.01" mass="1"/></body>
    </worldbody></mujoco>)");
  const Vector3 half_extents(0.03, 0.02, 0.01);
  Data data(model);
  RandomStream random(21, "a corner over a seam");
  for (int i = 0; i < 20000; ++i) {
    const double depth = Magnitude(random, 1e-9, 2e-6);
    Pose X = Pose(geometry::RotationZ(random.Uniform(-3, 3)) *
                  geometry::RotationX(random.Uniform(0.002, 0.03)) *
                  geometry::RotationY(random.Uniform(0.002, 0.03)));
    const auto corners = geometry::Box{X, half_extents}.Corners();
    const auto height = [](const Vector3& corner) { return corner.z(); };
    const Vector3 lowest = *std::ranges::min_element(corners, {}, height);
    const Vector3 at(random.Uniform(-3e-6, 3e-6), random.Uniform(-0.04, 0.04), 0.02 - depth);
    X.pretranslate(at - lowest);
    Put(X, data);
    SCOPED_TRACE(testing::Message() << "pose " << i << " of seed 21, depth " << depth);
    const auto contacts = ContactsBetween(data, BodyId(0), model.Body("upper"));
    ASSERT_FALSE(contacts.empty());
    for (const Contact& contact : contacts) ASSERT_GT(std::abs(contact.normal.z()), 0.9);
  }
}

}  // namespace
}  // namespace assay::mujoco::box_collision_test
