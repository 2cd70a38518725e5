#include "planner/finemotion/contacts/parallel_edges.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>
#include <vector>

#include "bench/workloads/pegs.h"
#include "planner/finemotion/contacts/contact_finder.h"
#include "planner/finemotion/motions/segment.h"
#include "planner/geometry/pose.h"
#include "tests/oracle/random_pose.h"

namespace assay::finemotion::parallel_edges_test {
namespace {

constexpr std::uint64_t kSeed = 73;
constexpr double kDegree = std::numbers::pi / 180;
constexpr double kTurn = 0.03;  // radians, edges at smaller angles make no contact
constexpr double kReach = 0.012;
constexpr double kVelocityError = 0.002;
constexpr double kRadius = 0.02;

PoseChange Change(const Vector3& d, const Vector3& w) {
  PoseChange z;
  z << d, w;
  return z;
}

double Factor(RandomStream& random) { return std::clamp(random.Uniform(-3, 3), -1.0, 1.0); }

// Two boxes at the end of a motion. Edges of them are nearly parallel and near each other.
struct Case {
  Polyhedron moving;
  Polyhedron stationary;
  Pose X_end = Pose::Identity();
  BelievedPose believed;
  Command command;
  std::vector<ModelTolerance> tolerances = {};

  std::vector<ParallelEdges> Edges() const {
    return ContactFinder(moving, stationary, tolerances)
        .NearlyParallel(X_end, {.reach = kReach, .turn = kTurn});
  }

  // Checks the motion with these edges only.
  SegmentCheck Checked(double scale = 1) const {
    const std::vector<PrimitiveContact> none;
    const std::vector<ParallelEdges> edges = Edges();
    SegmentModel model{none, scale * kVelocityError, kRadius};
    model.parallel_edges = edges;
    BelievedPose enlarged = believed;
    enlarged.errors *= scale;
    enlarged.tolerances *= scale;
    return Check(model, enlarged, command, Telling::kAll);
  }
};

std::set<ContactKey> UnwantedIn(const SegmentCheck& check) {
  std::set<ContactKey> keys;
  for (const Unwanted& unwanted : check.unwanted) keys.insert(unwanted.contact);
  return keys;
}

Polyhedron RandomBox(RandomStream& random) {
  const auto size = [&] { return random.Uniform(0.01, 0.04); };
  const double x = size();
  const double y = size();
  return workloads::BoxShape({-x, -y, 0}, {x, y, size()});
}

PoseChanges RandomErrors(RandomStream& random) {
  const double size = std::pow(10, random.Uniform(-1.5, 0));
  PoseChanges errors = PoseChanges::Zero(kPoseDimensions, kPoseDimensions);
  for (int i = 0; i < kPoseDimensions; ++i) {
    errors(i, i) = size * random.Uniform(0, 1.2) * (i < 3 ? 1e-3 : 0.5 * kDegree);
  }
  return errors;
}

// Returns the outward direction between the faces of the edge.
Vector3 Outward(const Polyhedron& shape, const OuterEdge& edge) {
  return shape.faces[static_cast<std::size_t>(edge.faces[0])].normal +
         shape.faces[static_cast<std::size_t>(edge.faces[1])].normal;
}

Case RandomCase(RandomStream& random) {
  Case made{
      .moving = RandomBox(random), .stationary = RandomBox(random), .believed = {}, .command = {}};
  const auto edge_of = [&](const Polyhedron& shape) {
    return shape.edges[static_cast<std::size_t>(random.Index(12))];
  };
  OuterEdge a;
  OuterEdge b;
  Eigen::Matrix3d R;
  do {  // until the edges are parallel and face each other
    R = oracle::RandomQuarterTurns(random);
    a = edge_of(made.moving);
    b = edge_of(made.stationary);
  } while (std::abs((R * a.direction()).dot(b.direction())) < 0.9 ||
           (R * Outward(made.moving, a)).dot(Outward(made.stationary, b)) > -0.5);
  const Vector3 w = oracle::RandomVector(random, 0.012);
  made.X_end.linear() = Displaced(Pose::Identity(), Change(Vector3::Zero(), w)).linear() * R;
  const auto point_of = [&](const OuterEdge& edge) -> Vector3 {
    return edge.start + random.Uniform() * (edge.end - edge.start);
  };
  made.X_end.pretranslate(oracle::RandomVector(random, 0.0015) - made.X_end * point_of(a) +
                          point_of(b));
  made.command.displacement = Change(oracle::RandomVector(random, 0.003),
                                     random.Index(2) * oracle::RandomVector(random, 0.01));
  made.believed = {Displaced(made.X_end, -made.command.displacement), RandomErrors(random)};
  return made;
}

void AddTolerances(Case& made, RandomStream& random) {
  using Of = ModelTolerance::Of;
  made.tolerances = {{"a", Of::kMovingFaces, {random.Index(6)}},
                     {"b", Of::kStationaryFaces, {random.Index(6)}},
                     {"c", Of::kMovingFaces, {0, 3}}};
  made.believed.tolerances.setConstant(3, random.Uniform(0, 0.5e-3));
  PoseChanges errors = PoseChanges::Zero(kPoseDimensions, 3 + made.believed.errors.cols());
  errors.rightCols(made.believed.errors.cols()) = made.believed.errors;
  made.believed.errors = errors;
}

// --- Sampled motions, in coordinates about the errorless end of the command.

struct SampledMotion {
  PoseChange start;
  PoseChange velocity;
  Eigen::VectorXd model_errors;
};

SampledMotion SampleMotion(const Case& given, double scale, RandomStream& random) {
  const PoseChange& displacement = given.command.displacement;
  const Eigen::Matrix3d turn = Displaced(Pose::Identity(), displacement).linear();
  Eigen::VectorXd factors(given.believed.errors.cols());
  for (double& factor : factors) factor = scale * Factor(random);
  PoseChange error = given.believed.errors * factors;
  error << turn * error.head<3>(), turn * error.tail<3>();
  const double angle = displacement.tail<3>().norm();
  const double way = displacement.head<3>().norm() + kRadius * angle;
  PoseChange velocity = displacement;
  for (int i = 0; i < kPoseDimensions; ++i) {
    velocity[i] += scale * kVelocityError * (i < 3 ? way : angle) * Factor(random);
  }
  const Eigen::VectorXd& widths = given.believed.tolerances;
  return {error - displacement, velocity, widths.cwiseProduct(factors.head(widths.size()))};
}

// The displacement of points by a motion: to first order, or rigidly.
enum class Motion { kLinear, kRigid };

struct Segment {
  Vector3 start;
  Vector3 end;
};

// Returns the edge in which the displaced planes of two faces of a box meet, in the axes of the
// box.
Segment EdgeOf(const Polyhedron& shape, int index, const std::vector<ModelTolerance>& tolerances,
               ModelTolerance::Of of, const Eigen::VectorXd& model_errors) {
  const OuterEdge& edge = shape.edges[static_cast<std::size_t>(index)];
  const auto displaced = [&](const Vector3& corner) {
    Vector3 p = corner;
    for (std::size_t k = 0; k < tolerances.size(); ++k) {
      if (tolerances[k].of != of) continue;
      for (const int i : tolerances[k].faces) {
        const OuterFace& face = shape.faces[static_cast<std::size_t>(i)];
        if (std::abs(face.normal.dot(corner) - face.height) > 1e-9) continue;
        p += model_errors[static_cast<Eigen::Index>(k)] * face.normal;
      }
    }
    return p;
  };
  return {displaced(edge.start), displaced(edge.end)};
}

Segment MovedEdge(const Case& given, int index, const SampledMotion& motion, double time,
                  Motion kind) {
  const Segment edge = EdgeOf(given.moving, index, given.tolerances,
                              ModelTolerance::Of::kMovingFaces, motion.model_errors);
  const PoseChange z = motion.start + time * motion.velocity;
  const auto moved = [&](const Vector3& p) -> Vector3 {
    if (kind == Motion::kRigid) return Displaced(given.X_end, z) * p;
    const Vector3 arm = given.X_end.linear() * p;
    return given.X_end * p + z.head<3>() + z.tail<3>().cross(arm);
  };
  return {moved(edge.start), moved(edge.end)};
}

// The position of segment a relative to b, seen along b: its side, and whether it passes between
// the ends of both.
struct Passing {
  double side = 0;
  bool within = false;
};

Passing PassingOf(const Segment& a, const Segment& b) {
  const Vector3 along = (b.end - b.start).normalized();
  const auto across = [&](const Vector3& p) -> Vector3 {
    return p - b.start - (p - b.start).dot(along) * along;
  };
  const Vector3 start = across(a.start);
  const Vector3 way = across(a.end) - start;
  const double fraction = -start.dot(way) / way.squaredNorm();
  const double at = (a.start + fraction * (a.end - a.start) - b.start).dot(along);
  return {start.cross(way).dot(along),
          fraction > 0 && fraction < 1 && at > 0 && at < (b.end - b.start).norm()};
}

// Returns whether the parts are on their own sides of the plane of both edges.
bool Press(const Case& given, const ParallelEdges& edges, const Segment& a, const Segment& b) {
  const auto all_leave = [](const Polyhedron& shape, int index, const Eigen::Matrix3d& R,
                            const Vector3& n) {
    const auto& [i, j] = shape.edges[static_cast<std::size_t>(index)].faces;
    const Vector3& first = shape.faces[static_cast<std::size_t>(i)].normal;
    const Vector3& second = shape.faces[static_cast<std::size_t>(j)].normal;
    const Vector3 into_first = R * (first.dot(second) * first - second);
    const Vector3 into_second = R * (first.dot(second) * second - first);
    return into_first.dot(n) >= 0 && into_second.dot(n) >= 0;
  };
  const Vector3 n = (a.end - a.start).cross(b.end - b.start);
  return std::ranges::any_of(std::array{n, Vector3(-n)}, [&](const Vector3& up) {
    return all_leave(given.moving, edges.moving, given.X_end.linear(), up) &&
           all_leave(given.stationary, edges.stationary, Eigen::Matrix3d::Identity(), -up);
  });
}

enum class Meeting { kNone, kPassing, kTouching };

Meeting MeetingOf(const Case& given, const ParallelEdges& edges, const SampledMotion& motion,
                  Motion kind) {
  constexpr int kSteps = 12;
  const Segment b = EdgeOf(given.stationary, edges.stationary, given.tolerances,
                           ModelTolerance::Of::kStationaryFaces, motion.model_errors);
  std::optional<Passing> before;
  for (int i = 0; i <= kSteps; ++i) {
    const Segment a = MovedEdge(given, edges.moving, motion, static_cast<double>(i) / kSteps, kind);
    const Passing now = PassingOf(a, b);
    if (before && before->side * now.side < 0 && before->within && now.within) {
      return Press(given, edges, a, b) ? Meeting::kTouching : Meeting::kPassing;
    }
    before = now;
  }
  return Meeting::kNone;
}

struct Counted {
  int pairs = 0;
  int touching = 0;
  int passing = 0;  // including cases in which the edges do not press
  int told = 0;
};

Counted CompareWithSamples(Motion kind, bool with_tolerances, int cases) {
  constexpr int kSamples = 80;
  RandomStream random(kSeed, "near parallel");
  Counted counted;
  for (int i = 0; i < cases; ++i) {
    Case given = RandomCase(random);
    if (with_tolerances) AddTolerances(given, random);
    const std::vector<ParallelEdges> pairs = given.Edges();
    if (pairs.empty()) continue;
    Case checked = given;
    if (kind == Motion::kRigid) {  // adds what linear rows leave out
      PoseChanges& errors = checked.believed.errors;
      errors.conservativeResize(Eigen::NoChange, errors.cols() + 3);
      errors.rightCols(3).setZero();
      errors.topRightCorner(3, 3).diagonal().setConstant(6e-5);
    }
    for (const double scale : {1.0, 2.0}) {
      const std::set<ContactKey> told = UnwantedIn(checked.Checked(scale));
      for (const ParallelEdges& edges : pairs) {
        Meeting most = Meeting::kNone;
        for (int k = 0; k < kSamples && most != Meeting::kTouching; ++k) {
          most = std::max(most, MeetingOf(given, edges, SampleMotion(given, scale, random), kind));
        }
        EXPECT_TRUE(most != Meeting::kTouching || told.contains(KeyOf(edges)))
            << i << " " << Name(KeyOf(edges));
        ++counted.pairs;
        counted.touching += most == Meeting::kTouching ? 1 : 0;
        counted.passing += most != Meeting::kNone ? 1 : 0;
        counted.told += told.contains(KeyOf(edges)) ? 1 : 0;
      }
    }
  }
  return counted;
}

TEST(ParallelEdges, WhatTouchesInSampledMotionsIsToldOf) {
  const Counted counted = CompareWithSamples(Motion::kLinear, false, 250);
  EXPECT_GT(counted.touching, 30);
  EXPECT_LT(counted.told, counted.pairs);
  EXPECT_LT(counted.told, 2 * counted.passing);  // samples do not find all meetings
}

TEST(ParallelEdges, WhatTouchesWhereItIsTurnedExactlyIsToldOf) {
  const Counted counted = CompareWithSamples(Motion::kRigid, false, 150);
  EXPECT_GT(counted.touching, 15);
}

TEST(ParallelEdges, WhatPartsThatAreWrongTouchIsToldOf) {
  const Counted counted = CompareWithSamples(Motion::kLinear, true, 150);
  EXPECT_GT(counted.touching, 20);
  EXPECT_LT(counted.told, 3 * counted.passing);
}

TEST(ParallelEdges, WithFewerErrorsThereIsNoMoreToTell) {
  RandomStream random(kSeed, "less");
  for (int i = 0; i < 100; ++i) {
    const Case given = RandomCase(random);
    const std::set<ContactKey> told = UnwantedIn(given.Checked());
    Case less = given;
    less.believed.errors *= random.Uniform();
    for (const ContactKey& key : UnwantedIn(less.Checked())) EXPECT_TRUE(told.contains(key));
  }
}

// --- A peg over a hole with 0.25 mm of play on each side. The rim of the hole at +x is edge 0.

constexpr double kHalf = 0.01905;
constexpr double kPlay = 0.25e-3;

Case PegIn(const Pose& X_end, const Vector3& way) {
  Case made{.moving = workloads::BoxShape({-kHalf, -kHalf, 0}, {kHalf, kHalf, 0.07}),
            .stationary = workloads::SquareHoleShape(kHalf + kPlay, 0.038, 0.07),
            .X_end = X_end,
            .believed = {},
            .command = {}};
  made.command.displacement = Change(way, Vector3::Zero());
  made.believed.X_StationaryMoving = Displaced(X_end, -made.command.displacement);
  made.believed.errors.setZero(kPoseDimensions, kPoseDimensions);
  return made;
}

Pose At(const Vector3& p, const Vector3& w) {
  return Displaced(geometry::Translation(p), Change(Vector3::Zero(), w));
}

SegmentCheck WithContacts(const Case& given, const std::vector<ParallelEdges>& edges) {
  const auto contacts =
      PrimitiveContacts(given.moving, given.stationary, given.X_end, kReach, {}, kTurn);
  SegmentModel model{contacts, kVelocityError, kRadius};
  model.parallel_edges = edges;
  return Check(model, given.believed, given.command, Telling::kAll);
}

TEST(ParallelEdges, ThoseOfAPegInTheMiddleOfItsHoleDoNotTouch) {
  const double room = 0.6 * kPlay;
  for (const double depth : {-0.001, 0.0, 0.003}) {
    Case given = PegIn(At({0, 0, -depth}, Vector3::Zero()), {0, 0, -0.004});
    given.believed.errors.diagonal() << room / 2, room / 2, 2e-3, 1e-4, 1e-4, 0.4 * room / kHalf;
    EXPECT_TRUE(given.Checked().unwanted.empty());
    EXPECT_GE(given.Edges().size(), 4U);
    given.believed.errors.diagonal() << 1.1 * kPlay, 0, 2e-3, 0, 0, 0;
    EXPECT_FALSE(given.Checked().certain);
  }
}

// The peg is yawed so that its edge crosses the rim. One end of the edge is over the top, and the
// other, lower end is over the hole. The peg comes down on the crossing, while its corners stay
// clear of all faces.
TEST(ParallelEdges, ACrossingThatTouchesBeforeAnyCornerIsToldOf) {
  Pose X = At({kPlay, 0, 0}, {-0.4 * kDegree, 0, 0.5 * kDegree});
  const Vector3 over_top = X * Vector3(kHalf, -kHalf, 0);
  const Vector3 over_hole = X * Vector3(kHalf, kHalf, 0);
  ASSERT_GT(over_top.x(), kHalf + kPlay);
  ASSERT_LT(over_hole.x(), kHalf + kPlay);
  ASSERT_LT(over_hole.z(), over_top.z());
  X.pretranslate(Vector3(0, 0, 0.05e-3 - over_top.z()));
  const Case given = PegIn(X, {0, 0, -0.003});
  EXPECT_TRUE(WithContacts(given, {}).certain);
  const auto told = UnwantedIn(WithContacts(given, given.Edges()));
  EXPECT_TRUE(std::ranges::any_of(told, [](const ContactKey& key) {
    return key.kind == ContactKind::kEdgeEdge && key.stationary == 0;
  }));
}

// A corner that lands on the top inside the rim, or slides there, does not bring its edges to the
// rim.
TEST(ParallelEdges, AWantedCornerIsNoTouchOfItsEdges) {
  for (const double inside : {0.3e-3, 3e-3}) {
    const Vector3 w(0.015, -0.01, 0);  // the corner (+x, -y) is the lowest
    Pose X = At(Vector3::Zero(), w);
    int lowest = 0;
    for (int i = 1; i < 4; ++i) {
      const auto z = [&](int k) {
        return (X.linear() * PegIn(X, w).moving.vertices[static_cast<std::size_t>(k)].p).z();
      };
      if (z(i) < z(lowest)) lowest = i;
    }
    const Case shape = PegIn(X, w);
    const Vector3 corner = X * shape.moving.vertices[static_cast<std::size_t>(lowest)].p;
    // The corner is beside the rim at +x or -x on the outer side, so that the peg is over the hole.
    const double side = corner.x() > 0 ? 1 : -1;
    X.pretranslate(Vector3(side * (kHalf + kPlay + inside) - corner.x(), 0, -corner.z()));
    const ContactKey key{ContactKind::kVertexFace, lowest, 0};

    Case coming = PegIn(X, {0, 0, -0.004});
    coming.command.until = key;
    coming.believed.errors.diagonal() << 1e-3, 1e-3, 1e-3, 0, 0, 0;
    Case sliding = PegIn(X, {0, 0.004, 0});
    sliding.believed.kept = {key};
    sliding.command.kept = {key};
    sliding.believed.errors.diagonal() << 1e-3, 1e-3, 0, 1e-3, 1e-3, 1e-3;
    for (const Case* given : {&coming, &sliding}) {
      EXPECT_FALSE(given->Edges().empty());
      const auto told = UnwantedIn(WithContacts(*given, given->Edges()));
      const bool touches = std::ranges::any_of(told, [](const ContactKey& k) {
        return k.kind == ContactKind::kEdgeEdge && (k.stationary == 0 || k.stationary == 2);
      });
      // At 0.3 mm inside, with errors of 1 mm, the corner may come down on the rim itself.
      EXPECT_EQ(touches, inside < 1e-3) << inside;
    }
  }
}

}  // namespace
}  // namespace assay::finemotion::parallel_edges_test
