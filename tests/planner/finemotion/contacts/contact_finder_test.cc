#include "planner/finemotion/contacts/contact_finder.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <vector>

#include "bench/workloads/pegs.h"
#include "planner/finemotion/motions/segment.h"
#include "tests/oracle/random_pose.h"

namespace assay::finemotion::contact_finder_test {
namespace {

using Contacts = std::vector<PrimitiveContact>;
using Keys = std::set<ContactKey>;

constexpr std::uint64_t kSeed = 75;
constexpr double kRounding = 1e-9;
constexpr double kUndecided = 1e-5;  // metres, distances nearer to a limit than this are undecided
constexpr double kEverywhere = std::numeric_limits<double>::infinity();

// A scene with a block, whose hole is made of four pieces, and a peg with a collar.
struct Scene {
  Polyhedron moving;
  Polyhedron stationary;
  std::vector<ModelTolerance> tolerances;
  Pose X = Pose::Identity();
  ContactFinder finder;
};

Scene RandomScene(RandomStream& random) {
  const workloads::PrismModel prism{.sides = 4, .half = 0.02, .length = 0.05};
  std::vector<ConvexPiece> peg = {
      workloads::PrismPiece({.sides = 4, .half = 0.0195, .length = 0.04}),
      workloads::BoxPiece({-0.03, -0.025, 0.03}, {0.03, 0.025, 0.05})};
  Scene scene{.moving = OutsideOf(peg),
              .stationary = OutsideOf(workloads::AroundHole(prism, 0.04)),
              .tolerances = {{"peg", ModelTolerance::Of::kMovingFaces, {0, 1}},
                             {"block", ModelTolerance::Of::kStationaryFaces, {2}}},
              .X = oracle::RandomPose(random, 0.05),
              .finder = {{}, {}}};
  if (random.Index(2) == 0) {  // near the hole, tilted a little
    const Vector3 axis = oracle::RandomVector(random, 1).normalized();
    scene.X.linear() = Eigen::AngleAxisd(random.Uniform(0, 0.2), axis).toRotationMatrix();
    scene.X.translation() = oracle::RandomVector(random, 0.01);
  }
  scene.finder = ContactFinder(scene.moving, scene.stationary, scene.tolerances);
  return scene;
}

template <class Items>
const auto& At(const Items& items, int index) {
  return items[static_cast<std::size_t>(index)];
}

Keys KeysOf(const Contacts& contacts) {
  Keys keys;
  for (const PrimitiveContact& contact : contacts) keys.insert(KeyOf(contact));
  return keys;
}

// --- Distances of features by definition.

double DistanceToSegment(const Vector3& p, const Vector3& a, const Vector3& b) {
  const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (p - a - t * (b - a)).norm();
}

double DistanceToFace(const Vector3& p, const OuterFace& face) {
  const double gap = face.normal.dot(p) - face.height;
  double distance = kEverywhere;
  for (const std::vector<Vector3>& outline : face.region) {
    bool inside = true;
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const Vector3& start = outline[i];
      const Vector3& end = outline[(i + 1) % outline.size()];
      inside &= face.normal.cross(end - start).dot(p - start) >= 0;
      distance = std::min(distance, DistanceToSegment(p, start, end));
    }
    if (inside) distance = std::min(distance, std::abs(gap));
  }
  return distance;
}

// Returns the distance of two segments. The distance to one segment is convex along the other.
double DistanceOfSegments(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d) {
  double low = 0;
  double high = 1;
  const auto at = [&](double s) { return DistanceToSegment(a + s * (b - a), c, d); };
  for (int i = 0; i < 100; ++i) {
    const double third = (high - low) / 3;
    (at(low + third) < at(high - third) ? high : low) +=
        at(low + third) < at(high - third) ? -third : third;
  }
  return at((low + high) / 2);
}

double DistanceOf(const Scene& scene, const ContactKey& key) {
  switch (key.kind) {
    case ContactKind::kRimFace:
    case ContactKind::kRimRim:
    case ContactKind::kSideRim:
    case ContactKind::kRimWall:
      break;  // no shape of these tests is round
    case ContactKind::kVertexFace:
      return DistanceToFace(scene.X * At(scene.moving.vertices, key.moving).p,
                            At(scene.stationary.faces, key.stationary));
    case ContactKind::kFaceVertex:
      return DistanceToFace(scene.X.inverse() * At(scene.stationary.vertices, key.stationary).p,
                            At(scene.moving.faces, key.moving));
    case ContactKind::kEdgeEdge: {
      const OuterEdge& a = At(scene.moving.edges, key.moving);
      const OuterEdge& b = At(scene.stationary.edges, key.stationary);
      return DistanceOfSegments(scene.X * a.start, scene.X * a.end, b.start, b.end);
    }
  }
  return 0;
}

double SineOf(const Scene& scene, int moving, int stationary) {
  const Vector3 a = scene.X.linear() * At(scene.moving.edges, moving).direction();
  return a.cross(At(scene.stationary.edges, stationary).direction()).norm();
}

// --- Laws.

TEST(ContactFinder, NearAreThoseOfAllThatAreNotFartherThanTheReach) {
  RandomStream random(kSeed, "reach");
  int found = 0;
  for (int trial = 0; trial < 100; ++trial) {
    SCOPED_TRACE(trial);
    const Scene scene = RandomScene(random);
    const double reach = random.Uniform(0.001, 0.03);
    const double turn = random.Uniform(0, 0.05);
    const Keys all = KeysOf(scene.finder.Near(scene.X, {.reach = kEverywhere, .turn = turn}));
    const Keys near = KeysOf(scene.finder.Near(scene.X, {.reach = reach, .turn = turn}));
    for (const ContactKey& key : near) EXPECT_TRUE(all.contains(key)) << Name(key);
    for (const ContactKey& key : all) {
      const double distance = DistanceOf(scene, key);
      if (std::abs(distance - reach) < kUndecided) continue;
      EXPECT_EQ(near.contains(key), distance < reach) << Name(key) << " " << distance - reach;
    }
    found += static_cast<int>(near.size());
  }
  EXPECT_GT(found, 500);
}

void ExpectSame(const PrimitiveContact& a, const PrimitiveContact& b) {
  EXPECT_EQ(KeyOf(a), KeyOf(b));
  EXPECT_EQ(a.row, b.row);
  EXPECT_EQ(a.offset, b.offset);
  ASSERT_EQ(a.limits.size(), b.limits.size());
  for (std::size_t i = 0; i < a.limits.size(); ++i) {
    EXPECT_EQ(a.limits[i].a, b.limits[i].a);
    EXPECT_EQ(a.limits[i].b, b.limits[i].b);
  }
}

TEST(ContactFinder, ThoseOfKeysAreASelectionOfAll) {
  RandomStream random(kSeed, "keys");
  for (int trial = 0; trial < 50; ++trial) {
    const Scene scene = RandomScene(random);
    const double turn = random.Uniform(0, 0.05);
    Contacts expected = scene.finder.Near(scene.X, {.reach = kEverywhere, .turn = turn});
    Keys keys = KeysOf(expected);
    std::erase_if(keys, [&](const ContactKey&) { return random.Index(3) != 0; });
    std::erase_if(expected, [&](const auto& contact) { return !keys.contains(KeyOf(contact)); });
    const std::vector<ContactKey> asked(keys.begin(), keys.end());
    Contacts contacts = scene.finder.Of(asked, scene.X, turn);
    std::ranges::stable_sort(expected, {}, [](const auto& contact) { return KeyOf(contact); });
    ASSERT_EQ(contacts.size(), expected.size());
    for (std::size_t i = 0; i < contacts.size(); ++i) ExpectSame(contacts[i], expected[i]);
  }
}

TEST(ContactFinder, APartThatIsPutThereBeforehandMakesTheSameContacts) {
  RandomStream random(kSeed, "put");
  for (int trial = 0; trial < 50; ++trial) {
    const Scene scene = RandomScene(random);
    const ContactRange range = {.reach = 0.02, .turn = random.Uniform(0, 0.05)};
    const Contacts contacts = scene.finder.Near(scene.X, range);
    const Contacts put =
        PrimitiveContacts(Transformed(scene.moving, scene.X), scene.stationary, Pose::Identity(),
                          range.reach, scene.tolerances, range.turn);
    ASSERT_EQ(KeysOf(contacts), KeysOf(put)) << trial;
    for (const PrimitiveContact& contact : contacts) {
      const PrimitiveContact* other = Find(put, KeyOf(contact));
      EXPECT_NEAR(contact.offset, other->offset, kRounding);
      EXPECT_LT((contact.normal - other->normal).norm(), kRounding);
      EXPECT_LT((contact.row.tail<2>() - other->row.tail<2>()).norm(), kRounding);
      // A point of a face is only fixed up to its region.
      if (contact.kind == ContactKind::kEdgeEdge) {
        EXPECT_LT((contact.at + scene.X.translation() - other->at).norm(), 1e-7);
      }
    }
  }
}

TEST(ContactFinder, EdgesAreContactsOrNearlyParallel) {
  RandomStream random(kSeed, "parallel");
  int found = 0;
  for (int trial = 0; trial < 100; ++trial) {
    SCOPED_TRACE(trial);
    const Scene scene = RandomScene(random);
    const ContactRange range = {.reach = random.Uniform(0.001, 0.02), .turn = 0.05};
    const Keys contacts = KeysOf(scene.finder.Near(scene.X, range));
    for (const ParallelEdges& edges : scene.finder.NearlyParallel(scene.X, range)) {
      const ContactKey key = KeyOf(edges);
      EXPECT_FALSE(contacts.contains(key));
      EXPECT_LT(SineOf(scene, key.moving, key.stationary), range.turn + 1e-5);
      EXPECT_LT(DistanceOf(scene, key), range.reach + kUndecided);
      ++found;
    }
  }
  EXPECT_GT(found, 50);
}

// No edges are left out that can press on each other when the part is turned a little.
TEST(ContactFinder, NoNearlyParallelEdgesThatPressAreLeftOut) {
  RandomStream random(kSeed, "left out");
  int found = 0;
  for (int trial = 0; trial < 100; ++trial) {
    const Scene scene = RandomScene(random);
    const ContactRange range = {.reach = 0.015, .turn = 0.05};
    Keys keys;
    for (const ParallelEdges& edges : scene.finder.NearlyParallel(scene.X, range)) {
      keys.insert(KeyOf(edges));
    }
    // Looks for contacts at a slightly turned pose whose edges are parallel at the unturned one.
    const Vector3 w = oracle::RandomVector(random, 0.02);
    Pose turned = scene.X;
    turned.linear() = Eigen::AngleAxisd(w.norm(), w.normalized()) * scene.X.linear();
    for (const PrimitiveContact& contact : scene.finder.Near(turned, {.reach = 0.012, .turn = 0})) {
      const ContactKey key = KeyOf(contact);
      if (key.kind != ContactKind::kEdgeEdge) continue;
      if (SineOf(scene, key.moving, key.stationary) > range.turn) continue;
      EXPECT_TRUE(keys.contains(key)) << trial << " " << Name(key);
      ++found;
    }
  }
  EXPECT_GT(found, 20);
}

// The place of the point is measured from the start of the line of the edge, in axes whose last one
// is along the edge.
TEST(ContactFinder, PointsAtEdgesAreRightToFirstOrder) {
  constexpr double kSize = 1e-6;
  RandomStream random(kSeed, "points");
  for (int trial = 0; trial < 60; ++trial) {
    const Scene scene = RandomScene(random);
    PoseChange z;
    z << oracle::RandomVector(random, kSize), oracle::RandomVector(random, kSize);
    const Pose X = Displaced(scene.X, z);
    for (const ParallelEdges& edges :
         scene.finder.NearlyParallel(scene.X, {.reach = 0.02, .turn = 0.05})) {
      const OuterEdge& a = At(scene.moving.edges, edges.moving);
      const OuterEdge& b = At(scene.stationary.edges, edges.stationary);
      const auto expect_at = [&](const PointAtEdge& point, const Vector3& p, const OuterEdge& bar) {
        const Vector3 seen = point.offset + point.pose * z;
        const Vector3 from_start = p - bar.start;
        EXPECT_NEAR(seen.z(), from_start.dot(bar.direction()), 1e-10);
        EXPECT_NEAR(seen.norm(), from_start.norm(), 1e-10);
      };
      expect_at(edges.along_stationary.ends[0], X * a.start, b);
      expect_at(edges.along_stationary.ends[1], X * a.end, b);
      expect_at(edges.along_moving.ends[0], X.inverse() * b.start, a);
      expect_at(edges.along_moving.ends[1], X.inverse() * b.end, a);
      EXPECT_NEAR(edges.contact.normal.norm(), 1, kRounding);
    }
  }
}

}  // namespace
}  // namespace assay::finemotion::contact_finder_test
