#include "sim/render/ghost.h"

#include <gtest/gtest.h>

#include <numbers>

#include "planner/domain/parts/part_file.h"
#include "planner/domain/problem/problem_file.h"
#include "planner/geometry/pose.h"

namespace assay::render::ghost_test {
namespace {

constexpr double kInch = 0.0254;

double TotalLength(const std::vector<Edge>& edges) {
  double sum = 0;
  for (const Edge& edge : edges) sum += (edge.to - edge.from).norm();
  return sum;
}

std::shared_ptr<const domain::PartModel> Peg() {
  return domain::PartFile::Load(ASSAY_SOURCE_DIR "/models/parts/peg/part.yaml", 0);
}

// The peg is two boxes with a seam, and one of them has a hole. All lengths are in inches. The
// plate is 1 by 3 by 3 and has 8 edges of length 3 and 4 edges of length 1. The shaft has 8 edges
// of 1.5, including those at the plate, and 4 of 2.75. The hole is 0.25 by 0.25 and 1 deep and has
// 8 edges of 0.25 and 4 of 1. Seams between boxes are no edges. Each edge counts twice because it
// belongs to two faces.
TEST(EdgesOf, AreThoseOfTheWholePart) {
  const double length = (8 * 3 + 4 * 1) + (8 * 1.5 + 4 * 2.75) + (8 * 0.25 + 4 * 1);
  EXPECT_NEAR(TotalLength(EdgesOf(*Peg())), 2 * length * kInch, 1e-6);
}

TEST(EdgesOf, LieInThePlaneOfTheirFace) {
  for (const Edge& edge : EdgesOf(*Peg())) {
    EXPECT_NEAR(edge.normal.norm(), 1, 1e-12);
    EXPECT_NEAR(edge.normal.dot(edge.to - edge.from), 0, 1e-12);
  }
}

TEST(Edge, FacesTowardsWhoIsBeforeItsFace) {
  const Edge edge{{0, 0, 1}, {1, 0, 1}, {0, 0, 1}};
  EXPECT_TRUE(edge.FacesTowards({5, 5, 1.1}));
  EXPECT_FALSE(edge.FacesTowards({0, 0, 0.9}));
}

TEST(GhostOf, StandsAtThePose) {
  const std::vector<Edge> edges = EdgesOf(*Peg());
  const Pose pose = geometry::Translation(1, 2, 3) * geometry::RotationZ(std::numbers::pi / 2);
  const Ghost ghost = GhostOf(*Peg(), pose, kPredicted);
  ASSERT_EQ(ghost.edges.size(), edges.size());
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const auto turned = [](const Vector3& p) { return Vector3(-p.y(), p.x(), p.z()); };
    EXPECT_NEAR((ghost.edges[i].to - turned(edges[i].to) - Vector3(1, 2, 3)).norm(), 0, 1e-12);
    EXPECT_NEAR((ghost.edges[i].normal - turned(edges[i].normal)).norm(), 0, 1e-12);
  }
}

TEST(Colour, IsReadAsPagesWriteIt) {
  EXPECT_EQ(Colour{"#4c9bd8"}.Rgb(), (std::array<std::uint8_t, 3>{0x4c, 0x9b, 0xd8}));
}

}  // namespace
}  // namespace assay::render::ghost_test
