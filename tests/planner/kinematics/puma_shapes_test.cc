#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "planner/base/random.h"
#include "planner/geometry/hull.h"
#include "planner/kinematics/urdf_model.h"

namespace assay::kinematics::puma_shapes_test {
namespace {

using geometry::Vector3;

constexpr double kRounding = 1e-9;

struct Holds {
  const Vector3& p;
  bool operator()(const BoxShape& box) const {
    return (2 * p.cwiseAbs() - box.size).maxCoeff() <= kRounding;
  }
  bool operator()(const CylinderShape& cylinder) const {
    return 2 * std::abs(p.z()) <= cylinder.length + kRounding &&
           p.head<2>().norm() <= cylinder.radius + kRounding;
  }
  bool operator()(const SphereShape& sphere) const { return p.norm() <= sphere.radius + kRounding; }
  bool operator()(const HullShape& shape) const {
    return geometry::Contains(*shape.hull, p, kRounding);
  }
};

struct DrawIn {
  RandomStream& random;
  Vector3 operator()(const BoxShape& box) const { return Cube().cwiseProduct(box.size / 2); }
  Vector3 operator()(const CylinderShape& cylinder) const {
    const double angle = random.Uniform(-M_PI, M_PI);
    return {cylinder.radius * std::cos(angle), cylinder.radius * std::sin(angle),
            random.Uniform(-0.5, 0.5) * cylinder.length};
  }
  Vector3 operator()(const SphereShape& sphere) const {
    return sphere.radius * Cube().normalized();
  }
  Vector3 operator()(const HullShape& shape) const {
    const auto& corners = shape.hull->vertices;
    return corners[static_cast<std::size_t>(random.Index(static_cast<int>(corners.size())))];
  }
  Vector3 Cube() const {
    return {random.Uniform(-1, 1), random.Uniform(-1, 1), random.Uniform(-1, 1)};
  }
};

// The drawn shapes of the arm lie within its collision shapes.
TEST(PumaShapes, CollisionsHoldWhatIsDrawn) {
  const RobotModel arm =
      ReadUrdf(std::string(ASSAY_SOURCE_DIR) + "/models/robots/puma762/puma762.urdf");
  RandomStream random(17, "points of shapes");
  for (const Link& link : arm.links) {
    for (const Visual& visual : link.visuals) {
      for (int i = 0; i < 1000; ++i) {
        const Vector3 p_Link = visual.X_LinkShape * std::visit(DrawIn{random}, visual.shape);
        EXPECT_TRUE(std::ranges::any_of(link.collisions,
                                        [&](const Collision& collision) {
                                          const Vector3 p =
                                              collision.X_LinkShape.inverse() * p_Link;
                                          return std::visit(Holds{p}, collision.shape);
                                        }))
            << link.name << ", " << visual.name;
      }
    }
  }
}

}  // namespace
}  // namespace assay::kinematics::puma_shapes_test
