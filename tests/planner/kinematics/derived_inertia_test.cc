#include "planner/kinematics/derived_inertia.h"

#include <gtest/gtest.h>

#include <numbers>

#include "planner/geometry/box.h"
#include "planner/geometry/hull.h"
#include "planner/geometry/pose.h"

namespace assay::kinematics::derived_inertia_test {
namespace {

constexpr double kPi = std::numbers::pi;

Link With(const Shape& shape, const Pose& X_LinkShape = Pose::Identity()) {
  Link link{.name = "link"};
  link.collisions.push_back({.name = "", .X_LinkShape = X_LinkShape, .shape = shape});
  return link;
}

// Returns the inertia of the link about its centre of mass, in the link's axes.
Matrix3 InertiaInLink(const Inertial& inertial) {
  const Matrix3 R = inertial.X_LinkCenter.linear();
  return R * inertial.inertia * R.transpose();
}

TEST(DerivedInertia, OfABoxIsThatOfItsHull) {
  const Pose X = geometry::Translation(0.1, 0.2, 0.3) * geometry::RotationX(0.7);
  const Vector3 size(0.1, 0.2, 0.4);
  const auto box = DerivedInertial(With(BoxShape{size}, X));
  const auto hull = std::make_shared<const geometry::ConvexHull>(
      geometry::HullOf(geometry::Box{Pose::Identity(), size / 2}));
  const auto same = DerivedInertial(With(HullShape{hull}, X));
  ASSERT_TRUE(box && same);
  EXPECT_NEAR(box->mass, 8, 1e-9);
  EXPECT_NEAR(same->mass, 8, 1e-9);
  EXPECT_LT((InertiaInLink(*box) - InertiaInLink(*same)).norm(), 1e-9);
  EXPECT_LT((box->X_LinkCenter.translation() - Vector3(0.1, 0.2, 0.3)).norm(), 1e-12);
  EXPECT_LT((same->X_LinkCenter.translation() - Vector3(0.1, 0.2, 0.3)).norm(), 1e-9);
}

TEST(DerivedInertia, OfRoundShapesIsAsInTables) {
  const auto sphere = DerivedInertial(With(SphereShape{0.1}));
  EXPECT_NEAR(sphere->mass, 4000 * kPi / 3 * 1e-3, 1e-9);
  EXPECT_NEAR(sphere->inertia(1, 1), 0.4 * sphere->mass * 0.01, 1e-12);
  const auto rod = DerivedInertial(With(CylinderShape{0.01, 1}));
  EXPECT_NEAR(rod->mass, 1000 * kPi * 1e-4, 1e-12);
  EXPECT_NEAR(rod->inertia(0, 0), rod->mass / 12, 1e-5);
  EXPECT_NEAR(rod->inertia(2, 2), rod->mass * 1e-4 / 2, 1e-12);
}

// Two halves of a box are the whole box.
TEST(DerivedInertia, OfSeveralShapesIsThatOfAll) {
  Link halves = With(BoxShape{{0.1, 0.2, 0.2}}, geometry::Translation(0, 0, -0.1));
  halves.collisions.push_back({.name = "",
                               .X_LinkShape = geometry::Translation(0, 0, 0.1),
                               .shape = BoxShape{{0.1, 0.2, 0.2}}});
  const auto both = DerivedInertial(halves);
  const auto whole = DerivedInertial(With(BoxShape{{0.1, 0.2, 0.4}}));
  EXPECT_NEAR(both->mass, whole->mass, 1e-12);
  EXPECT_LT((InertiaInLink(*both) - InertiaInLink(*whole)).norm(), 1e-12);
  EXPECT_FALSE(DerivedInertial(Link{.name = "frame"}));
}

}  // namespace
}  // namespace assay::kinematics::derived_inertia_test
