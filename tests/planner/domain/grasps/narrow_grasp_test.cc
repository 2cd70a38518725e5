#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "planner/domain/grasps/grasp.h"
#include "planner/domain/parts/part_model.h"
#include "planner/geometry/hull.h"
#include "tests/planner/domain/parts.h"

// Grasps of faces that are narrower than the pads of 16 mm.
namespace assay::domain::narrow_grasp_test {
namespace {

constexpr GraspSearch kSearch{.approach_step = 15 * kDegree, .widest = 4 * kInch};

std::shared_ptr<const PartModel> PartWith(const std::string& body) {
  return ParsePart(fmt::format(
      "format: assay-part/1\nname: narrow\ninitial: N\nunits: {{length: mm, angle: degree}}\n"
      "density: 1000\nfriction: 0.25\nsolids:\n  body: {}\n",
      body));
}

std::shared_ptr<const PartModel> Cylinder(double diameter, double length) {
  return PartWith(
      fmt::format("{{cylinder: {{from: [0, 0, 0], to: [0, 0, {}], radius: {}, sides: 64}}}}",
                  length, diameter / 2));
}

std::vector<Grasp> GraspsOf(const PartModel& part, const GraspSearch& search = kSearch) {
  return ComputeGrasps(part, ParallelJaw(), search);
}

Vector3 ApproachOf(const Grasp& grasp) { return grasp.X_PartTool.linear().col(2); }
Vector3 ClosingOf(const Grasp& grasp) { return grasp.X_PartTool.linear().col(1); }

bool IsSolid(const PartModel& part, const Vector3& p) {
  return std::ranges::any_of(part.pieces(),
                             [&](const auto& piece) { return Contains(piece, p, 0); });
}

// Returns how many of 161 x 161 points of the pads touch the part on both sides. Expects that no
// point of a pad is inside of the part.
int TouchedPoints(const PartModel& part, const Grasp& grasp) {
  constexpr int kHalf = 80;
  const Vector2 half = ParallelJaw().pad_half_extents();
  int touched = 0;
  for (int i = -kHalf; i <= kHalf; ++i) {
    for (int j = -kHalf; j <= kHalf; ++j) {
      const auto at = [&](double y) {
        return grasp.X_PartTool * Vector3(half.x() * i / kHalf, y, half.y() * j / kHalf);
      };
      const double y = grasp.width / 2;
      EXPECT_FALSE(IsSolid(part, at(y + 1e-5)) || IsSolid(part, at(-y - 1e-5)));
      if (IsSolid(part, at(y - 1e-5)) && IsSolid(part, at(1e-5 - y))) ++touched;
    }
  }
  return touched;
}

TEST(NarrowGrasp, BothPadsTouchOppositeEachOther) {
  for (const auto& part :
       {PartWith("{box: [[0, 0, 0], [8, 8, 60]]}"), PartWith("{box: [[0, 0, 0], [5, 40, 40]]}"),
        Cylinder(20, 50), Cylinder(12, 30)}) {
    const std::vector<Grasp> grasps = GraspsOf(*part);
    EXPECT_FALSE(grasps.empty());
    for (std::size_t i = 0; i < grasps.size(); i += 5) {
      EXPECT_GT(TouchedPoints(*part, grasps[i]), 100) << grasps[i].label;
      EXPECT_TRUE(grasps[i].room.fits());
    }
  }
}

// A bar is held across both pairs of its sides from all directions that are not blocked by its
// ends.
TEST(NarrowGrasp, ABarIsHeldInTheMiddleOfItsSides) {
  const auto bar = PartWith("{box: [[-4, -4, 0], [4, 4, 60]]}");
  const std::vector<Grasp> grasps = GraspsOf(*bar);
  std::map<int, int> count;
  for (const Grasp& grasp : grasps) {
    for (const int axis : {0, 1, 2}) count[axis] += std::abs(ClosingOf(grasp)[axis]) > 0.99;
    if (std::abs(ClosingOf(grasp).z()) > 0.99) continue;
    const Vector3 p = grasp.X_PartTool.inverse() * Vector3(0, 0, 0.03);
    EXPECT_NEAR(p.y(), 0, 1e-9);
  }
  EXPECT_EQ(count[0], 24);
  EXPECT_EQ(count[1], 24);
}

// Pairs of faces that are nearly parallel to each other count as one.
TEST(NarrowGrasp, OfARoundSideFewGraspsAreTaken) {
  const auto part = Cylinder(20, 50);
  std::vector<Vector3> closings;
  for (const Grasp& grasp : GraspsOf(*part)) {
    const Vector3 closing = ClosingOf(grasp);
    if (std::abs(closing.z()) > 1e-9) continue;  // from end to end
    EXPECT_NEAR(grasp.width, 0.02, 1e-9);
    EXPECT_NEAR(grasp.X_PartTool.translation().head<2>().dot(closing.head<2>()), 0, 1e-9);
    EXPECT_TRUE(std::abs(ApproachOf(grasp).z()) > 1 - 1e-9 ||
                std::abs(ApproachOf(grasp).z()) < 1e-9);
    const auto same = [&](const Vector3& other) { return other.cross(closing).norm() < 1e-6; };
    if (std::ranges::none_of(closings, same)) closings.push_back(closing);
  }
  EXPECT_GE(closings.size(), 8u);
  EXPECT_LE(closings.size(), 12u);
  for (const Vector3& a : closings) {
    for (const Vector3& b : closings) {
      const double apart = std::atan2(a.cross(b).norm(), std::abs(a.dot(b)));
      EXPECT_TRUE(apart < 1e-6 || apart > 15 * kDegree - 1e-6);
    }
  }
}

// A part that lies on a table can be taken from above: the pads end above the part's lower side.
TEST(NarrowGrasp, PadsEndBeforeALyingPartDoes) {
  for (const auto& part : {PartWith("{box: [[0, 0, 0], [60, 40, 5]]}"), Cylinder(8, 40)}) {
    const double pad = ParallelJaw().pad_half_extents().y();
    int from_above = 0;
    for (const Grasp& grasp : GraspsOf(*part)) {
      double end = -1;
      for (const Vector3& corner : part->corners()) {
        end = std::max(end, (grasp.X_PartTool.inverse() * corner).z());
      }
      if (part->name() == "narrow" && std::abs(ApproachOf(grasp).z() + 1) < 1e-9) ++from_above;
      EXPECT_GT(end, pad + 0.0009) << grasp.label;
    }
    EXPECT_GT(from_above, 0);
  }
}

TEST(NarrowGrasp, FacesThatAreTooNarrowAreMisfits) {
  const auto plate = PartWith("{box: [[0, 0, 0], [60, 40, 0.5]]}");
  for (const Grasp& grasp : GraspsOf(*plate)) EXPECT_LT(grasp.width, 0.001);
  GraspSearch search = kSearch;
  search.with_misfits = true;
  const std::vector<Grasp> all = GraspsOf(*plate, search);
  const auto lacks = [](const Grasp& g) { return !g.room.fits() && g.room.available < 0.0006; };
  EXPECT_GT(std::ranges::count_if(all, lacks), 0);
}

// Whole faces come first, so that narrow faces beside them change no label.
TEST(NarrowGrasp, ComesAfterTheGraspsOnWholeFaces) {
  const auto grasps = GraspsOf(*LoadPart("round-peg"));
  ASSERT_GT(grasps.size(), 96u);
  for (std::size_t i = 0; i < grasps.size(); ++i) {
    const bool on_shaft = std::abs(grasps[i].width - 1.5 * kInch) < 1e-6;
    EXPECT_EQ(on_shaft, i >= 96) << grasps[i].label;
  }
}

}  // namespace
}  // namespace assay::domain::narrow_grasp_test
