#include "sim/execution/control/awaited_contact.h"

#include <gtest/gtest.h>

namespace assay::execution::awaited_contact_test {
namespace {

constexpr double kTimestep = 5e-4;  // seconds
const ControlLaw kLaw;

// Returns the contact after these forces have acted for so long that their averages are equal to
// them. The last force is that of the awaited contact.
AwaitedContact After(const Eigen::VectorXd& forces, double seeming = 0) {
  AwaitedContact contact(static_cast<int>(forces.size()) - 1, seeming, kLaw);
  for (double time = 0; time < 10 * kLaw.touch_filter; time += kTimestep)
    contact.Feel(forces, kTimestep);
  return contact;
}

TEST(AwaitedContact, ThatBearsEnoughIsMade) {
  EXPECT_TRUE(After(Eigen::Vector2d(kLaw.pressing_force, 1.1 * kLaw.touching_force)).IsMade());
  EXPECT_FALSE(After(Eigen::Vector2d(kLaw.pressing_force, 0.9 * kLaw.touching_force)).IsMade());
}

// Two contacts share the pressing force like the ends of a lever. The awaited contact counts as
// made when it bears more than half of the force. More cannot be demanded, because the contacts may
// be near each other.
TEST(AwaitedContact, ThatBearsMoreThanWhatIsKeptIsMade) {
  for (const double share : {0.3, 0.45, 0.55, 0.7}) {
    const Eigen::Vector2d forces(1 - share, share);
    EXPECT_EQ(After(kLaw.pressing_force * forces).IsMade(), share > 0.5) << share;
  }
}

TEST(AwaitedContact, ThatFrictionMaySeemToBeIsNotMade) {
  const double seeming = 2.5;
  const double less = kLaw.first_touching_force + seeming - 0.1;
  EXPECT_FALSE(After(Eigen::Vector2d(0.1, less), seeming).IsMade());
  EXPECT_TRUE(After(Eigen::Vector2d(0.1, less + 0.2), seeming).IsMade());
}

TEST(AwaitedContact, InFreeSpaceIsToldByALittleForce) {
  using One = Eigen::Matrix<double, 1, 1>;
  EXPECT_FALSE(After(One(0.9 * kLaw.first_touching_force)).IsMade());
  EXPECT_TRUE(After(One(1.1 * kLaw.first_touching_force)).IsMade());
}

TEST(AwaitedContact, IsNotMadeByAnImpactOfATimestep) {
  AwaitedContact contact(1, 0, kLaw);
  contact.Feel(Eigen::Vector2d(0, 5 * kLaw.touching_force), kTimestep);
  EXPECT_FALSE(contact.IsMade());
}

TEST(AwaitedContact, IsApartWhileNothingOfItIsFelt) {
  EXPECT_TRUE(After(Eigen::Vector2d(kLaw.pressing_force, 0.1)).IsApart());
  EXPECT_FALSE(After(Eigen::Vector2d(1, 2)).IsApart());
}

// A kept contact whose load the awaited one takes over must not be lifted, so the motion slows
// down. It never stops.
TEST(AwaitedContact, LeavesTheMotionThePaceOfWhatKeptContactsStillBear) {
  EXPECT_DOUBLE_EQ(After(Eigen::Vector2d(1.2 * kLaw.pressing_force, 0)).Pace(), 1);
  EXPECT_NEAR(After(Eigen::Vector2d(0.5 * kLaw.pressing_force, 2)).Pace(), 0.5, 1e-12);
  const double least = After(Eigen::Vector2d(0, 4)).Pace();
  EXPECT_GT(least, 0);
  EXPECT_LT(least, 0.2);
  EXPECT_EQ(After(Eigen::Matrix<double, 1, 1>(0.5)).Pace(), 1);
}

}  // namespace
}  // namespace assay::execution::awaited_contact_test
