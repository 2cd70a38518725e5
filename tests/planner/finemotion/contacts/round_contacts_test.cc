#include "planner/finemotion/contacts/round_contacts.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "bench/workloads/pegs.h"
#include "planner/base/random.h"
#include "planner/finemotion/contacts/contact_finder.h"
#include "planner/finemotion/contacts/rim_crossing.h"
#include "planner/finemotion/motions/believed_pose.h"
#include "planner/geometry/polygon.h"

namespace assay::finemotion::round_contacts_test {
namespace {

constexpr int kSides = 64;
constexpr double kRadius = 0.008;
constexpr double kPlay = 0.25e-3;
constexpr double kLength = 0.05;

// A round peg over the mouth of a round hole, as polygons that the cylinders stand for.
Passage RoundPegInHole() {
  Passage passage =
      workloads::PegInHole({.sides = kSides, .half = kRadius, .length = kLength}, kPlay);
  const Vector3 up = Vector3::UnitZ();
  AddRoundShaft({Vector3::Zero(), -up, kRadius, 0}, kRadius, passage.moving);
  AddRoundHole({Vector3::Zero(), up, kRadius + kPlay, 0}, kRadius + kPlay, passage.stationary);
  return passage;
}

Pose PegAt(const Vector3& tip, const Vector3& turn) {
  PoseChange z;
  z << tip, turn;
  return Displaced(Pose::Identity(), z);
}

Vector3 Drawn(RandomStream& random, double most) {
  return {random.Uniform(-most, most), random.Uniform(-most, most), random.Uniform(-most, most)};
}

// Sides, edges and corners of the polygons take no part in contacts, and nothing else is marked.
TEST(RoundFeatures, AreThoseOfThePolygons) {
  const Passage passage = RoundPegInHole();
  const auto round = [](const auto& features) {
    return std::ranges::count_if(features, [](const auto& f) { return f.is_round; });
  };
  EXPECT_EQ(round(passage.moving.faces), kSides);
  EXPECT_EQ(round(passage.moving.edges), 3 * kSides);
  EXPECT_EQ(round(passage.moving.vertices), 2 * kSides);
  EXPECT_EQ(round(passage.stationary.faces), kSides);
  EXPECT_EQ(round(passage.stationary.edges), 2 * kSides);
  EXPECT_EQ(round(passage.stationary.vertices), 0);
  EXPECT_NEAR(passage.moving.shafts[0].length, kLength, 1e-9);
  EXPECT_NEAR(passage.stationary.holes[0].depth, kLength, 1e-9);
}

// The naive oracle: the lowest of many points of the rim.
TEST(RoundContacts, TheRimTouchesAFaceAtItsLowestPoint) {
  const Passage passage = RoundPegInHole();
  const RoundContacts contacts(passage.moving, passage.stationary);
  RandomStream random(1, "rims");
  int compared = 0;
  for (int i = 0; i < 200; ++i) {
    const Pose X = PegAt(Drawn(random, 0.003), Drawn(random, 0.2));
    for (const ContactKey& key : contacts.keys()) {
      if (key.kind != ContactKind::kRimFace || key.moving != 0) continue;
      const auto contact = contacts.At(key, X, 0);
      if (!contact) continue;
      const OuterFace& face = passage.stationary.faces[static_cast<std::size_t>(key.stationary)];
      double lowest = 1;
      for (int k = 0; k < 3600; ++k) {
        const double angle = k * std::numbers::pi / 1800;
        const Vector3 p = X * Vector3(kRadius * std::cos(angle), kRadius * std::sin(angle), 0);
        lowest = std::min(lowest, face.normal.dot(p) - face.height);
      }
      EXPECT_NEAR(contact->gap, lowest, 1e-8);
      ++compared;
    }
  }
  EXPECT_GT(compared, 100);
}

// The gap along each direction is that of the outermost of many points of the shaft below the mouth
// (rim) and in the plane of the mouth (side).
TEST(RoundContacts, WallsAreSeenFromTheirDirections) {
  const Passage passage = RoundPegInHole();
  const RoundContacts contacts(passage.moving, passage.stationary);
  RandomStream random(2, "walls");
  for (int i = 0; i < 50; ++i) {
    const Pose X = PegAt(Vector3(0, 0, -0.02) + Drawn(random, 0.0002), Drawn(random, 0.02));
    for (const ContactKey& key : contacts.keys()) {
      const bool is_side = key.kind == ContactKind::kSideRim;
      if (!is_side && key.kind != ContactKind::kRimWall) continue;
      const auto contact = contacts.At(key, X, 1);
      ASSERT_TRUE(contact);
      Vector3 u = -contact->normal;
      u.z() = 0;
      u.normalize();
      double farthest = -1;
      for (int k = 0; k < 3600; ++k) {
        const double angle = k * std::numbers::pi / 1800;
        const Vector3 around(kRadius * std::cos(angle), kRadius * std::sin(angle), 0);
        Vector3 p = X * around;
        const Vector3 along = X.linear().col(2);
        if (is_side) p -= p.z() / along.z() * along;
        farthest = std::max(farthest, u.dot(p));
      }
      EXPECT_NEAR(contact->gap, kRadius + kPlay - farthest, 1e-6);
    }
  }
}

// At a crossing, the line between the two points is perpendicular to both rims, and both points are
// on their rims.
TEST(RimCrossing, IsWhereTheRimsComeNearest) {
  RandomStream random(3, "crossings");
  int found = 0;
  for (int i = 0; i < 300; ++i) {
    const Pose X = PegAt(Drawn(random, 0.003), Drawn(random, 0.2));
    const Rim tip = {X.translation(), -X.linear().col(2), kRadius};
    const Rim mouth = {Vector3::Zero(), Vector3::UnitZ(), kRadius + kPlay};
    for (const int sense : {1, -1}) {
      const auto crossing = CrossingOf(tip, mouth, sense);
      if (!crossing) continue;
      ++found;
      const Vector3 between = crossing->on_first - crossing->on_second;
      const Vector3 a = crossing->on_first - tip.center;
      const Vector3 b = crossing->on_second - mouth.center;
      EXPECT_NEAR(a.norm(), tip.radius, 1e-12);
      EXPECT_NEAR(b.norm(), mouth.radius, 1e-12);
      EXPECT_NEAR(a.dot(tip.axis), 0, 1e-12);
      EXPECT_NEAR(between.dot(tip.axis.cross(a)), 0, 1e-10);
      EXPECT_NEAR(between.dot(mouth.axis.cross(b)), 0, 1e-10);
      EXPECT_GT(crossing->normal.z(), 0);
    }
  }
  EXPECT_GT(found, 100);
}

// A turn about the shaft's axis changes no contact, and a turn of everything about the hole's axis
// by one direction renames the walls.
TEST(RoundContacts, DoNotDependOnTheTurnAboutTheShaft) {
  const Passage passage = RoundPegInHole();
  const ContactFinder finder(passage.moving, passage.stationary);
  RandomStream random(4, "turns");
  for (int i = 0; i < 50; ++i) {
    const Pose X = PegAt(Drawn(random, 0.002), Drawn(random, 0.15));
    const Pose turned = X * Pose(Eigen::AngleAxisd(random.Uniform(-3, 3), Vector3::UnitZ()));
    const ContactRange range{.reach = 0.003, .turn = 0.01};
    const auto here = finder.Near(X, range);
    const auto there = finder.Near(turned, range);
    for (const PrimitiveContact& contact : here) {
      if (!IsRound(contact.kind)) continue;
      const PrimitiveContact* same = Find(there, KeyOf(contact));
      ASSERT_NE(same, nullptr) << Name(contact);
      EXPECT_NEAR(same->offset, contact.offset, 1e-9) << Name(contact);
      EXPECT_LT((same->normal - contact.normal).norm(), 1e-6) << Name(contact);
      EXPECT_NEAR(contact.row.segment<3>(3).dot(X.linear().col(2)), 0, 1e-9) << Name(contact);
    }
  }
}

// Linear rows say how the gap changes, to second order.
TEST(RoundContacts, RowsAreTheSlopesOfGaps) {
  const Passage passage = RoundPegInHole();
  const RoundContacts contacts(passage.moving, passage.stationary);
  RandomStream random(5, "rows");
  int compared = 0;
  for (int i = 0; i < 100; ++i) {
    const Pose X = PegAt(Drawn(random, 0.001), Drawn(random, 0.15));
    for (const ContactKey& key : contacts.keys()) {
      const auto linear = contacts.Linearized(key, X, {.reach = 0.001, .turn = 0.01}, 0);
      if (!linear || std::abs(linear->offset) > 1e-4) continue;
      PoseChange z;
      z << Drawn(random, 1e-6), Drawn(random, 1e-4);
      const auto moved = contacts.At(key, Displaced(X, z), 0.01);
      if (!moved) continue;
      EXPECT_NEAR(moved->gap, linear->Gap(Eigen::VectorXd(z)), 2e-8) << Name(key);
      ++compared;
    }
  }
  EXPECT_GT(compared, 20);
}

// What is said of one direction holds for all: the planes of the directions hold every pose in
// which an upright shaft is in its hole.
TEST(RoundContacts, PlanesOfDirectionsSurroundTheHole) {
  const Passage passage = RoundPegInHole();
  const RoundContacts contacts(passage.moving, passage.stationary);
  const auto least_gap = [&](double beside, double angle) {
    double least = 1;
    const Pose X =
        PegAt({beside * std::cos(angle), beside * std::sin(angle), -0.01}, Vector3::Zero());
    for (const ContactKey& key : contacts.keys()) {
      if (key.kind == ContactKind::kRimWall) least = std::min(least, contacts.At(key, X, 0)->gap);
    }
    return least;
  };
  const double more = 1 / std::cos(std::numbers::pi / kRoundDirections);
  for (double angle = 0; angle < 6.3; angle += 0.01) {
    EXPECT_GE(least_gap(kPlay, angle), -1e-12) << angle;
    EXPECT_LT(least_gap(1.001 * more * kPlay, angle), 0) << angle;
  }
}

// Strategies name these contacts.
TEST(RoundContacts, HaveNamesThatCanBeRead) {
  const Passage passage = RoundPegInHole();
  const RoundContacts contacts(passage.moving, passage.stationary);
  for (const ContactKey& key : contacts.keys()) {
    EXPECT_EQ(ContactNamed(Name(key)), key) << Name(key);
  }
}

}  // namespace
}  // namespace assay::finemotion::round_contacts_test
