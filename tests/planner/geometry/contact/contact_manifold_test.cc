#include "planner/geometry/contact/contact_manifold.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "planner/geometry/narrow_phase.h"
#include "planner/geometry/pose.h"
#include "tests/planner/geometry/contact/solids.h"

namespace assay::geometry::contact_manifold_test {
namespace {

using oracle::RandomPose;

constexpr double kPi = std::numbers::pi;

double Deepest(const ContactManifold& manifold) {
  double deepest = std::numeric_limits<double>::infinity();
  for (const auto& point : manifold.points) deepest = std::min(deepest, point.separation);
  return deepest;
}

// Returns how far the point of a manifold that is farthest from all points of another is from them.
double FarthestFrom(const ContactManifold& other, const ContactManifold& manifold) {
  double farthest = 0;
  for (const auto& point : manifold.points) {
    double nearest = 1e9;
    for (const auto& candidate : other.points) {
      const double apart =
          (candidate.at - point.at).norm() + std::abs(candidate.separation - point.separation);
      nearest = std::min(nearest, apart);
    }
    farthest = std::max(farthest, nearest);
  }
  return farthest;
}

void ExpectSame(const ContactManifold& a, const ContactManifold& b, double tolerance) {
  EXPECT_LT((a.normal - b.normal).norm(), tolerance);
  EXPECT_EQ(a.points.size(), b.points.size());
  EXPECT_LT(std::max(FarthestFrom(a, b), FarthestFrom(b, a)), tolerance);
}

struct Pair {
  ContactSolid a;
  ContactSolid b;
  Pose X_WorldA;
  Pose X_WorldB;

  std::optional<ContactManifold> Contact() const {
    return ContactBetween(a, X_WorldA, b, X_WorldB, 0);
  }
};

Pair RandomPair(RandomStream& random, int number) {
  return {RandomSolid(random, 4 + number % 30),
          number % 3 == 0 ? RegularPrism(3 + number % 20, 0.7, 0.4)
                          : RandomSolid(random, 4 + number % 17),
          RandomPose(random, 0.3), RandomPose(random, 1.2)};
}

// Moves the second solid along the normal of the pair's contact until the solids overlap along it
// by `depth`. Returns whether they are in contact.
bool MoveToDepth(double depth, Pair& pair) {
  for (int i = 0; i < 20; ++i) {
    const auto contact = pair.Contact();
    if (!contact) return false;
    const double gap = GapAlong(contact->normal, pair.a, pair.X_WorldA, pair.b, pair.X_WorldB);
    pair.X_WorldB.pretranslate(-(gap + depth) * contact->normal);
  }
  return true;
}

TEST(ContactManifold, ExistsWhereSolidsOverlap) {
  RandomStream random(321, "overlap");
  int contacts = 0;
  for (int i = 0; i < 2000; ++i) {
    const Pair pair = RandomPair(random, i);
    const auto in_gjk = NearestDifference(*MakeGjkHull(pair.a.hull), *MakeGjkHull(pair.b.hull),
                                          pair.X_WorldA.inverse() * pair.X_WorldB);
    const auto contact = pair.Contact();
    EXPECT_EQ(contact.has_value(), in_gjk.norm() < 1e-9) << i;
    if (!contact) continue;
    ++contacts;
    EXPECT_FALSE(contact->points.empty()) << i;
    EXPECT_LE(contact->points.size(), kMostContactPoints);
  }
  EXPECT_GT(contacts, 500);
}

// The normal is a direction of least overlap, by definition.
TEST(ContactManifold, HasTheNormalOfLeastOverlap) {
  RandomStream random(322, "normal");
  for (int i = 0; i < 300; ++i) {
    const Pair pair = RandomPair(random, i);
    const auto contact = pair.Contact();
    if (!contact) continue;
    EXPECT_NEAR(contact->normal.norm(), 1, 1e-12);
    const double gap = GapAlong(contact->normal, pair.a, pair.X_WorldA, pair.b, pair.X_WorldB);
    EXPECT_LE(GreatestGap(random, pair.a, pair.X_WorldA, pair.b, pair.X_WorldB), gap + 1.1e-6) << i;
    EXPECT_LE(gap, Deepest(*contact) + 1e-9) << i;
  }
}

// Where solids hardly overlap, every point is on both, and the deepest one has the whole overlap.
TEST(ContactManifold, HasPointsOnBothSurfaces) {
  RandomStream random(323, "surfaces");
  constexpr double kDepth = 5e-6;
  int contacts = 0;
  for (int i = 0; i < 600; ++i) {
    Pair pair = RandomPair(random, i);
    if (!MoveToDepth(kDepth, pair)) continue;
    const auto contact = pair.Contact();
    ASSERT_TRUE(contact) << i;
    ++contacts;
    EXPECT_NEAR(Deepest(*contact), -kDepth, 1.1e-6) << i;
    for (const auto& point : contact->points) {
      EXPECT_LE(point.separation, 0);
      EXPECT_NEAR(Outside(pair.a, pair.X_WorldA, point.at), 0, 2e-5) << i;
      EXPECT_NEAR(Outside(pair.b, pair.X_WorldB, point.at), 0, 2e-5) << i;
    }
  }
  EXPECT_GT(contacts, 200);
}

TEST(ContactManifold, IsTurnedRoundIfTheSolidsAreExchanged) {
  RandomStream random(324, "exchange");
  for (int i = 0; i < 600; ++i) {
    Pair pair = RandomPair(random, i);
    if (i % 2 == 0 && !MoveToDepth(1e-5, pair)) continue;
    const auto contact = pair.Contact();
    auto turned = ContactBetween(pair.b, pair.X_WorldB, pair.a, pair.X_WorldA, 0);
    ASSERT_EQ(contact.has_value(), turned.has_value());
    if (!contact) continue;
    turned->normal = -turned->normal;
    SCOPED_TRACE(testing::Message() << "pair " << i << " of seed 324");
    ExpectSame(*contact, *turned, 1e-9);
  }
}

TEST(ContactManifold, MovesWithTheSolids) {
  RandomStream random(325, "motion");
  for (int i = 0; i < 600; ++i) {
    Pair pair = RandomPair(random, i);
    if (i % 2 == 0 && !MoveToDepth(1e-5, pair)) continue;
    const Pose X = RandomPose(random, 2);
    auto contact = pair.Contact();
    const auto moved = ContactBetween(pair.a, X * pair.X_WorldA, pair.b, X * pair.X_WorldB, 0);
    ASSERT_EQ(contact.has_value(), moved.has_value());
    if (!contact) continue;
    contact->normal = X.linear() * contact->normal;
    for (auto& point : contact->points) point.at = X * point.at;
    SCOPED_TRACE(testing::Message() << "pair " << i << " of seed 325");
    ExpectSame(*contact, *moved, 1e-9);
  }
}

const ContactSolid kTable = BoxSolid(0.2, 0.2, 0.02);

Pose OnTable(const ContactSolid& solid, const Pose& turn, double depth) {
  double lowest = 1e9;
  for (const Vector3& p : solid.hull.vertices) lowest = std::min(lowest, (turn * p).z());
  return Translation(0, 0, 0.02 - depth - lowest) * turn;
}

ContactManifold ContactOnTable(const ContactSolid& solid, const Pose& turn, double depth) {
  const auto contact =
      ContactBetween(kTable, Pose::Identity(), solid, OnTable(solid, turn, depth), 0);
  EXPECT_TRUE(contact);
  return contact.value_or(ContactManifold{});
}

TEST(ContactManifold, OfABoxOnItsFaceHasItsCorners) {
  const ContactSolid box = BoxSolid(0.01, 0.02, 0.03);
  for (const double yaw : {0.0, 0.3, kPi / 4, 2.0}) {
    const ContactManifold contact = ContactOnTable(box, RotationZ(yaw), 1e-6);
    ASSERT_EQ(contact.points.size(), 4u);
    EXPECT_LT((contact.normal - Vector3::UnitZ()).norm(), 1e-12);
    for (const auto& point : contact.points) {
      const Vector3 corner = (RotationZ(-yaw) * point.at).cwiseAbs();
      EXPECT_NEAR(corner.x(), 0.01, 1e-9);
      EXPECT_NEAR(corner.y(), 0.02, 1e-9);
      EXPECT_NEAR(corner.z(), 0.02, 1e-6);
      EXPECT_NEAR(point.separation, -1e-6, 1e-12);
    }
  }
}

TEST(ContactManifold, OfABoxOnAnEdgeHasItsEnds) {
  const ContactManifold contact = ContactOnTable(BoxSolid(0.01, 0.02, 0.03), RotationY(0.7), 1e-6);
  ASSERT_EQ(contact.points.size(), 2u);
  for (const auto& point : contact.points) EXPECT_NEAR(std::abs(point.at.y()), 0.02, 1e-9);
}

TEST(ContactManifold, OfABoxOnACornerHasTheCorner) {
  const Pose turn(RotationX(0.5) * RotationY(0.7));
  const ContactManifold contact = ContactOnTable(BoxSolid(0.01, 0.02, 0.03), turn, 1e-6);
  ASSERT_EQ(contact.points.size(), 1u);
  EXPECT_NEAR(contact.points[0].separation, -1e-6, 1e-12);
}

// Two equal square faces, one of them turned by 45 degrees, have an octagon in common.
TEST(ContactManifold, OfTurnedFacesHasTheCornersOfTheirCommonArea) {
  const ContactSolid cube = BoxSolid(0.01, 0.01, 0.01);
  const auto contact = ContactBetween(cube, Pose::Identity(), cube,
                                      Translation(0, 0, 0.02 - 1e-6) * RotationZ(kPi / 4), 0);
  ASSERT_TRUE(contact);
  ASSERT_EQ(contact->points.size(), 8u);
  for (const auto& point : contact->points) {
    EXPECT_NEAR(point.at.head<2>().norm(), 0.01 / std::cos(kPi / 8), 1e-9);
  }
}

TEST(ContactManifold, OfCrossingEdgesIsOnePoint) {
  const ContactSolid bar = BoxSolid(0.1, 0.01, 0.01);
  const double reach = std::numbers::sqrt2 * 0.01;  // of an edge that points up or down
  const Pose on_edge = RotationX(kPi / 4);
  for (const double yaw : {0.3, kPi / 2, 2.5}) {
    const Pose X(Translation(0.02, -0.01, 2 * reach - 3e-6) * RotationZ(yaw) * on_edge);
    const auto contact = ContactBetween(bar, on_edge, bar, X, 0);
    ASSERT_TRUE(contact);
    ASSERT_EQ(contact->points.size(), 1u);
    EXPECT_LT((contact->normal - Vector3::UnitZ()).norm(), 1e-9);
    EXPECT_NEAR(contact->points[0].separation, -3e-6, 1e-9);
    EXPECT_NEAR(contact->points[0].at.y(), 0, 1e-9) << "on the lower edge";
    EXPECT_NEAR(contact->points[0].at.z(), reach - 1.5e-6, 1e-9);
  }
}

// The points that are kept of a round face bear its weight: no half of the face is without a point,
// and none is nearer to the middle than the rim.
TEST(ContactManifold, OfARoundFaceSurroundsItsMiddle) {
  const ContactSolid prism = RegularPrism(64, 0.008, 0.02);
  for (int i = 0; i < 40; ++i) {
    const ContactManifold contact = ContactOnTable(prism, RotationZ(0.01 * i), 1e-6);
    ASSERT_EQ(contact.points.size(), kMostContactPoints);
    std::vector<double> angles;
    for (const auto& point : contact.points) {
      EXPECT_NEAR(point.at.head<2>().norm(), 0.008, 1e-9);
      angles.push_back(std::atan2(point.at.y(), point.at.x()));
    }
    std::ranges::sort(angles);
    angles.push_back(angles.front() + 2 * kPi);
    for (std::size_t k = 1; k < angles.size(); ++k) EXPECT_LT(angles[k] - angles[k - 1], 1);
  }
}

// A solid at rest trembles by rounding. Its contact must not jump.
TEST(ContactManifold, HoldsStillWhereASolidTrembles) {
  RandomStream random(326, "trembling");
  const ContactSolid wall = BoxSolid(0.005, 0.01, 0.01);
  for (const int sides : {6, 16, 64}) {
    const ContactSolid prism = RegularPrism(sides, 0.008, 0.02);
    for (const Pose& turn : {Pose::Identity(), RotationX(kPi / 2), RotationZ(0.1)}) {
      const Pose X_WorldPrism = OnTable(prism, turn, 1e-7);
      for (const ContactSolid* other : {&kTable, &wall}) {
        const Pose X_WorldOther = other == &kTable ? Pose::Identity() : Translation(0, 0, 0.01);
        const auto still = ContactBetween(*other, X_WorldOther, prism, X_WorldPrism, 0);
        ASSERT_TRUE(still);
        for (int i = 0; i < 100; ++i) {
          const Pose tremble =
              Translation(oracle::RandomVector(random, 1e-10)) *
              Pose(Eigen::AngleAxisd(random.Uniform(-1e-9, 1e-9),
                                     oracle::RandomVector(random, 1).normalized()));
          const auto contact =
              ContactBetween(*other, X_WorldOther, prism, tremble * X_WorldPrism, 0);
          ASSERT_TRUE(contact);
          SCOPED_TRACE(testing::Message() << sides << " sides, tremor " << i << " of seed 326");
          ExpectSame(*still, *contact, 1e-7);
        }
      }
    }
  }
}

TEST(ContactManifold, ReachesAsFarAsTheMargin) {
  const ContactSolid prism = RegularPrism(16, 0.008, 0.02);
  const Pose X_WorldPrism = OnTable(prism, RotationZ(0.1), -1e-4);
  EXPECT_FALSE(ContactBetween(kTable, Pose::Identity(), prism, X_WorldPrism, 0));
  EXPECT_FALSE(ContactBetween(kTable, Pose::Identity(), prism, X_WorldPrism, 0.9e-4));
  const auto contact = ContactBetween(kTable, Pose::Identity(), prism, X_WorldPrism, 1.1e-4);
  ASSERT_TRUE(contact);
  EXPECT_NEAR(Deepest(*contact), 1e-4, 1e-12);
}

TEST(ContactManifold, OfAPlaneHasTheVerticesBelowIt) {
  const Plane plane{Vector3::UnitZ(), 0.02};
  RandomStream random(327, "plane");
  for (int i = 0; i < 100; ++i) {
    const ContactSolid solid = RandomSolid(random, 4 + i % 20);
    const Pose X = OnTable(solid, RandomPose(random, 0), 1e-3 * (i % 5) - 1e-3);
    const auto contact = ContactBetween(plane, solid, X, 0);
    const auto depths = std::ranges::count_if(
        solid.hull.vertices, [&](const Vector3& p) { return (X * p).z() <= 0.02; });
    ASSERT_EQ(contact.has_value(), depths > 0);
    if (!contact) continue;
    EXPECT_EQ(contact->points.size(), std::min<std::size_t>(depths, kMostContactPoints));
    EXPECT_NEAR(Deepest(*contact), -1e-3 * (i % 5) + 1e-3, 1e-12);
  }
}

}  // namespace
}  // namespace assay::geometry::contact_manifold_test
