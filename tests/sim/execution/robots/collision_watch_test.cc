#include "sim/execution/robots/collision_watch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/sim/execution/figure15.h"

namespace assay::execution::collision_watch_test {
namespace {

using testing::IsEmpty;
using testing::SizeIs;

constexpr PartId kBlock(0);
constexpr PartId kPeg(1);

class CollisionWatchTest : public testing::Test {
 protected:
  std::vector<std::string> Names(const std::vector<Collision>& collisions) const {
    std::vector<std::string> names;
    for (const Collision& collision : collisions) {
      names.push_back(data_.model().Name(collision.robot) + " " +
                      data_.model().Name(collision.other));
    }
    return names;
  }
  void PutBlockOnto(const char* body) {
    scene_.SetPart(data_, kBlock, data_.BodyPose(scene_.model().Body(body)));
  }

  const domain::Problem problem_ = Figure15();
  const scene::Scene scene_{problem_, {}};
  mujoco::Data data_ = scene_.Start();
  CollisionWatch watch_{scene_};
};

TEST_F(CollisionWatchTest, NothingIsTouchedAtTheStart) {
  EXPECT_THAT(watch_.Look(data_), IsEmpty());
}

// The arm may not touch a part even if the hand may. Each pair is reported once.
TEST_F(CollisionWatchTest, TellsWhatTheArmTouches) {
  watch_.Handle({kBlock});
  PutBlockOnto("arm/forearm");
  EXPECT_THAT(Names(watch_.Look(data_)), testing::Contains("arm/forearm part/block"));
  EXPECT_THAT(watch_.Look(data_), IsEmpty());
}

TEST_F(CollisionWatchTest, AHandTouchesWhatItHandlesAndNothingElse) {
  PutBlockOnto("gripper/finger_left");
  watch_.Handle({kBlock});
  EXPECT_THAT(Names(watch_.Look(data_)),
              testing::Not(testing::Contains("gripper/finger_left part/block")));
  watch_.Handle({kPeg});
  EXPECT_THAT(Names(watch_.Look(data_)), testing::Contains("gripper/finger_left part/block"));
}

// The block lies on the table, and the peg is put into the block. A held part may touch what it
// touches when it is taken. In the next action, the part may no longer touch this.
TEST_F(CollisionWatchTest, AHeldPartTouchesWhereItIsTakenFromAndNothingElse) {
  watch_.Handle({kBlock}, HeldTouches::kNothing);
  EXPECT_THAT(watch_.Look(data_), IsEmpty());
  EXPECT_THAT(watch_.Look(data_, kBlock), IsEmpty());
  EXPECT_THAT(watch_.Look(data_, kBlock), IsEmpty());
  scene_.SetPart(data_, kPeg, data_.BodyPose(scene_.Body(kBlock)));
  const auto is_of_peg = [](const std::string& pair) { return pair.find("peg") != pair.npos; };
  EXPECT_THAT(Names(watch_.Look(data_, kBlock)), testing::ElementsAre(testing::Truly(is_of_peg)));
  watch_.Handle({kBlock}, HeldTouches::kTables);
  EXPECT_THAT(watch_.Look(data_, kBlock), IsEmpty());
  watch_.Handle({kBlock}, HeldTouches::kNothing);
  EXPECT_THAT(Names(watch_.Look(data_, kBlock)), SizeIs(1));  // the table
}

// Steps of assembly plans slide parts into each other, so a held part may touch anything by
// default.
TEST_F(CollisionWatchTest, AHeldPartMayTouchAnythingIfNothingElseIsSaid) {
  EXPECT_THAT(watch_.Look(data_, kPeg), IsEmpty());
  scene_.SetPart(data_, kPeg, data_.BodyPose(scene_.Body(kBlock)));
  EXPECT_THAT(watch_.Look(data_, kPeg), IsEmpty());
}

}  // namespace
}  // namespace assay::execution::collision_watch_test
