#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planner/geometry/pose.h"
#include "sim/execution/walk/executor.h"
#include "tests/planner/plan/actions.h"
#include "tests/sim/execution/channel.h"
#include "tests/sim/execution/figure15.h"
#include "tests/sim/execution/trace/trace_schema.h"

namespace assay::execution::look_test {
namespace {

using noise::Effect;
using noise::Noise;

constexpr plan::StepId kAssemble(0);
constexpr plan::StepId kPickup(1);
constexpr plan::StepId kLook(2);

// The plan of Spar's figure 15 after a look at the peg by a camera that measures no heights.
class Looking : public testing::Test {
 protected:
  Looking() : problem_(Figure15()), peg_(PartNamed(problem_, "peg")), plan_(TwoActions(problem_)) {
    plan_.steps[kAssemble.index()].executed = 3;
    plan_.steps[kPickup.index()].executed = 2;
    const plan::Place place = plan_.step(kPickup).action.place;
    plan_.steps.push_back({"action_3", plan::Sense(peg_, "coarse-camera", place), 3, 1});
  }

  static const scene::Scene& scene() {
    static const scene::Scene scene(Figure15(), {});
    return scene;
  }
  // Executes the plan up to a step, with the peg displaced from its believed pose.
  Trace RunTo(plan::StepId last, const Noise& noise, sense::PoseSensor* sensor = nullptr) {
    mujoco::Data data = StartOf(problem_, scene(), {});
    const Pose X_WorldPeg = Turned(scene().TruePose(data, peg_), 0.03, {0.002, -0.0015, 0});
    scene().SetPart(data, peg_, X_WorldPeg);
    ExecutorOptions options{.sample_rate = 0, .noise = noise, .last = last};
    options.sensor = sensor;
    return Execute(problem_, plan_, scene(), data, options);
  }
  static Pose Turned(const Pose& pose, double yaw, const Vector3& displacement) {
    Pose turned = geometry::RotationZ(yaw) * pose;
    turned.translation() = pose.translation() + displacement;
    return turned;
  }
  // Returns the error of the true pose relative to the measured one: the displacement along the
  // world's axes, and the yaw.
  static std::pair<Vector3, double> Error(const LookRecord& look) {
    const geometry::Matrix3 turn = look.before.truth.linear() * look.measured.linear().transpose();
    EXPECT_NEAR(turn(2, 2), 1, 1e-12) << "only about the vertical";
    return {look.before.truth.translation() - look.measured.translation(),
            std::atan2(turn(1, 0), turn(0, 0))};
  }

  domain::Problem problem_;
  PartId peg_;
  plan::Plan plan_;
};

// Each channel of the sensor moves the measured pose by what was drawn. The error is the true pose
// less the measured one.
TEST_F(Looking, EachChannelOfTheSensorAlone) {
  for (int i = 0; i < 4; ++i) {
    std::vector<double> values(4, 0);
    values[i] = i < 3 ? 0.0003 : 0.004;
    const Trace trace = RunTo(kLook, FourErrors(Effect::kSensedX, kLook, values));
    const auto looks = trace.All<LookRecord>();
    ASSERT_EQ(looks.size(), 1u);
    const auto [displacement, yaw] = Error(*looks[0]);
    EXPECT_LT((displacement - Vector3(values[0], values[1], values[2])).norm(), 1e-12) << i;
    EXPECT_NEAR(yaw, values[3], 1e-12) << i;
  }
}

// The camera measures no heights, and a look does not change tilts.
TEST_F(Looking, WhatItMeasuresIsBelieved) {
  const Noise noise = FourErrors(Effect::kSensedX, kLook, {0.0002, -0.0003, 0.0001, 0.002});
  const Trace trace = RunTo(kLook, noise);
  const LookRecord& look = *trace.All<LookRecord>().at(0);
  EXPECT_TRUE(look.before.believed.isApprox(problem_.part(peg_).X_WorldPart, 1e-15));
  const Vector3 truth = look.before.truth.translation();
  const double z = look.before.believed.translation().z();
  EXPECT_TRUE(look.believed.translation().isApprox(
      Vector3(truth.x() - 0.0002, truth.y() + 0.0003, z), 1e-12));
  const Pose expected = geometry::RotationZ(0.03 - 0.002) * look.before.believed;
  EXPECT_LT(geometry::AngleBetween(look.believed.linear(), expected.linear()), 1e-4);
  EXPECT_TRUE(look.believed.linear().row(2).isApprox(look.before.believed.linear().row(2), 1e-12))
      << "turned about the vertical only";
  EXPECT_EQ(trace.end().snapshot.parts[peg_.index()].believed.matrix(), look.believed.matrix());
}

// The overhead camera measures heights as well, and they are used.
TEST_F(Looking, HeightsThatAreMeasuredAreBelieved) {
  plan_.steps[kLook.index()].action.sensor = "overhead-camera";
  const Noise noise = FourErrors(Effect::kSensedX, kLook, {0, 0, 0.0001, 0});
  const LookRecord look = *RunTo(kLook, noise).All<LookRecord>().at(0);
  EXPECT_NEAR(look.believed.translation().z(), look.before.truth.translation().z() - 0.0001, 1e-12);
}

// A coordinate that is known better than the sensor measures it keeps its believed value.
TEST_F(Looking, TakesOnlyWhatItKnowsBetter) {
  plan::ErrorSet known;
  known.part = peg_;
  known.x = {-1e-4, 1e-4};
  known.y = {-0.003, 0.003};
  known.z = {-0.003, 0.003};
  known.theta = {-1e-4, 1e-4};
  plan_.steps[kLook.index()].certificate.before = {known};
  const LookRecord look = *RunTo(kLook, {}).All<LookRecord>().at(0);
  const Vector3 believed = look.before.believed.translation();
  EXPECT_EQ(look.believed.translation(),
            Vector3(believed.x(), look.before.truth.translation().y(), believed.z()));
  EXPECT_TRUE(look.believed.linear().isApprox(look.before.believed.linear(), 1e-12));
}

// After the look, the hand goes to the believed pose of the part and finds it there.
TEST_F(Looking, LaterCommandsGoToTheBelievedPlace) {
  const Noise noise = FourErrors(Effect::kSensedX, kLook, {0.0002, -0.0003, 0, 0.002});
  const Trace trace = RunTo(kPickup, noise);
  ASSERT_EQ(trace.end().outcome, TrialOutcome::kSucceeded) << trace.end().reason;
  const Pose& believed = trace.All<LookRecord>().at(0)->believed;
  const auto& pickup = plan_.step(kPickup).action;
  for (const Milestone* milestone : trace.All<Milestone>()) {
    if (milestone->step != kPickup || milestone->stage != Stage::kReached) continue;
    const Pose told = believed * pickup.hold.X_PartTool;
    EXPECT_TRUE(milestone->snapshot.tool.believed.isApprox(told, 1e-9));
    EXPECT_LT((milestone->snapshot.tool.truth.translation() - told.translation()).norm(), 5e-5);
  }
  EXPECT_TRUE(trace.All<GraspFact>().at(0)->holds());
}

// A sensor that gives a fixed answer and records what it was asked.
class FalseSensor : public sense::PoseSensor {
 public:
  explicit FalseSensor(std::optional<Pose> answer) : answer_(std::move(answer)) {}
  std::optional<Pose> Measure(const mujoco::Data&, PartId part, const Pose& believed) override {
    asked.emplace_back(part, believed);
    return answer_;
  }
  std::vector<std::pair<PartId, Pose>> asked;

 private:
  std::optional<Pose> answer_;
};

// A real sensor is asked, and the drawn noise does not change its answer.
TEST_F(Looking, ASensorIsAskedWithWhatIsBelieved) {
  const Pose& X_WorldPeg = problem_.part(peg_).X_WorldPart;
  const Pose told = Turned(X_WorldPeg, 0.01, {0.001, 0.002, 0});
  FalseSensor sensor(told);
  const Noise noise = FourErrors(Effect::kSensedX, kLook, {0.1, 0.1, 0.1, 0.1});
  const Trace trace = RunTo(kLook, noise, &sensor);
  ASSERT_EQ(sensor.asked.size(), 1u);
  EXPECT_EQ(sensor.asked[0].first, peg_);
  EXPECT_EQ(sensor.asked[0].second.matrix(), X_WorldPeg.matrix());
  EXPECT_EQ(trace.All<LookRecord>().at(0)->measured.matrix(), told.matrix());
  EXPECT_TRUE(trace.All<LookRecord>().at(0)->believed.isApprox(told, 1e-12));
}

TEST_F(Looking, APartThatIsNotFoundEndsTheExecution) {
  FalseSensor sensor(std::nullopt);
  const Trace trace = RunTo(kAssemble, {}, &sensor);
  EXPECT_EQ(trace.end().outcome, TrialOutcome::kNotFound);
  EXPECT_EQ(trace.end().reason, "action_3: coarse-camera does not find peg");
  const LookRecord& look = *trace.All<LookRecord>().at(0);
  EXPECT_FALSE(look.found);
  EXPECT_EQ(look.believed.matrix(), look.before.believed.matrix());
  EXPECT_THAT(SchemaErrors(trace), testing::IsEmpty());
}

}  // namespace
}  // namespace assay::execution::look_test
