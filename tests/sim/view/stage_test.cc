#include "sim/view/stage.h"

#include <gtest/gtest.h>

namespace assay::view::stage_test {
namespace {

// A wedge is drawn as the hull of its six corners, at the place of the wedge in its body, although
// the engine keeps meshes in frames of their own.
TEST(Stage, AMeshIsDrawnAsAHull) {
  const std::vector<Vector3> corners = {{0, 0, 0},    {0.03, 0, 0},    {0, 0.02, 0},
                                        {0, 0, 0.05}, {0.03, 0, 0.05}, {0, 0.02, 0.05}};
  std::string numbers;
  for (const Vector3& p : corners) {
    for (const double value : p) numbers += std::to_string(value) + " ";
  }
  const mujoco::Model model = mujoco::Model::FromMjcf(
      "<mujoco><asset><mesh name='wedge' vertex='" + numbers +
      "'/></asset><worldbody><body name='body'><freejoint/>"
      "<geom type='mesh' mesh='wedge' rgba='1 0 0 1'/><geom type='box' size='1 2 3'/>"
      "</body></worldbody></mujoco>");
  const std::vector<Body> bodies = BodiesOf(model);
  ASSERT_EQ(bodies.size(), 1u);
  ASSERT_EQ(bodies[0].shapes.size(), 2u);
  const Shape& wedge = bodies[0].shapes[0];
  EXPECT_EQ(wedge.type, "hull");
  EXPECT_EQ(wedge.color, "#ff0000");
  EXPECT_EQ(wedge.hull.facets.size(), 5u);
  ASSERT_EQ(wedge.hull.vertices.size(), corners.size());
  for (const Vector3& corner : corners) {
    double nearest = 1;
    for (const Vector3& vertex : wedge.hull.vertices) {
      nearest = std::min(nearest, (wedge.X_BodyShape * vertex - corner).norm());
    }
    EXPECT_LT(nearest, 1e-8);
  }
  EXPECT_EQ(bodies[0].shapes[1].type, "box");
  EXPECT_TRUE(bodies[0].shapes[1].hull.vertices.empty());
}

}  // namespace
}  // namespace assay::view::stage_test
