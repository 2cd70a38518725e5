#include "planner/finemotion/forces/friction_limit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace assay::finemotion::friction_limit_test {
namespace {

using PoseChange = Eigen::Matrix<double, kPoseDimensions, 1>;

PrimitiveContact ContactAt(const Vector3& normal, const Vector3& at) {
  PrimitiveContact contact;
  contact.normal = normal;
  contact.at = at;
  contact.row.resize(kPoseDimensions);
  contact.row.head<3>() = normal;
  contact.row.tail<3>() = at.cross(normal);
  return contact;
}

PoseChange Shift(const Vector3& d) {
  PoseChange z = PoseChange::Zero();
  z.head<3>() = d;
  return z;
}

TEST(FrictionLimit, WithoutContactsOrWithOneNothingHolds) {
  EXPECT_EQ(FrictionLimit({}, Shift(Vector3::UnitX())), kGreatestFriction);
  EXPECT_EQ(FrictionLimit({ContactAt(Vector3::UnitZ(), Vector3::Zero())}, Shift(Vector3::UnitX())),
            kGreatestFriction);
}

// The walls of a groove have normals at an angle t from its plane of symmetry. Both press the part
// out with a cos(t), and the friction of each can take back f a sin(t). From f = cot(t) on, no
// force is left that shows what the walls bear. For walls that face each other this holds from 0
// on. The friction cones are pyramids with eight sides about the true cones.
TEST(FrictionLimit, WallsOfAGrooveHoldFromTheCotangentOfTheirAngle) {
  for (const double degrees : {30.0, 45.0, 60.0, 75.0, 89.0}) {
    const double t = degrees * std::numbers::pi / 180;
    const auto wall = [&](double sign) {
      return ContactAt({std::cos(t), sign * std::sin(t), 0}, Vector3::Zero());
    };
    const double limit = FrictionLimit({wall(1), wall(-1)}, Shift(Vector3::UnitZ()));
    EXPECT_LT(limit, 1.01 / std::tan(t)) << degrees;
    EXPECT_GT(limit, 0.99 * std::cos(std::numbers::pi / 8) / std::tan(t)) << degrees;
    EXPECT_TRUE(CanHold({wall(1), wall(-1)}, Shift(Vector3::UnitZ()), 1.01 * limit));
  }
}

TEST(FrictionLimit, WithoutFrictionNothingHoldsButWhatIsMovedAgainst) {
  const std::vector<PrimitiveContact> walls = {ContactAt(Vector3::UnitX(), Vector3::Zero()),
                                               ContactAt(Vector3::UnitY(), Vector3::Zero())};
  EXPECT_FALSE(CanHold(walls, Shift(Vector3::UnitZ()), 0));
}

}  // namespace
}  // namespace assay::finemotion::friction_limit_test
