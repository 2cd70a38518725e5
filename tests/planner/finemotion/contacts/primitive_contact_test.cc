#include "planner/finemotion/contacts/primitive_contact.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "bench/workloads/pegs.h"
#include "planner/finemotion/contacts/contact_finder.h"
#include "planner/geometry/polygon.h"
#include "planner/geometry/pose.h"
#include "tests/oracle/random_pose.h"

namespace assay::finemotion::primitive_contact_test {
namespace {

using oracle::RandomPose;
using oracle::RandomVector;
using workloads::BoxShape;
using workloads::CubeShape;
using workloads::FromOutlines;
using workloads::SquareHoleShape;

constexpr std::uint64_t kSeed = 57;
constexpr double kTouch = 1e-6;
constexpr std::array kKinds = {ContactKind::kVertexFace, ContactKind::kFaceVertex,
                               ContactKind::kEdgeEdge};

struct Scene {
  Polyhedron moving;
  Polyhedron stationary;
  Pose X = Pose::Identity();  // pose of the moving part
};

template <class Container>
auto& At(Container& items, int index) {
  return items[static_cast<std::size_t>(index)];
}

std::map<ContactKind, int> CountKinds(const std::vector<PrimitiveContact>& contacts) {
  std::map<ContactKind, int> count;
  for (const PrimitiveContact& contact : contacts) ++count[contact.kind];
  return count;
}

// --- Random geometry of size about 1.

Polyhedron RandomTetrahedron(RandomStream& random) {
  while (true) {
    std::vector<Vector3> corners;
    for (int i = 0; i < 4; ++i) corners.push_back(RandomVector(random, 0.5));
    const double volume =
        (corners[1] - corners[0]).cross(corners[2] - corners[0]).dot(corners[3] - corners[0]);
    if (volume > 0.1) {
      return FromOutlines(corners, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}});
    }
  }
}

// Returns a vertex, or a point of an edge or face.
Vector3 PointOn(const Polyhedron& shape, RandomStream& random) {
  const int kind = random.Index(3);
  if (kind == 0) return At(shape.vertices, random.Index(4)).p;
  if (kind == 1) {
    const OuterEdge& edge = At(shape.edges, random.Index(6));
    return edge.start + random.Uniform(0.1, 0.9) * (edge.end - edge.start);
  }
  const std::vector<Vector3>& corners = At(shape.faces, random.Index(4)).region[0];
  const double first = random.Uniform(0.1, 0.8);
  const double second = random.Uniform(0.05, 0.9 - first);
  return first * corners[0] + second * corners[1] + (1 - first - second) * corners[2];
}

// Returns two tetrahedra with points of their surfaces within `gap` of each other.
Scene RandomScene(RandomStream& random, double gap) {
  Scene scene{RandomTetrahedron(random), RandomTetrahedron(random), RandomPose(random, 1)};
  const Vector3 apart = scene.X * PointOn(scene.moving, random) - PointOn(scene.stationary, random);
  scene.X.pretranslate(RandomVector(random, gap) - apart);
  return scene;
}

// Returns a box on another one in any orientation. Their faces are flush, and one box is turned
// about the normal. Corners or points of edges may be on edges of the other box.
Scene FlushBoxes(RandomStream& random) {
  const Vector3 low(-0.5, -0.4, -0.3);
  const Vector3 high(0.5, 0.4, 0);
  const auto outline_point = [&]() -> Vector3 {
    const double along = random.Index(2) == 0 ? 0.5 : random.Uniform(-0.5, 0.5);
    return {along, random.Index(2) == 0 ? 0.4 : -0.4, 0};
  };
  const Pose X_BoxesTop = geometry::RotationZ(random.Uniform(-3, 3));
  const Vector3 moving_point = outline_point();
  const Vector3 apart = outline_point() - X_BoxesTop * moving_point;
  const Pose attitude = RandomPose(random, 1);
  std::vector<Vector3> corners;
  for (const OuterVertex& vertex : BoxShape(low, high).vertices) corners.push_back(vertex.p);
  for (Vector3& corner : corners) corner = attitude * corner;
  const std::vector<std::vector<int>> outlines = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                                  {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  return {BoxShape({-0.5, -0.4, 0}, {0.5, 0.4, 0.6}), FromOutlines(corners, outlines),
          attitude * geometry::Translation(apart) * X_BoxesTop};
}

Vector3 UpTo(RandomStream& random, double length) {
  Vector3 v = RandomVector(random, 1);
  while (v.norm() > 1) v = RandomVector(random, 1);
  return length * v;
}

GeneralizedPoint RandomMotion(RandomStream& random, double size) {
  GeneralizedPoint z(kPoseDimensions);
  z.head<3>() = UpTo(random, size);
  z.tail<3>() = UpTo(random, size);
  return z;
}

// Returns whether edges cross at a large angle. Rows of nearly parallel edges are valid only for
// motions much smaller than their angle.
bool WellCrossed(const Scene& scene, const PrimitiveContact& contact) {
  if (contact.kind != ContactKind::kEdgeEdge) return true;
  const Vector3 u = scene.X.linear() * At(scene.moving.edges, contact.moving).direction();
  return u.cross(At(scene.stationary.edges, contact.stationary).direction()).norm() > 0.3;
}

// --- Exact contacts: features moved rigidly.

Pose Moved(const Pose& X, const GeneralizedPoint& z) {
  const Vector3 w = z.segment<3>(3);
  Pose moved = X;
  moved.translation() += z.head<3>();
  if (w.norm() > 0) {
    moved.linear() =
        Eigen::AngleAxisd(w.norm(), w.normalized()).toRotationMatrix() * moved.linear();
  }
  return moved;
}

OuterEdge Moved(OuterEdge edge, const Pose& X) {
  edge.start = X * edge.start;
  edge.end = X * edge.end;
  return edge;
}

// Returns the normal that points to the moving part.
Vector3 ExactNormal(const Scene& scene, const PrimitiveContact& contact, const Pose& X) {
  switch (contact.kind) {
    case ContactKind::kRimFace:
    case ContactKind::kRimRim:
    case ContactKind::kSideRim:
    case ContactKind::kRimWall:
      break;  // no shape of these tests is round
    case ContactKind::kVertexFace:
      return At(scene.stationary.faces, contact.stationary).normal;
    case ContactKind::kFaceVertex:
      return -(X.linear() * At(scene.moving.faces, contact.moving).normal);
    case ContactKind::kEdgeEdge: {
      const Vector3 u = X.linear() * At(scene.moving.edges, contact.moving).direction();
      const Vector3 n =
          u.cross(At(scene.stationary.edges, contact.stationary).direction()).normalized();
      return n.dot(contact.normal) > 0 ? n : -n;
    }
  }
  return {};
}

double ExactGap(const Scene& scene, const PrimitiveContact& contact, const Pose& X) {
  const Vector3 n = ExactNormal(scene, contact, X);
  switch (contact.kind) {
    case ContactKind::kRimFace:
    case ContactKind::kRimRim:
    case ContactKind::kSideRim:
    case ContactKind::kRimWall:
      break;  // no shape of these tests is round
    case ContactKind::kVertexFace:
      return n.dot(X * At(scene.moving.vertices, contact.moving).p) -
             At(scene.stationary.faces, contact.stationary).height;
    case ContactKind::kFaceVertex:
      return n.dot(X * At(scene.moving.faces, contact.moving).region[0][0] -
                   At(scene.stationary.vertices, contact.stationary).p);
    case ContactKind::kEdgeEdge:
      return n.dot(X * At(scene.moving.edges, contact.moving).start -
                   At(scene.stationary.edges, contact.stationary).start);
  }
  return 0;
}

// Returns the least distance of p inside the lines of the only polygon of a face.
double DepthIn(const OuterFace& face, const Vector3& p) {
  const std::vector<Vector3>& polygon = face.region[0];
  double depth = 1e9;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector3 along = (polygon[(i + 1) % polygon.size()] - polygon[i]).normalized();
    depth = std::min(depth, face.normal.cross(along).dot(p - polygon[i]));
  }
  return depth;
}

// Seen along their common normal, the lines of the two edges cross at a point. Returns the least
// distance from this point to an end of an edge.
double RangeLeft(const OuterEdge& a, const OuterEdge& b) {
  Eigen::Matrix3d lines;
  lines << a.direction(), -b.direction(), a.direction().cross(b.direction());
  const Vector3 st = lines.inverse() * (b.start - a.start);
  return std::min(
      {st.x(), (a.end - a.start).norm() - st.x(), st.y(), (b.end - b.start).norm() - st.y()});
}

// Returns the depth of the contact point inside both features; negative outside.
double ExtentLeft(const Scene& scene, const PrimitiveContact& contact, const Pose& X) {
  switch (contact.kind) {
    case ContactKind::kRimFace:
    case ContactKind::kRimRim:
    case ContactKind::kSideRim:
    case ContactKind::kRimWall:
      break;  // no shape of these tests is round
    case ContactKind::kVertexFace:
      return DepthIn(At(scene.stationary.faces, contact.stationary),
                     X * At(scene.moving.vertices, contact.moving).p);
    case ContactKind::kFaceVertex:
      return DepthIn(At(scene.moving.faces, contact.moving),
                     X.inverse() * At(scene.stationary.vertices, contact.stationary).p);
    case ContactKind::kEdgeEdge:
      return RangeLeft(Moved(At(scene.moving.edges, contact.moving), X),
                       At(scene.stationary.edges, contact.stationary));
  }
  return 0;
}

double LeastRise(const Polyhedron& shape, int vertex, const Vector3& n) {
  double rise = 1;
  for (const int index : At(shape.vertices, vertex).edges) {
    const OuterEdge& edge = At(shape.edges, index);
    const Vector3 middle = (edge.start + edge.end) / 2;
    rise = std::min(rise, n.dot((middle - At(shape.vertices, vertex).p).normalized()));
  }
  return rise;
}

double LeastRise(const Polyhedron& shape, const OuterEdge& edge, const Vector3& n) {
  double rise = 1;
  for (const int face : edge.faces) {
    const OuterFace& plane = At(shape.faces, face);
    Vector3 centre = Vector3::Zero();
    for (const Vector3& corner : plane.region[0]) centre += corner;
    centre /= static_cast<double>(plane.region[0].size());
    Vector3 into = centre - edge.start;
    into -= into.dot(edge.direction()) * edge.direction();
    rise = std::min(rise, n.dot(into.normalized()));
  }
  return rise;
}

// Near the contact, the surface of one part rises at an angle from the feature of the other part.
// Returns the sine of the least such angle. It is negative if the parts overlap.
double RoomLeft(const Scene& scene, const PrimitiveContact& contact, const Pose& X) {
  const Vector3 n = ExactNormal(scene, contact, X);
  const Vector3 n_moving = X.linear().transpose() * n;
  switch (contact.kind) {
    case ContactKind::kRimFace:
    case ContactKind::kRimRim:
    case ContactKind::kSideRim:
    case ContactKind::kRimWall:
      break;  // no shape of these tests is round
    case ContactKind::kVertexFace:
      return LeastRise(scene.moving, contact.moving, n_moving);
    case ContactKind::kFaceVertex:
      return LeastRise(scene.stationary, contact.stationary, -n);
    case ContactKind::kEdgeEdge:
      return std::min(
          LeastRise(scene.moving, At(scene.moving.edges, contact.moving), n_moving),
          LeastRise(scene.stationary, At(scene.stationary.edges, contact.stationary), -n));
  }
  return 0;
}

double LimitsLeft(const PrimitiveContact& contact, const GeneralizedPoint& z) {
  double left = 1e9;
  for (const HalfSpace& limit : contact.limits) left = std::min(left, -limit.Excess(z));
  return left;
}

// Returns the motion after a shift along the normal until the features touch.
GeneralizedPoint OntoSurface(const Scene& scene, const PrimitiveContact& contact,
                             GeneralizedPoint z) {
  const Pose X = Moved(scene.X, z);
  z.head<3>() -= ExactGap(scene, contact, X) * ExactNormal(scene, contact, X);
  return z;
}

// --- Figure 6.

Eigen::VectorXd Row6(double dx, double dy, double dz, double wx, double wy, double wz) {
  Eigen::VectorXd row(6);
  row << dx, dy, dz, wx, wy, wz;
  return row;
}

MATCHER_P2(IsHalfSpace, row, b, "") {
  return (arg.a / arg.a.norm() - row).cwiseAbs().maxCoeff() < 5e-4 &&
         std::abs(arg.b / arg.a.norm() - b) < 5e-4;
}

TEST(PrimitiveContactTest, RowsOfFigure6) {
  // The vertex (-1, 0, -0.55) is above the face y = 0, which ends 5 to the left of it.
  const Polyhedron moving = BoxShape({-1, 0, -2}, {1, 1, -0.55});
  const Polyhedron stationary = BoxShape({-40, -10, -20}, {-6, 0, 20});
  const auto contacts = PrimitiveContacts(moving, stationary, Pose::Identity(), 5.1);
  const auto found = std::ranges::find_if(contacts, [](const PrimitiveContact& contact) {
    return contact.kind == ContactKind::kVertexFace && contact.stationary == 3 &&
           contact.at == Vector3(-1, 0, -0.55);
  });
  ASSERT_NE(found, contacts.end());
  EXPECT_EQ(found->normal, Vector3::UnitY());
  EXPECT_NEAR(found->offset, 0, 1e-12);
  EXPECT_LT((found->row.normalized() - Row6(0, 0.659, 0, 0.362, 0, -0.659)).norm(), 1e-3);
  EXPECT_EQ(found->limits.size(), 4U);
  EXPECT_THAT(found->limits, testing::IsSupersetOf({
                                 IsHalfSpace(Row6(0, 0, 0, 0, 0, -1), 0.0),
                                 IsHalfSpace(Row6(0, 0, 0, -1, 0, 0), 0.0),
                                 IsHalfSpace(Row6(0.8762, 0, 0, 0, -0.4819, 0), -4.381),
                             }));
}

// --- Gaps and limits compared with exact geometry.

struct GapErrors {
  double sum = 0;
  double greatest = 0;
  std::map<ContactKind, int> count;
};

GapErrors ErrorsOfGaps(double size) {
  RandomStream random(kSeed, "gaps");
  GapErrors errors;
  for (int i = 0; i < 400; ++i) {
    const Scene scene = RandomScene(random, 0.02);
    const GeneralizedPoint z = size * RandomMotion(random, 1);
    for (const auto& contact : PrimitiveContacts(scene.moving, scene.stationary, scene.X, 0.1)) {
      if (!WellCrossed(scene, contact)) continue;
      EXPECT_NEAR(contact.offset, ExactGap(scene, contact, scene.X), 1e-12) << Name(contact);
      const double error = std::abs(contact.Gap(z) - ExactGap(scene, contact, Moved(scene.X, z)));
      errors.sum += error;
      errors.greatest = std::max(errors.greatest, error);
      ++errors.count[contact.kind];
    }
  }
  return errors;
}

TEST(PrimitiveContactTest, LinearGapIsWrongInTheSecondOrderOnly) {
  const GapErrors errors = ErrorsOfGaps(1e-4);
  EXPECT_LT(errors.greatest, 1.5e-7);
  EXPECT_NEAR(errors.sum / ErrorsOfGaps(5e-5).sum, 4, 0.01);
  for (const ContactKind kind : kKinds) EXPECT_GT(errors.count.at(kind), 50);
}

TEST(PrimitiveContactTest, FeaturesWithinTheirExtentAreInsideTheLimits) {
  RandomStream random(kSeed, "extents");
  std::map<ContactKind, int> inside;
  std::map<ContactKind, int> outside;
  for (int i = 0; i < 2000; ++i) {
    const Scene scene = RandomScene(random, 0);
    for (const auto& contact : PrimitiveContacts(scene.moving, scene.stationary, scene.X, kTouch)) {
      if (!WellCrossed(scene, contact)) continue;
      const GeneralizedPoint z = OntoSurface(scene, contact, RandomMotion(random, 1e-4));
      const double left = ExtentLeft(scene, contact, Moved(scene.X, z));
      EXPECT_NEAR(LimitsLeft(contact, z), left, 1e-6) << Name(contact) << " in scene " << i;
      ++(left > 0 ? inside : outside)[contact.kind];
    }
  }
  for (const ContactKind kind : kKinds) {
    EXPECT_GT(inside[kind], 50);
    EXPECT_GT(outside[kind], 50);
  }
}

TEST(PrimitiveContactTest, ContactsOfFlushFacesHoldExactlyInsideTheirLimits) {
  RandomStream random(kSeed, "flush");
  std::map<ContactKind, int> inside;
  std::map<ContactKind, int> overlapping;
  for (int i = 0; i < 2000; ++i) {
    const Scene scene = FlushBoxes(random);
    for (const auto& contact : PrimitiveContacts(scene.moving, scene.stationary, scene.X, kTouch)) {
      EXPECT_LE(contact.limits.size(), 4U);
      if (!WellCrossed(scene, contact)) continue;
      const GeneralizedPoint z = OntoSurface(scene, contact, RandomMotion(random, 1e-4));
      const double linear = LimitsLeft(contact, z);
      if (std::abs(linear) < 5e-7) continue;  // terms of second order decide here
      const double extent = ExtentLeft(scene, contact, Moved(scene.X, z));
      const double room = RoomLeft(scene, contact, Moved(scene.X, z));
      EXPECT_EQ(linear > 0, extent > 0 && room > 0)
          << Name(contact) << " in scene " << i << ": " << linear << " " << extent << " " << room;
      if (linear > 0) ++inside[contact.kind];
      if (extent > 0 && room < 0) ++overlapping[contact.kind];
    }
  }
  for (const ContactKind kind : kKinds) {
    EXPECT_GT(inside[kind], 100);
    EXPECT_GT(overlapping[kind], 100);
  }
}

// --- Tolerances.

// Returns the tetrahedron with each face displaced outward. Every corner stays where its faces
// meet.
Polyhedron Displaced(const Polyhedron& shape, const std::vector<double>& outward) {
  std::vector<Vector3> corners;
  for (const OuterVertex& vertex : shape.vertices) {
    Eigen::Matrix3d normals;
    Vector3 heights;
    int row = 0;
    for (std::size_t f = 0; f < shape.faces.size(); ++f) {
      const OuterFace& face = shape.faces[f];
      if (std::abs(face.normal.dot(vertex.p) - face.height) > 1e-9) continue;
      normals.row(row) = face.normal;
      heights[row++] = face.height + outward[f];
    }
    corners.emplace_back(normals.inverse() * heights);
  }
  return FromOutlines(corners, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}});
}

std::vector<ModelTolerance> TetrahedronTolerances() {
  using Of = ModelTolerance::Of;
  return {{"m0", Of::kMovingFaces, {0}},     {"m1, m2", Of::kMovingFaces, {1, 2}},
          {"s3", Of::kStationaryFaces, {3}}, {"s0, s1", Of::kStationaryFaces, {0, 1}},
          {"m3", Of::kMovingFaces, {3}},     {"s2", Of::kStationaryFaces, {2}}};
}

Scene WithErrors(const Scene& scene, const GeneralizedPoint& z) {
  const auto t = z.tail<6>();
  return {Displaced(scene.moving, {t[0], t[1], t[1], t[4]}),
          Displaced(scene.stationary, {t[3], t[3], t[5], t[2]}), scene.X};
}

TEST(PrimitiveContactTest, ToleranceColumnsAreExact) {
  RandomStream random(kSeed, "tolerances");
  std::map<ContactKind, int> count;
  for (int i = 0; i < 400; ++i) {
    const Scene scene = RandomScene(random, 0.02);
    GeneralizedPoint z = GeneralizedPoint::Zero(kPoseDimensions + 6);
    for (int k = 0; k < 6; ++k) z[kPoseDimensions + k] = random.Uniform(-0.01, 0.01);
    const Scene wrong = WithErrors(scene, z);
    for (const auto& contact :
         PrimitiveContacts(scene.moving, scene.stationary, scene.X, 0.1, TetrahedronTolerances())) {
      if (!WellCrossed(scene, contact)) continue;
      EXPECT_NEAR(contact.Gap(z), ExactGap(wrong, contact, scene.X), 1e-11) << Name(contact);
      EXPECT_NEAR(LimitsLeft(contact, z), ExtentLeft(wrong, contact, scene.X), 1e-11)
          << Name(contact);
      ++count[contact.kind];
    }
  }
  for (const ContactKind kind : kKinds) EXPECT_GT(count[kind], 50);
}

TEST(PrimitiveContactTest, AFaceDisplacedOutwardClosesTheGapByAsMuch) {
  const std::vector<ModelTolerance> tolerances = {
      {"bottom of the cube", ModelTolerance::Of::kMovingFaces, {4}},
      {"top of the slab", ModelTolerance::Of::kStationaryFaces, {5}},
      {"sides of the cube", ModelTolerance::Of::kMovingFaces, {0, 1, 2, 3}}};
  for (const auto& contact :
       PrimitiveContacts(CubeShape(0.5), BoxShape({-5, -5, -1}, {5, 5, 0}),
                         geometry::Translation(0, 0, 0.5), kTouch, tolerances)) {
    EXPECT_LT((contact.row.tail<3>() - Vector3(-1, -1, 0)).norm(), 1e-12) << Name(contact);
  }
}

// --- Which contacts there are.

TEST(PrimitiveContactTest, ACubeOnABigFaceTouchesItWithFourVertices) {
  const auto contacts = PrimitiveContacts(CubeShape(0.5), BoxShape({-5, -5, -1}, {5, 5, 0}),
                                          geometry::Translation(1, 2, 0.5), kTouch);
  std::vector<std::string> names;
  for (const PrimitiveContact& contact : contacts) names.push_back(Name(contact));
  EXPECT_THAT(names, testing::ElementsAre("vertex 0 on face 5", "vertex 1 on face 5",
                                          "vertex 2 on face 5", "vertex 3 on face 5"));
  for (const PrimitiveContact& contact : contacts) EXPECT_EQ(contact.limits.size(), 4U);
}

TEST(PrimitiveContactTest, ASeamThatLeavesTheRegionConvexSplitsNoContact) {
  Polyhedron slab = BoxShape({-5, -5, -1}, {5, 5, 0});
  slab.faces[5].region = {{{-5, -5, 0}, {0.5, -5, 0}, {0.5, 5, 0}, {-5, 5, 0}},
                          {{0.5, -5, 0}, {5, -5, 0}, {5, 5, 0}, {0.5, 5, 0}}};
  EXPECT_EQ(
      PrimitiveContacts(CubeShape(0.5), slab, geometry::Translation(0, 0, 0.5), kTouch).size(), 4U);
}

TEST(PrimitiveContactTest, BothSidesOfAFaceNarrowerThanTheReachLimitAContact) {
  // The rail is 4 mm wide, and a corner of the cube is on its middle. Within 5 mm both sides and
  // the end of the rail count, and so do the two edges of the cube that lie in the top of the rail.
  const auto contacts =
      PrimitiveContacts(BoxShape({0, 0, 0}, {1, 1, 1}),
                        BoxShape({-1, -0.002, -1}, {0.003, 0.002, 0}), Pose::Identity(), 0.005);
  const auto corner = std::ranges::find_if(contacts, [](const PrimitiveContact& contact) {
    return Name(contact) == "vertex 0 on face 5";
  });
  ASSERT_NE(corner, contacts.end());
  EXPECT_EQ(corner->limits.size(), 5U);
}

TEST(PrimitiveContactTest, AnOverhangingCubeTouchesWithVerticesAndCrossingEdges) {
  // Two corners of the cube are on the slab, and two of its edges extend over the edge of the slab.
  const auto contacts = PrimitiveContacts(CubeShape(0.5), BoxShape({-5, -5, -1}, {0, 5, 0}),
                                          geometry::Translation(0, 0, 0.5), kTouch);
  EXPECT_EQ(CountKinds(contacts), (std::map<ContactKind, int>{{ContactKind::kVertexFace, 2},
                                                              {ContactKind::kEdgeEdge, 2}}));
  for (const PrimitiveContact& contact : contacts) {
    EXPECT_LT((contact.normal - Vector3::UnitZ()).norm(), 1e-12) << Name(contact);
  }
}

TEST(PrimitiveContactTest, ACornerOnAFaceIsOneContact) {
  // The cube stands on its corner.
  const Pose X(Eigen::Quaterniond::FromTwoVectors(Vector3(-1, -1, -1), -Vector3::UnitZ()));
  const auto contacts =
      PrimitiveContacts(CubeShape(0.5), BoxShape({-5, -5, -1}, {5, 5, 0}),
                        geometry::Translation(0, 0, 0.5 * std::numbers::sqrt3) * X, kTouch);
  ASSERT_EQ(contacts.size(), 1U);
  EXPECT_EQ(Name(contacts[0]), "vertex 0 on face 5");
}

TEST(PrimitiveContactTest, FeaturesThatPointIntoTheOtherPartMakeNoContact) {
  // The cube is in the slab, with its upper corners in the top of the slab.
  EXPECT_TRUE(PrimitiveContacts(CubeShape(0.5), BoxShape({-5, -5, -5}, {5, 5, 0}),
                                geometry::Translation(0, 0, -0.5), kTouch)
                  .empty());
}

TEST(PrimitiveContactTest, SquarePegAtTheRimOfASquareHole) {
  const Polyhedron peg = BoxShape({-1, -1, 0}, {1, 1, 2});
  const auto contacts = PrimitiveContacts(peg, SquareHoleShape(1, 3, 2), Pose::Identity(), kTouch);
  // Each of the 4 lower corners touches 2 walls and 2 of the rectangles of the top. Each of the 4
  // lower edges touches with its ends the 2 rim edges across it. Each of the 4 upright edges
  // touches 2 rim edges.
  EXPECT_EQ(CountKinds(contacts), (std::map<ContactKind, int>{{ContactKind::kVertexFace, 16},
                                                              {ContactKind::kEdgeEdge, 16}}));
}

TEST(PrimitiveContactTest, SquarePegHalfInASquareHole) {
  const Polyhedron peg = BoxShape({-1, -1, 0}, {1, 1, 2});
  const auto contacts =
      PrimitiveContacts(peg, SquareHoleShape(1, 3, 2), geometry::Translation(0, 0, -1), kTouch);
  // Each lower corner touches 2 walls, and each upright edge touches 2 rim edges.
  EXPECT_EQ(CountKinds(contacts), (std::map<ContactKind, int>{{ContactKind::kVertexFace, 8},
                                                              {ContactKind::kEdgeEdge, 8}}));
  for (const PrimitiveContact& contact : contacts) {
    EXPECT_NEAR(contact.normal.z(), 0, 1e-12) << Name(contact);
  }
}

// --- Symmetry.

ContactKind Mirrored(ContactKind kind) {
  switch (kind) {
    case ContactKind::kRimFace:
    case ContactKind::kRimRim:
    case ContactKind::kSideRim:
    case ContactKind::kRimWall:
      break;  // no shape of these tests is round
    case ContactKind::kVertexFace:
      return ContactKind::kFaceVertex;
    case ContactKind::kFaceVertex:
      return ContactKind::kVertexFace;
    case ContactKind::kEdgeEdge:
      return ContactKind::kEdgeEdge;
  }
  return kind;
}

// Returns the motion of the stationary part in the axes of the moving part, if the stationary part
// moves instead.
GeneralizedPoint Mirrored(const GeneralizedPoint& z, const Pose& X) {
  const Vector3 w = z.segment<3>(3);
  GeneralizedPoint mirrored = z;
  mirrored.head<3>() = -X.linear().transpose() * (z.head<3>() - w.cross(X.translation()));
  mirrored.segment<3>(3) = -X.linear().transpose() * w;
  return mirrored;
}

std::vector<ModelTolerance> Mirrored(std::vector<ModelTolerance> tolerances) {
  using Of = ModelTolerance::Of;
  for (ModelTolerance& tolerance : tolerances) {
    tolerance.of = tolerance.of == Of::kMovingFaces ? Of::kStationaryFaces : Of::kMovingFaces;
  }
  return tolerances;
}

void ExpectMirrored(const Scene& scene, const GeneralizedPoint& z) {
  const auto tolerances = TetrahedronTolerances();
  const auto contacts = PrimitiveContacts(scene.moving, scene.stationary, scene.X, 0.1, tolerances);
  const auto mirrored = PrimitiveContacts(scene.stationary, scene.moving, scene.X.inverse(), 0.1,
                                          Mirrored(tolerances));
  ASSERT_EQ(contacts.size(), mirrored.size());
  for (const PrimitiveContact& contact : contacts) {
    const auto other = std::ranges::find_if(mirrored, [&](const PrimitiveContact& candidate) {
      return candidate.kind == Mirrored(contact.kind) && candidate.moving == contact.stationary &&
             candidate.stationary == contact.moving;
    });
    ASSERT_NE(other, mirrored.end()) << Name(contact);
    if (!WellCrossed(scene, contact)) continue;
    const GeneralizedPoint mirrored_z = Mirrored(z, scene.X);
    EXPECT_NEAR(contact.Gap(z), other->Gap(mirrored_z), 1e-9) << Name(contact);
    EXPECT_LT((contact.normal + scene.X.linear() * other->normal).norm(), 1e-9) << Name(contact);
    ASSERT_EQ(contact.limits.size(), other->limits.size()) << Name(contact);
  }
}

TEST(PrimitiveContactTest, SwappedPartsGiveMirroredRows) {
  RandomStream random(kSeed, "swap");
  for (int i = 0; i < 200; ++i) {
    const Scene scene = RandomScene(random, 0.02);
    GeneralizedPoint z(kPoseDimensions + 6);
    for (int k = 0; k < z.size(); ++k) z[k] = random.Uniform(-0.01, 0.01);
    ExpectMirrored(scene, z);
  }
}

TEST(PrimitiveContactTest, SwappedPartsAreLimitedAlike) {
  RandomStream random(kSeed, "swapped limits");
  for (int i = 0; i < 200; ++i) {
    const Scene scene = RandomScene(random, 0);
    const auto contacts = PrimitiveContacts(scene.moving, scene.stationary, scene.X, kTouch);
    const auto mirrored =
        PrimitiveContacts(scene.stationary, scene.moving, scene.X.inverse(), kTouch);
    const GeneralizedPoint z = RandomMotion(random, 0.01);
    std::vector<double> left;
    std::vector<double> left_mirrored;
    for (const auto& contact : contacts) left.push_back(LimitsLeft(contact, z));
    for (const auto& contact : mirrored) {
      left_mirrored.push_back(LimitsLeft(contact, Mirrored(z, scene.X)));
    }
    std::ranges::sort(left);
    std::ranges::sort(left_mirrored);
    EXPECT_THAT(left_mirrored, testing::Pointwise(testing::DoubleNear(1e-6), left));
  }
}

TEST(ContactNamed, ReadsWhatNameWrites) {
  for (const auto kind :
       {ContactKind::kVertexFace, ContactKind::kFaceVertex, ContactKind::kEdgeEdge}) {
    const ContactKey key{kind, 3, 12};
    EXPECT_EQ(ContactNamed(Name(key)), key) << Name(key);
  }
  for (const char* name :
       {"", "vertex", "vertex 3 on face", "vertex 3 on vertex 1", "vertex 3 on face 1 ",
        "edge 1.5 on edge 2", "edge 99999999999 on edge 2"}) {
    EXPECT_EQ(ContactNamed(name), std::nullopt) << name;
  }
}

}  // namespace
}  // namespace assay::finemotion::primitive_contact_test
