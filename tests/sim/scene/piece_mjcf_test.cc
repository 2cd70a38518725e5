#include "sim/scene/piece_mjcf.h"

#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include <cmath>
#include <numbers>

#include "planner/geometry/box.h"
#include "planner/geometry/hull.h"
#include "planner/geometry/solids/convex_cut.h"
#include "planner/geometry/solids/mass_properties.h"
#include "sim/mujoco/collision/convex_pieces.h"
#include "sim/mujoco/data.h"
#include "sim/mujoco/engine_messages.h"
#include "sim/mujoco/model.h"
#include "sim/scene/supporting_solids.h"

namespace assay::scene::piece_mjcf_test {
namespace {

using geometry::Box;
using geometry::ConvexHull;
using geometry::Vector3;

ConvexHull Prism(int sides, double radius, double low, double high) {
  std::vector<Vector3> corners;
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * std::numbers::pi * i / sides;
    for (const double z : {low, high}) {
      corners.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
    }
  }
  return geometry::HullOf(corners);
}

ConvexHull BoxHull(const Vector3& low, const Vector3& high) {
  return geometry::HullOf(Box::FromCorners(low, high));
}

// Returns a model in which these pieces are a falling body.
std::string BodyOf(std::span<const ConvexHull> pieces) {
  XmlElement mujoco("mujoco");
  mujoco.Add("default").Add("default").Set("class", "part").Add("geom").Set("type", "box");
  XmlElement& asset = mujoco.Add("asset");
  XmlElement& body = mujoco.Add("worldbody").Add("body").Set("name", "body");
  body.Add("freejoint");
  for (const ConvexHull& piece : pieces) {
    AddPiece(piece, "part", "piece/" + std::to_string(&piece - pieces.data()), body, asset);
  }
  return mujoco.Text();
}

TEST(Piece, ThatIsABoxIsABox) {
  const ConvexHull box = BoxHull({0, 0, 0}, {0.01, 0.02, 0.03});
  const mujoco::Model model = mujoco::Model::FromMjcf(BodyOf({&box, 1}));
  EXPECT_EQ(model.get()->nmesh, 0);
  EXPECT_EQ(model.get()->geom_type[0], mjGEOM_BOX);
  EXPECT_EQ(model.convex_pieces(), nullptr);
}

// The block with a round hole is cut as a part file says. In the engine, each piece is where it
// was, to a nanometre.
TEST(Piece, IsInTheEngineWhatItIsInTheFile) {
  for (const int sides : {16, 64, 128}) {
    std::vector<ConvexHull> pieces = geometry::Without(
        BoxHull({0.1, 0.1, 0}, {0.14, 0.15, 0.03}), geometry::HullOf([&] {
          std::vector<Vector3> corners = Prism(sides, 0.008, 0.005, 0.04).vertices;
          for (Vector3& corner : corners) corner += Vector3(0.12, 0.125, 0);
          return corners;
        }()));
    pieces.push_back(Prism(sides, 0.01, 0.1, 0.2));
    const mujoco::Model model = mujoco::Model::FromMjcf(BodyOf(pieces));
    const mujoco::Data data(model);
    for (int geom = 0; geom < model.get()->ngeom; ++geom) {
      const mjtNum* const p = data.get()->geom_xpos + 3 * geom;
      const auto R = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(
          data.get()->geom_xmat + 9 * geom);
      const ConvexHull& hull = model.convex_pieces()->SolidOf(geom)->hull;
      ASSERT_EQ(hull.vertices.size(), pieces[geom].vertices.size());
      ASSERT_EQ(hull.facets.size(), pieces[geom].facets.size());
      for (const Vector3& vertex : hull.vertices) {
        const Vector3 in_body = R * vertex + Vector3(p[0], p[1], p[2]);
        double nearest = 1;
        for (const Vector3& own : pieces[geom].vertices) {
          nearest = std::min(nearest, (own - in_body).norm());
        }
        EXPECT_LT(nearest, 5e-9);
      }
    }
  }
}

// Other programs load the model without a warning, and the body falls freely.
TEST(Piece, IsLoadedByThePlainEngine) {
  std::vector<ConvexHull> pieces =
      geometry::Without(BoxHull({-0.02, -0.02, 0}, {0.02, 0.02, 0.03}), Prism(128, 0.008, 0, 0.04));
  mujoco::HandleEngineMessages();
  const mujoco::Model model = mujoco::Model::FromMjcf(BodyOf(pieces));
  const std::unique_ptr<mjData, void (*)(mjData*)> data(mj_makeData(model.get()), mj_deleteData);
  while (data->time < 0.1) mj_step(model.get(), data.get());
  for (int i = 0; i < mjNWARNING; ++i) EXPECT_EQ(data->warning[i].number, 0);
  EXPECT_TRUE(mujoco::TakeEngineWarnings().empty());
  EXPECT_NEAR(data->qpos[2], -9.81 * 0.1 * 0.1 / 2, 1e-3);
}

TEST(SupportingSolids, AreTheHullUnlessAllPiecesAreBoxes) {
  const std::vector<ConvexHull> boxes = {BoxHull({0, 0, 0}, {0.01, 0.02, 0.03}),
                                         BoxHull({0.01, 0, 0}, {0.02, 0.02, 0.03})};
  const ConvexHull around = BoxHull({0, 0, 0}, {0.02, 0.02, 0.03});
  const auto merged = SupportingSolids(boxes, around);
  ASSERT_EQ(merged.size(), 1u);
  EXPECT_NEAR(geometry::Volume(merged[0]), 0.02 * 0.02 * 0.03, 1e-15);

  const std::vector<ConvexHull> mixed = {boxes[0], Prism(16, 0.01, 0, 0.03)};
  std::vector<Vector3> points = mixed[0].vertices;
  points.insert(points.end(), mixed[1].vertices.begin(), mixed[1].vertices.end());
  const ConvexHull hull = geometry::HullOf(points);
  const auto supporting = SupportingSolids(mixed, hull);
  ASSERT_EQ(supporting.size(), 1u);
  EXPECT_EQ(supporting[0].vertices.size(), hull.vertices.size());
}

}  // namespace
}  // namespace assay::scene::piece_mjcf_test
