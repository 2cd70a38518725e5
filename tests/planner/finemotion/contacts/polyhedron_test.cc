#include "planner/finemotion/contacts/polyhedron.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <span>
#include <tuple>
#include <utility>

#include "planner/base/random.h"
#include "planner/geometry/box.h"
#include "planner/geometry/hull.h"
#include "planner/geometry/pose.h"
#include "planner/geometry/solids/convex_cut.h"
#include "tests/oracle/random_pose.h"

namespace assay::finemotion::polyhedron_test {
namespace {

using geometry::Box;
using geometry::ConvexHull;
using geometry::Facet;
using oracle::RandomPose;
using oracle::RandomVector;

using Cell = std::array<int, 3>;

constexpr std::uint64_t kSeed = 43;
constexpr double kPi = std::numbers::pi;

ConvexPiece PieceOf(const Box& box) {
  const auto corners = box.Corners();
  return {{corners.begin(), corners.end()}};
}

std::vector<ConvexPiece> PiecesOf(std::span<const Box> boxes) {
  std::vector<ConvexPiece> pieces;
  for (const Box& box : boxes) pieces.push_back(PieceOf(box));
  return pieces;
}

ConvexPiece BoxPiece(const Vector3& low, const Vector3& high) {
  return PieceOf(Box::FromCorners(low, high));
}

std::vector<ConvexPiece> Moved(std::vector<ConvexPiece> pieces, const Pose& X) {
  for (ConvexPiece& piece : pieces) {
    for (Vector3& p : piece.corners) p = X * p;
  }
  return pieces;
}

double AreaOf(const std::vector<Vector3>& polygon) {
  Vector3 doubled = Vector3::Zero();
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    doubled += (polygon[i - 1] - polygon[0]).cross(polygon[i] - polygon[0]);
  }
  return doubled.norm() / 2;
}

double AreaOf(const OuterFace& face) {
  double area = 0;
  for (const auto& polygon : face.region) area += AreaOf(polygon);
  return area;
}

double SurfaceOf(const Polyhedron& outside) {
  double area = 0;
  for (const OuterFace& face : outside.faces) area += AreaOf(face);
  return area;
}

double LengthOf(const OuterEdge& edge) { return (edge.end - edge.start).norm(); }

void ExpectConvexCounterClockwise(const std::vector<Vector3>& polygon, const Vector3& normal) {
  ASSERT_GE(polygon.size(), 3u);
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector3& p = polygon[i];
    const Vector3& q = polygon[(i + 1) % polygon.size()];
    for (const Vector3& r : polygon) EXPECT_GE((q - p).cross(r - p).dot(normal), -1e-6);
  }
}

// Expects the properties of indices, planes and outlines that the header promises.
void ExpectWellFormed(const Polyhedron& outside) {
  for (const OuterFace& face : outside.faces) {
    EXPECT_NEAR(face.normal.norm(), 1, 1e-12);
    ASSERT_FALSE(face.region.empty());
    for (const auto& polygon : face.region) {
      ExpectConvexCounterClockwise(polygon, face.normal);
      for (const Vector3& p : polygon) EXPECT_NEAR(face.normal.dot(p), face.height, 2e-7);
    }
  }
  for (const OuterEdge& edge : outside.edges) {
    EXPECT_NE(edge.faces[0], edge.faces[1]);
    for (int f : edge.faces) {
      const OuterFace& face = outside.faces.at(f);
      EXPECT_NEAR(face.normal.dot(edge.start), face.height, 2e-7);
      EXPECT_NEAR(face.normal.dot(edge.end), face.height, 2e-7);
    }
  }
  for (const OuterVertex& vertex : outside.vertices) {
    EXPECT_GE(vertex.edges.size(), 3u);
    for (int e : vertex.edges) {
      const OuterEdge& edge = outside.edges.at(e);
      EXPECT_NEAR(std::min((edge.start - vertex.p).norm(), (edge.end - vertex.p).norm()), 0, 2e-7);
    }
  }
}

void ExpectCounts(const Polyhedron& outside, std::size_t faces, std::size_t edges,
                  std::size_t vertices) {
  EXPECT_EQ(outside.faces.size(), faces);
  EXPECT_EQ(outside.edges.size(), edges);
  EXPECT_EQ(outside.vertices.size(), vertices);
  ExpectWellFormed(outside);
}

TEST(PolyhedronTest, Box) {
  const Polyhedron outside = OutsideOf({BoxPiece({0, 0, 0}, {1, 2, 3})});
  ExpectCounts(outside, 6, 12, 8);
  EXPECT_NEAR(SurfaceOf(outside), 22, 1e-12);
  for (const OuterVertex& vertex : outside.vertices) EXPECT_EQ(vertex.edges.size(), 3u);
}

void ExpectBoxOfLength3(const Polyhedron& outside) {
  ExpectCounts(outside, 6, 12, 8);
  EXPECT_NEAR(SurfaceOf(outside), 14, 1e-6);
  double length = 0;
  for (const OuterEdge& edge : outside.edges) length += LengthOf(edge);
  EXPECT_NEAR(length, 20, 1e-6);
  for (const OuterFace& face : outside.faces) EXPECT_EQ(face.region.size(), 1u);
}

TEST(PolyhedronTest, SeamsAreNoEdges) {
  const ConvexPiece left = BoxPiece({0, 0, 0}, {1, 1, 1});
  ExpectBoxOfLength3(OutsideOf({left, BoxPiece({1, 0, 0}, {3, 1, 1})}));
  ExpectBoxOfLength3(OutsideOf({left, BoxPiece({0.5, 0, 0}, {3, 1, 1})}));
  ExpectBoxOfLength3(OutsideOf({left, left, BoxPiece({0, 0, 0}, {3, 1, 1})}));
  // These pieces have a crack between them.
  ExpectBoxOfLength3(OutsideOf({left, BoxPiece({1 + 4e-8, 0, 0}, {3, 1, 1})}));
}

// Each half has half of the angle at two of the edges of the box.
TEST(PolyhedronTest, BoxCutAlongTheDiagonal) {
  const ConvexPiece below{{{0, 0, 0}, {3, 0, 0}, {3, 0, 1}, {0, 1, 0}, {3, 1, 0}, {3, 1, 1}}};
  const ConvexPiece above{{{0, 0, 0}, {0, 0, 1}, {3, 0, 1}, {0, 1, 0}, {0, 1, 1}, {3, 1, 1}}};
  ExpectBoxOfLength3(OutsideOf({below, above}));
}

// The profile has six corners, of which one is concave.
TEST(PolyhedronTest, AngleOfTwoBoxes) {
  const Polyhedron outside =
      OutsideOf({BoxPiece({0, 0, 0}, {2, 1, 1}), BoxPiece({0, 0, 1}, {1, 1, 2})});
  ExpectCounts(outside, 8, 5 + 2 * 6, 2 * 5);
  EXPECT_NEAR(SurfaceOf(outside), 8 + 2 * 3, 1e-9);
  for (const OuterEdge& edge : outside.edges) {
    const Vector3 middle = (edge.start + edge.end) / 2;
    EXPECT_GT((middle - Vector3(1, 0.5, 1)).norm(), 0.1);  // the concave edge
  }
}

// The dimensions are those of models/parts/block, in inches.
TEST(PolyhedronTest, BlockWithTwoSquareHoles) {
  const Box body = Box::FromCorners({0, -1.5, 0}, {3, 1.5, 6.5});
  const Box hole = Box::FromCorners({0.2, -0.75, 2.5}, {3, 0.75, 4});
  const Box pin_hole = Box::FromCorners({2.5, -0.125, 4.25}, {3, 0.125, 4.5});
  std::vector<ConvexPiece> pieces;
  for (const ConvexHull& around : Without(HullOf(body), HullOf(hole))) {
    for (const ConvexHull& rest : Without(around, HullOf(pin_hole))) {
      pieces.push_back({rest.vertices});
    }
  }
  const Polyhedron outside = OutsideOf(Moved(pieces, geometry::RotationY(0.3)));
  // A hole has four walls and a floor. Only the edges of its mouth are convex.
  ExpectCounts(outside, 6 + 2 * 5, 12 + 2 * 4, 8);
  const double body_area = 2 * (3 * 3 + 3 * 6.5 + 3 * 6.5);
  EXPECT_NEAR(SurfaceOf(outside), body_area + 2.8 * 6 + 0.5 * 1, 1e-6);
  const Vector3 front = geometry::RotationY(0.3) * Vector3(1, 0, 0);
  const auto in_front = [&](const OuterEdge& edge) {
    return std::ranges::any_of(
        edge.faces, [&](int f) { return (outside.faces[f].normal - front).norm() < 1e-9; });
  };
  EXPECT_EQ(std::ranges::count_if(outside.edges, in_front), 4 + 2 * 4);
}

void ExpectOctagonalPrism(const Polyhedron& outside, double radius) {
  ExpectCounts(outside, 10, 24, 16);
  for (const OuterVertex& vertex : outside.vertices) {
    EXPECT_NEAR(vertex.p.head<2>().norm(), radius, 1e-9);
    EXPECT_EQ(vertex.edges.size(), 3u);
  }
  EXPECT_NEAR(SurfaceOf(outside),
              2 * 4 * radius * radius * std::sin(kPi / 4) + 8 * 2 * radius * std::sin(kPi / 8) * 3,
              1e-6);
}

TEST(PolyhedronTest, OctagonalPrism) {
  ConvexPiece prism;
  for (int i = 0; i < 8; ++i) {
    const double angle = i * kPi / 4;
    prism.corners.emplace_back(2 * std::cos(angle), 2 * std::sin(angle), 0);
    prism.corners.emplace_back(2 * std::cos(angle), 2 * std::sin(angle), 3);
  }
  ExpectOctagonalPrism(OutsideOf({prism}), 2);
}

// Each edge belongs to two boxes, neither of which has all of it.
TEST(PolyhedronTest, OctagonalPrismOfCrossingBoxes) {
  const Vector3 half(2 * std::cos(kPi / 8), 2 * std::sin(kPi / 8), 1.5);
  std::vector<Box> boxes;
  for (int i = 0; i < 4; ++i) {
    boxes.push_back(Box{geometry::Translation(0, 0, 1.5) * geometry::RotationZ(i * kPi / 4), half});
  }
  ExpectOctagonalPrism(OutsideOf(PiecesOf(boxes)), 2);
}

// Two pieces touch each other at their tips. A plane can touch both tips from outside only if both
// pieces are on the same side of it.
TEST(PolyhedronTest, TwoTips) {
  const ConvexPiece right{{{0, 0, 0}, {1, -0.3, 1}, {1, 0.3, 1}, {1.5, 0, 1}}};
  ConvexPiece left = right;
  ConvexPiece opposite = right;
  for (Vector3& p : left.corners) p.x() = -p.x();
  for (Vector3& p : opposite.corners) p = -p;
  const Polyhedron fork = OutsideOf({right, left});
  ExpectCounts(fork, 8, 12, 7);
  const auto is_tip = [](const OuterVertex& vertex) { return vertex.p.norm() < 1e-9; };
  const auto tip = std::ranges::find_if(fork.vertices, is_tip);
  ASSERT_NE(tip, fork.vertices.end());
  EXPECT_EQ(tip->edges.size(), 6u);
  ExpectCounts(OutsideOf({right, opposite}), 8, 12, 6);
}

// The foot of the spike touches the edge of the box in one point. The corner of the spike there is
// not convex.
TEST(PolyhedronTest, SpikeThatStandsOnAnEdge) {
  const ConvexPiece spike{{{1, 0, 1}, {0.8, 0.5, 1}, {1.2, 0.5, 1}, {1, 0.5, 2}}};
  const Polyhedron outside = OutsideOf({BoxPiece({0, 0, 0}, {2, 1, 1}), spike});
  ExpectCounts(outside, 6 + 3, 13 + 3, 8 + 1);
}

// Some filled unit cubes of a 3 x 3 x 3 grid.
class Voxels {
 public:
  bool At(const Cell& cell) const { return filled_.contains(cell); }
  void Fill(const Cell& cell) { filled_.insert(cell); }
  const std::set<Cell>& cells() const { return filled_; }

 private:
  std::set<Cell> filled_;
};

// A convex edge between lattice points, and the outward diagonal between its faces.
using LatticeEdge = std::tuple<Cell, Cell, Cell>;

struct LatticeFeatures {
  std::multiset<int> face_areas;
  std::set<LatticeEdge> edges;
  std::set<Cell> vertices;

  bool operator==(const LatticeFeatures&) const = default;
};

// Adds the areas of the faces in one plane. `squares` are the unit squares of the plane whose
// material is on one side. Each square is given by the cell behind it. Squares with a common side
// belong to one face.
void AddFaceAreas(std::set<Cell> squares, int axis, LatticeFeatures& features) {
  while (!squares.empty()) {
    std::vector<Cell> face = {*squares.begin()};
    squares.erase(squares.begin());
    for (std::size_t i = 0; i < face.size(); ++i) {
      for (int other : {(axis + 1) % 3, (axis + 2) % 3}) {
        for (int step : {-1, 1}) {
          Cell next = face[i];
          next[other] += step;
          if (squares.erase(next) > 0) face.push_back(next);
        }
      }
    }
    features.face_areas.insert(static_cast<int>(face.size()));
  }
}

void AddFaceAreas(const Voxels& voxels, LatticeFeatures& features) {
  for (int axis = 0; axis < 3; ++axis) {
    for (int side : {-1, 1}) {
      for (int layer = 0; layer < 3; ++layer) {
        std::set<Cell> squares;
        for (const Cell& cell : voxels.cells()) {
          Cell beyond = cell;
          beyond[axis] += side;
          if (cell[axis] == layer && !voxels.At(beyond)) squares.insert(cell);
        }
        AddFaceAreas(std::move(squares), axis, features);
      }
    }
  }
}

// Returns the outward diagonal of the unit edge from `start` along `axis`. It points away from the
// only filled neighbour, and is zero unless there is exactly one.
Cell OutwardAt(const Voxels& voxels, const Cell& start, int axis) {
  const int u = (axis + 1) % 3;
  const int v = (axis + 2) % 3;
  Cell outward = {0, 0, 0};
  int count = 0;
  for (int du : {-1, 0}) {
    for (int dv : {-1, 0}) {
      Cell cell = start;
      cell[u] += du;
      cell[v] += dv;
      if (!voxels.At(cell)) continue;
      ++count;
      outward[u] = du == 0 ? -1 : 1;
      outward[v] = dv == 0 ? -1 : 1;
    }
  }
  return count == 1 ? outward : Cell{0, 0, 0};
}

// Unit edges that follow each other with the same outward diagonal make one edge.
void AddEdges(const Voxels& voxels, int axis, Cell at, LatticeFeatures& features) {
  const Cell none = {0, 0, 0};
  Cell start = at;
  Cell outward = none;
  for (int i = 0; i <= 3; ++i) {
    at[axis] = i;
    const Cell next = i < 3 ? OutwardAt(voxels, at, axis) : none;
    if (next == outward) continue;
    if (outward != none) features.edges.insert({start, at, outward});
    outward = next;
    start = at;
  }
}

int FilledAround(const Voxels& voxels, const Cell& p) {
  int count = 0;
  for (int bits = 0; bits < 8; ++bits) {
    count += voxels.At({p[0] - (bits & 1), p[1] - (bits >> 1 & 1), p[2] - (bits >> 2)}) ? 1 : 0;
  }
  return count;
}

LatticeFeatures FeaturesOf(const Voxels& voxels) {
  LatticeFeatures features;
  AddFaceAreas(voxels, features);
  for (int i = 0; i <= 3; ++i) {
    for (int k = 0; k <= 3; ++k) {
      AddEdges(voxels, 0, {0, i, k}, features);
      AddEdges(voxels, 1, {i, 0, k}, features);
      AddEdges(voxels, 2, {i, k, 0}, features);
      for (int j = 0; j <= 3; ++j) {
        if (FilledAround(voxels, {i, j, k}) == 1) features.vertices.insert({i, j, k});
      }
    }
  }
  return features;
}

Cell Rounded(const Vector3& p) {
  Cell cell;
  for (int i = 0; i < 3; ++i) {
    cell[i] = static_cast<int>(std::lround(p[i]));
    EXPECT_NEAR(p[i], cell[i], 1e-6);
  }
  return cell;
}

LatticeFeatures FeaturesOf(const Polyhedron& outside, const Pose& X_PartGrid) {
  const Pose X = X_PartGrid.inverse();
  LatticeFeatures features;
  for (const OuterFace& face : outside.faces) {
    const int squares = static_cast<int>(std::lround(AreaOf(face)));
    EXPECT_NEAR(AreaOf(face), squares, 1e-6);
    features.face_areas.insert(squares);
  }
  for (const OuterEdge& edge : outside.edges) {
    const auto [a, b] = std::minmax({Rounded(X * edge.start), Rounded(X * edge.end)});
    const Vector3 outward =
        outside.faces[edge.faces[0]].normal + outside.faces[edge.faces[1]].normal;
    EXPECT_TRUE(features.edges.insert({a, b, Rounded(X.linear() * outward)}).second);
  }
  for (const OuterVertex& vertex : outside.vertices) {
    EXPECT_TRUE(features.vertices.insert(Rounded(X * vertex.p)).second);
  }
  return features;
}

void ExpectFeaturesOf(const Voxels& voxels, const std::vector<ConvexPiece>& pieces,
                      RandomStream& random) {
  const Pose X = RandomPose(random, 2);
  const Polyhedron outside = OutsideOf(Moved(pieces, X));
  ExpectWellFormed(outside);
  const LatticeFeatures found = FeaturesOf(outside, X);
  const LatticeFeatures expected = FeaturesOf(voxels);
  EXPECT_EQ(found.face_areas, expected.face_areas);
  EXPECT_EQ(found.edges, expected.edges);
  EXPECT_EQ(found.vertices, expected.vertices);
}

TEST(PolyhedronTest, RandomCubesOfAGridAgainstCounting) {
  RandomStream random(kSeed, "cubes");
  for (int trial = 0; trial < 150; ++trial) {
    const double share = random.Uniform(0.1, 1);
    Voxels voxels;
    std::vector<ConvexPiece> pieces;
    for (int index = 0; index < 27; ++index) {
      if (random.Uniform() > share) continue;
      const Cell cell = {index % 3, index / 3 % 3, index / 9};
      const Vector3 low(cell[0], cell[1], cell[2]);
      voxels.Fill(cell);
      pieces.push_back(BoxPiece(low, low + Vector3::Ones()));
    }
    SCOPED_TRACE(trial);
    ExpectFeaturesOf(voxels, pieces, random);
  }
}

Voxels Filled(const Cell& low, const Cell& high, Voxels voxels) {
  for (int i = low[0]; i < high[0]; ++i) {
    for (int j = low[1]; j < high[1]; ++j) {
      for (int k = low[2]; k < high[2]; ++k) voxels.Fill({i, j, k});
    }
  }
  return voxels;
}

// The boxes touch and overlap, with corners inside the faces and edges of others.
TEST(PolyhedronTest, RandomBoxesOfAGridAgainstCounting) {
  RandomStream random(kSeed, "boxes");
  for (int trial = 0; trial < 400; ++trial) {
    Voxels voxels;
    std::vector<ConvexPiece> pieces;
    const int count = 2 + random.Index(5);
    for (int b = 0; b < count; ++b) {
      Cell low;
      Cell high;
      for (int i = 0; i < 3; ++i) {
        low[i] = random.Index(3);
        high[i] = low[i] + 1 + random.Index(3 - low[i]);
      }
      voxels = Filled(low, high, std::move(voxels));
      pieces.push_back(
          BoxPiece(Vector3(low[0], low[1], low[2]), Vector3(high[0], high[1], high[2])));
    }
    SCOPED_TRACE(trial);
    ExpectFeaturesOf(voxels, pieces, random);
  }
}

// Pieces in general position: no two touch without overlapping.
struct Heap {
  std::vector<ConvexPiece> pieces;
  std::vector<ConvexHull> hulls;
};

Heap RandomHeap(RandomStream& random) {
  Heap heap;
  const int count = 2 + random.Index(4);
  for (int i = 0; i < count; ++i) {
    const Vector3 center = RandomVector(random, 0.7);
    std::vector<Vector3> points;
    for (int k = 0; k < 9; ++k) points.push_back(center + RandomVector(random, 1));
    heap.hulls.push_back(geometry::HullOf(points));
    heap.pieces.push_back({heap.hulls.back().vertices});
  }
  return heap;
}

bool InAny(const Heap& heap, const Vector3& p, double tolerance) {
  return std::ranges::any_of(heap.hulls,
                             [&](const ConvexHull& hull) { return Contains(hull, p, tolerance); });
}

bool InAnother(const Heap& heap, std::size_t own, const Vector3& p) {
  for (std::size_t i = 0; i < heap.hulls.size(); ++i) {
    if (i != own && Contains(heap.hulls[i], p, 0)) return true;
  }
  return false;
}

// Returns the length of a segment that is in none of the other pieces, each of which covers an
// interval (Cyrus and Beck 1978).
double LengthOutside(const Heap& heap, std::size_t own, const Vector3& a, const Vector3& b) {
  std::vector<std::pair<double, double>> taken;
  for (std::size_t i = 0; i < heap.hulls.size(); ++i) {
    if (i == own) continue;
    double low = 0;
    double high = 1;
    for (const Facet& facet : heap.hulls[i].facets) {
      const double at_a = facet.normal.dot(a) - facet.offset;
      const double slope = facet.normal.dot(b - a);
      if (slope > 0) high = std::min(high, -at_a / slope);
      if (slope < 0) low = std::max(low, -at_a / slope);
    }
    if (low < high) taken.emplace_back(low, high);
  }
  std::ranges::sort(taken);
  double free = 0;
  double reached = 0;
  for (const auto& [low, high] : taken) {
    free += std::max(0.0, low - reached);
    reached = std::max(reached, high);
  }
  return (free + 1 - reached) * (b - a).norm();
}

TEST(PolyhedronTest, EdgesAndCornersOfRandomPiecesAreThoseOutsideOfTheOthers) {
  RandomStream random(kSeed, "heaps");
  for (int trial = 0; trial < 100; ++trial) {
    SCOPED_TRACE(trial);
    const Heap heap = RandomHeap(random);
    const Polyhedron outside = OutsideOf(heap.pieces);
    ExpectWellFormed(outside);
    double length = 0;
    std::size_t corners = 0;
    for (std::size_t s = 0; s < heap.hulls.size(); ++s) {
      const ConvexHull& hull = heap.hulls[s];
      for (const Vector3& p : hull.vertices) corners += InAnother(heap, s, p) ? 0 : 1;
      for (const Facet& facet : hull.facets) {
        for (std::size_t i = 0; i < facet.loop.size(); ++i) {
          const Vector3& a = hull.vertices[facet.loop[i]];
          const Vector3& b = hull.vertices[facet.loop[(i + 1) % facet.loop.size()]];
          length += LengthOutside(heap, s, a, b) / 2;  // each edge belongs to two facets
        }
      }
    }
    double found = 0;
    for (const OuterEdge& edge : outside.edges) found += LengthOf(edge);
    EXPECT_NEAR(found, length, 1e-5);
    EXPECT_EQ(outside.vertices.size(), corners);
  }
}

TEST(PolyhedronTest, EdgesOfRandomPiecesHaveSpaceOutsideAndSolidInside) {
  RandomStream random(kSeed, "heaps");
  for (int trial = 0; trial < 100; ++trial) {
    SCOPED_TRACE(trial);
    const Heap heap = RandomHeap(random);
    const Polyhedron outside = OutsideOf(heap.pieces);
    for (const OuterEdge& edge : outside.edges) {
      const Vector3 middle = (edge.start + edge.end) / 2;
      const Vector3 outward =
          outside.faces[edge.faces[0]].normal + outside.faces[edge.faces[1]].normal;
      const double step = 1e-4 * LengthOf(edge);
      EXPECT_FALSE(InAny(heap, middle, -1e-6));
      EXPECT_FALSE(InAny(heap, middle + step * outward, 0));
      EXPECT_TRUE(InAny(heap, middle - step * outward, 1e-9));
    }
    for (const OuterVertex& vertex : outside.vertices) {
      EXPECT_FALSE(InAny(heap, vertex.p, -1e-6));
    }
  }
}

struct Estimate {
  double area = 0;
  double variance = 0;
};

// Estimates by random points the area of a triangle of a facet that is in no other piece.
Estimate AreaOutside(const Heap& heap, std::size_t own, const std::array<Vector3, 3>& triangle,
                     RandomStream& random) {
  constexpr int kPoints = 1000;
  const Vector3 u = triangle[1] - triangle[0];
  const Vector3 v = triangle[2] - triangle[0];
  int outside = 0;
  for (int k = 0; k < kPoints; ++k) {
    const double x = random.Uniform();
    const double y = random.Uniform();
    const Vector3 offset = x + y < 1 ? Vector3(x * u + y * v) : Vector3((1 - x) * u + (1 - y) * v);
    outside += InAnother(heap, own, triangle[0] + offset) ? 0 : 1;
  }
  const double whole = u.cross(v).norm() / 2;
  const double share = static_cast<double>(outside) / kPoints;
  return {whole * share, whole * whole * share * (1 - share) / kPoints};
}

TEST(PolyhedronTest, AreaOfRandomPiecesAgainstSampling) {
  RandomStream random(kSeed, "areas");
  for (int trial = 0; trial < 20; ++trial) {
    SCOPED_TRACE(trial);
    const Heap heap = RandomHeap(random);
    Estimate total;
    for (std::size_t s = 0; s < heap.hulls.size(); ++s) {
      const ConvexHull& hull = heap.hulls[s];
      for (const Facet& facet : hull.facets) {
        const auto corner = [&](std::size_t i) { return hull.vertices[facet.loop[i]]; };
        for (std::size_t i = 2; i < facet.loop.size(); ++i) {
          const Estimate part = AreaOutside(heap, s, {corner(0), corner(i - 1), corner(i)}, random);
          total.area += part.area;
          total.variance += part.variance;
        }
      }
    }
    EXPECT_NEAR(SurfaceOf(OutsideOf(heap.pieces)), total.area, 4 * std::sqrt(total.variance));
  }
}

}  // namespace
}  // namespace assay::finemotion::polyhedron_test
