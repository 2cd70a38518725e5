#include "planner/kinematics/meshes/mesh_pieces.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/base/random.h"
#include "planner/geometry/solids/mass_properties.h"

namespace assay::kinematics::mesh_pieces_test {
namespace {

using geometry::ConvexHull;
using geometry::Vector2;
using geometry::Vector3;
using ::testing::SizeIs;
using Surface = std::vector<SurfaceTriangle>;

constexpr std::uint64_t kSeed = 31;

// A prism over a polygon that all points of the polygon see from the origin, or over a U. `sides`
// are the triangles of the bottom, counter-clockwise.
struct Prism {
  std::vector<Vector2> corners;
  std::vector<std::array<int, 3>> triangles;
  double height = 1;

  Surface SurfaceOf() const {
    Surface surface;
    const auto at = [&](int corner, double z) {
      const Vector2& p = corners[static_cast<std::size_t>(corner)];
      return Vector3(p.x(), p.y(), z);
    };
    for (const auto& [a, b, c] : triangles) {
      surface.push_back({at(a, 0), at(c, 0), at(b, 0)});
      surface.push_back({at(a, height), at(b, height), at(c, height)});
    }
    const int count = static_cast<int>(corners.size());
    for (int i = 0; i < count; ++i) {
      const int next = (i + 1) % count;
      surface.push_back({at(i, 0), at(next, 0), at(next, height)});
      surface.push_back({at(i, 0), at(next, height), at(i, height)});
    }
    return surface;
  }
  bool Contains(const Vector3& p) const {
    if (p.z() < 0 || p.z() > height) return false;
    return std::ranges::any_of(triangles, [&](const auto& triangle) {
      for (std::size_t i = 0; i < 3; ++i) {
        const Vector2& a = corners[static_cast<std::size_t>(triangle[i])];
        const Vector2& b = corners[static_cast<std::size_t>(triangle[(i + 1) % 3])];
        const Vector2 side = b - a;
        const Vector2 to = p.head<2>() - a;
        if (side.x() * to.y() - side.y() * to.x() < 0) return false;
      }
      return true;
    });
  }
};

double VolumeOf(const std::vector<ConvexHull>& pieces) {
  double volume = 0;
  for (const ConvexHull& piece : pieces) volume += geometry::Volume(piece);
  return volume;
}

bool AnyContains(const std::vector<ConvexHull>& pieces, const Vector3& p) {
  return std::ranges::any_of(
      pieces, [&](const ConvexHull& piece) { return geometry::Contains(piece, p, 1e-9); });
}

TEST(ConvexPieces, AConvexSolidIsOnePiece) {
  const Prism box{{{0, 0}, {2, 0}, {2, 1}, {0, 1}}, {{0, 1, 2}, {0, 2, 3}}};
  const auto pieces = ConvexPiecesOf(box.SurfaceOf());
  ASSERT_THAT(pieces, SizeIs(1));
  EXPECT_NEAR(VolumeOf(pieces), 2, 1e-9);
}

// The walls of the U are a quarter of its width.
TEST(ConvexPieces, AChannelIsCutExactly) {
  const Prism channel{{{0, 0}, {4, 0}, {4, 4}, {3, 4}, {3, 1}, {1, 1}, {1, 4}, {0, 4}},
                      {{0, 1, 4}, {0, 4, 5}, {1, 2, 3}, {1, 3, 4}, {0, 5, 6}, {0, 6, 7}},
                      2};
  const auto pieces = ConvexPiecesOf(channel.SurfaceOf());
  EXPECT_NEAR(VolumeOf(pieces), 20, 1e-6);
  EXPECT_LE(pieces.size(), 4U);
}

TEST(ConvexPieces, ContainTheSolid) {
  RandomStream random(kSeed, "mesh pieces");
  for (int i = 0; i < 30; ++i) {
    Prism star;
    star.height = random.Uniform(0.2, 2);
    const int tips = 3 + random.Index(5);
    star.corners.push_back(Vector2::Zero());
    for (int k = 0; k < 2 * tips; ++k) {
      const double angle = std::numbers::pi * k / tips;
      const double radius = k % 2 == 0 ? random.Uniform(0.6, 1) : random.Uniform(0.1, 0.6);
      star.corners.push_back(radius * Vector2(std::cos(angle), std::sin(angle)));
      star.triangles.push_back({0, 1 + k, 1 + (k + 1) % (2 * tips)});
    }
    Prism outline = star;  // its sides are those of the star, without the centre
    outline.corners.erase(outline.corners.begin());
    outline.triangles.clear();
    Surface surface = outline.SurfaceOf();
    for (const SurfaceTriangle& triangle : star.SurfaceOf()) {
      const bool is_flat = triangle[0].z() == triangle[1].z() && triangle[1].z() == triangle[2].z();
      if (is_flat) surface.push_back(triangle);
    }
    const auto pieces = ConvexPiecesOf(surface);
    EXPECT_LE(pieces.size(), 8U);
    int inside = 0;
    for (int k = 0; k < 500; ++k) {
      const Vector3 p(random.Uniform(-1, 1), random.Uniform(-1, 1), random.Uniform(0, star.height));
      if (!star.Contains(p)) continue;
      ++inside;
      EXPECT_TRUE(AnyContains(pieces, p)) << "seed " << kSeed << ", case " << i;
    }
    EXPECT_GT(inside, 20);
    for (const SurfaceTriangle& triangle : surface) {
      EXPECT_TRUE(AnyContains(pieces, (triangle[0] + triangle[1] + triangle[2]) / 3));
    }
  }
}

// A solid of the cubes of a grid. Its surface has the faces between full and empty cubes.
class GridSolid {
 public:
  GridSolid(double share, RandomStream& random) {
    for (bool& cube : full_) cube = random.Uniform() < share;
  }
  bool IsFull(int x, int y, int z) const {
    const auto inside = [](int i) { return i >= 0 && i < kSide; };
    return inside(x) && inside(y) && inside(z) &&
           full_[static_cast<std::size_t>((x * kSide + y) * kSide + z)];
  }
  bool Contains(const Vector3& p) const {
    return IsFull(static_cast<int>(std::floor(p.x())), static_cast<int>(std::floor(p.y())),
                  static_cast<int>(std::floor(p.z())));
  }
  Surface SurfaceOf() const {
    Surface surface;
    for (int i = 0; i < kSide * kSide * kSide; ++i) {
      const std::array<int, 3> cube = {i / kSide / kSide, i / kSide % kSide, i % kSide};
      if (!IsFull(cube[0], cube[1], cube[2])) continue;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        for (const int side : {-1, 1}) AddFace(cube, axis, side, surface);
      }
    }
    return surface;
  }
  static constexpr int kSide = 5;

 private:
  void AddFace(const std::array<int, 3>& cube, std::size_t axis, int side, Surface& surface) const {
    std::array<int, 3> next = cube;
    next[axis] += side;
    if (IsFull(next[0], next[1], next[2])) return;
    const Vector3 low(cube[0], cube[1], cube[2]);
    const Vector3 along = Vector3::Unit(static_cast<int>(axis));
    const Vector3 u = Vector3::Unit(static_cast<int>((axis + 1) % 3));
    const Vector3 v = Vector3::Unit(static_cast<int>((axis + 2) % 3));
    const Vector3 a = low + (side > 0 ? along : Vector3::Zero());
    if (side > 0) {
      surface.push_back({a, a + u, a + u + v});
      surface.push_back({a, a + u + v, a + v});
    } else {
      surface.push_back({a, a + u + v, a + u});
      surface.push_back({a, a + v, a + u + v});
    }
  }

  std::array<bool, kSide* kSide* kSide> full_ = {};
};

TEST(ConvexPieces, ContainSolidsWithDentsInAllDirections) {
  RandomStream random(kSeed, "grid solids");
  int cut = 0;
  for (int i = 0; i < 40; ++i) {
    const GridSolid solid(random.Uniform(0.1, 0.9), random);
    const auto pieces = ConvexPiecesOf(solid.SurfaceOf());
    cut += pieces.size() > 1 ? 1 : 0;
    for (int k = 0; k < 400; ++k) {
      const Vector3 p(random.Uniform(0, GridSolid::kSide), random.Uniform(0, GridSolid::kSide),
                      random.Uniform(0, GridSolid::kSide));
      if (!solid.Contains(p)) continue;
      EXPECT_TRUE(AnyContains(pieces, p)) << "seed " << kSeed << ", case " << i;
    }
  }
  EXPECT_GT(cut, 5);
}

}  // namespace
}  // namespace assay::kinematics::mesh_pieces_test
