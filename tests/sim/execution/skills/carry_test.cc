#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planner/geometry/pose.h"
#include "sim/execution/interpretation/knowledge_scenario.h"
#include "sim/execution/skills/skill.h"
#include "sim/execution/walk/executor.h"
#include "tests/sim/execution/two_cans.h"

namespace assay::execution::carry_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;

const PartId kCan(0);
const PartId kOtherCan(1);
const PartId kPost(2);
const plan::Hold kFromAbove = {
    .grasp = "from above",
    .X_PartTool = geometry::PoseFromColumns({1, 0, 0}, {0, -1, 0}, {0, 0, -1}, {0, 0, 0.09}),
    .width = 0.06};

// The arm is at its home, and the world model says that it holds a can from above. Nothing is in
// the hand in the simulation, because a skill acts on believed poses only.
class Carry : public testing::Test {
 protected:
  Carry()
      : loaded_(TwoCans({}, "post")),
        problem_(loaded_.scenario.problem),
        scene_(problem_, {}),
        data_(StartOf(problem_, scene_, {})),
        robots_(problem_, scene_, data_, options_) {
    robots_.acting().world().Take(kCan, kFromAbove);
  }

  void Believe(PartId part, double x, double y, double z = 0) {
    robots_.acting().world().Believe(part, geometry::Translation(x, y, z));
  }
  // Returns why the skill fails. Empty means that it succeeds.
  std::string FailureOf(const std::string& action) {
    Situation situation{.robots = robots_,
                        .readings = readings_,
                        .sensor_noise = random_,
                        .color_sensor = nullptr,
                        .pose_sensor = nullptr};
    const Progress failure =
        loaded_.interpretation.skills.at(action)->Do({.part = kCan}, situation);
    return failure ? failure->reason : "";
  }

  const KnowledgeScenario loaded_;
  const domain::Problem& problem_;
  const scene::Scene scene_;
  const ExecutorOptions options_ = {.sample_rate = 0};
  mujoco::Data data_;
  Robots robots_;
  Readings readings_;
  RandomStream random_{1, "carry"};
};

// The post stands beside the middle of the second table, on the side of the robot. The held can has
// room at the middle, but the forearm has no room above the post. A carry that ends there cannot be
// followed by a putdown.
TEST_F(Carry, EndsWhereWhatIsHeldCanBePutDown) {
  Believe(kPost, 0.45, 0.32);
  EXPECT_THAT(FailureOf("transfer"), IsEmpty());
  EXPECT_THAT(FailureOf("ungrasp"), IsEmpty());
}

TEST_F(Carry, NamesThePairThatIsTooNearAtTheStart) {
  const geometry::Vector3 held =
      robots_.acting().world().PartPose(kCan, robots_.acting().BelievedTool()).translation();
  Believe(kOtherCan, held.x() + 0.07, held.y(), held.z());  // 10 mm away
  EXPECT_THAT(FailureOf("transfer"),
              AllOf(HasSubstr("no way to a free place on second-table for can1: at the start, "),
                    HasSubstr("can1"), HasSubstr("can2"), HasSubstr("nearer than 15.0 mm")));
}

}  // namespace
}  // namespace assay::execution::carry_test
