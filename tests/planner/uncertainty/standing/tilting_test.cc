#include "planner/uncertainty/standing/tilting.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

#include "planner/domain/parts/part_model.h"
#include "tests/planner/uncertainty/part_on_table.h"

namespace assay::uncertainty::tilting_test {
namespace {

// A block that is tilted about a corner of its lower side, so that nothing of it is below the
// table, moves the grasped point by no more than the bound. Some blocks use most of the bound.
TEST(MovedByTilt, BoundsTheWayAboutEachCornerOfTheSupport) {
  const domain::Problem problem = UprightBlock({});
  const UncertainWorld world(problem, Propagation::kSound);
  const Pose& X_WorldPart = world.X_WorldPart(kBlock);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> share(-1, 1);
  double most_of_bound = 0;
  for (int i = 0; i < 2000; ++i) {
    plan::Hold hold = HoldFromAbove(problem, Vector3::UnitY());
    hold.X_PartTool.rotate(Eigen::AngleAxisd(1.2 * share(random), Vector3::UnitY()));
    hold.X_PartTool.translation() += 0.03 * Vector3(share(random), share(random), share(random));
    const Pose X_WorldTool = X_WorldPart * hold.X_PartTool;
    const double tilt = 1e-3 * share(random);
    const Vector3 bound = MovedByTilt(world, kBlock, hold, std::abs(tilt), 0);
    const Vector3 axis =
        Vector3::UnitZ().cross(X_WorldTool.linear().col(2).cross(Vector3::UnitZ()));
    const Eigen::AngleAxisd turn(tilt, axis.normalized());
    for (const Vector3& corner : problem.part(kBlock).model->corners()) {
      const Vector3 about = X_WorldPart * corner;
      if (std::abs(about.z()) > 1e-9) continue;
      const auto moved = [&](const Vector3& p) -> Vector3 { return turn * (p - about) + about; };
      bool stands = true;
      for (const Vector3& other : problem.part(kBlock).model->corners())
        stands = stands && moved(X_WorldPart * other).z() > -1e-9;
      if (!stands) continue;
      const Vector3 grasped = X_WorldTool.translation();
      const Vector3 way = X_WorldTool.linear().transpose() * (moved(grasped) - grasped);
      EXPECT_TRUE((way.cwiseAbs().array() <= bound.array() * (1 + 1e-3) + 1e-9).all())
          << way.transpose() << " beyond " << bound.transpose();
      most_of_bound = std::max(most_of_bound, std::abs(way.x()) / bound.x());
    }
  }
  EXPECT_GT(most_of_bound, 0.9);
}

}  // namespace
}  // namespace assay::uncertainty::tilting_test
