#include "sim/mujoco/data.h"
#include "planner/geometry/pose.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include <filesystem>
#include <limits>

namespace assay::mujoco::data_test {
namespace {

// A pile that is kept moving. Its steps depend on contacts, on the solver's start, on a weld, on
// controls and on applied forces.
constexpr char kPile[] = R"(<mujoco>
  <option timestep="0.001" cone="elliptic"/>
  <worldbody>
    <geom type="plane" size="1 1 1"/>
    <body name="a" pos="0 0 0.11"><freejoint/><geom type="box" size="0.1 0.1 0.1"/></body>
    <body name="b" pos="0.05 0 0.33" euler="10 20 30"><freejoint/>
      <geom type="box" size="0.1 0.1 0.1"/></body>
    <body name="arm" pos="0.5 0 0.3"><joint name="hinge" axis="0 1 0"/>
      <geom type="capsule" fromto="0 0 0 -0.3 0 0" size="0.03"/></body>
  </worldbody>
  <equality><weld name="weld" body1="a" body2="b" active="false" solref="0.002 1"/></equality>
  <actuator><position joint="hinge" kp="5"/></actuator>
</mujoco>)";

void Steps(Data& data, int count) {
  for (int i = 0; i < count; ++i) {
    data.ctrl()[0] = 0.001 * i;
    data.qfrc_applied()[0] = data.qfrc_bias()[14];  // depends on what Step and Restore leave behind
    data.Step();
  }
}

TEST(Data, StepsAfterRestoreAreTheStepsAfterSave) {
  const Model model = Model::FromMjcf(kPile);
  Data data(model);
  Steps(data, 150);
  const State saved = data.Save();
  Steps(data, 200);
  const State end = data.Save();
  EXPECT_GT(data.get()->ncon, 0);

  data.Restore(saved);
  EXPECT_TRUE(data.Save() == saved);
  Steps(data, 200);
  EXPECT_TRUE(data.Save() == end);

  Data other(model);
  other.Restore(saved);
  Steps(other, 200);
  EXPECT_TRUE(other.Save() == end);
}

TEST(Data, RestoresWelds) {
  const Model model = Model::FromMjcf(kPile);
  Data data(model);
  Steps(data, 150);
  data.ActivateWeldHere(model.Equality("weld"));
  const State saved = data.Save();
  Steps(data, 100);
  const State end = data.Save();
  data.Deactivate(model.Equality("weld"));
  Steps(data, 100);
  data.Restore(saved);
  EXPECT_TRUE(data.IsActive(model.Equality("weld")));
  Steps(data, 100);
  EXPECT_TRUE(data.Save() == end);
}

TEST(Data, WeldHoldsTheBodiesWhereTheyWere) {
  const Model model = Model::FromMjcf(kPile);
  Data data(model);
  const auto relative = [&] {
    return data.BodyPose(model.Body("a")).inverse() * data.BodyPose(model.Body("b"));
  };
  const geometry::Pose before = relative();
  data.ActivateWeldHere(model.Equality("weld"));
  Steps(data, 1000);
  EXPECT_LT((relative().translation() - before.translation()).norm(), 0.002);
  EXPECT_LT(geometry::AngleBetween(relative().linear(), before.linear()), 0.02);
}

TEST(Data, SimulationsOfOneModelDoNotShareTheirWelds) {
  const Model model = Model::FromMjcf(kPile);
  Data first(model);
  Data second(model);
  first.ActivateWeldHere(model.Equality("weld"));
  EXPECT_TRUE(first.IsActive(model.Equality("weld")));
  EXPECT_FALSE(second.IsActive(model.Equality("weld")));
  EXPECT_EQ(model.get()->eq_active[0], 0);
}

TEST(Data, PosesAfterAStepBelongToThePresent) {
  const Model model = Model::FromMjcf(kPile);
  Data data(model);
  Steps(data, 50);
  const geometry::Pose stepped = data.BodyPose(model.Body("b"));
  data.Forward();
  EXPECT_TRUE(stepped.isApprox(data.BodyPose(model.Body("b")), 1e-15));
}

TEST(Data, CountsTheEnginesWarnings) {
  const Model model = Model::FromMjcf(kPile);
  Data data(model);
  Steps(data, 10);
  EXPECT_THAT(data.Warnings(), testing::IsEmpty());
  data.qpos()[0] = std::numeric_limits<double>::quiet_NaN();
  data.Step();
  ASSERT_THAT(data.Warnings(), testing::SizeIs(1));
  EXPECT_GE(data.Warnings()[0].count, 1);
  EXPECT_THAT(data.Warnings()[0].text, testing::HasSubstr("QPOS"));
  EXPECT_FALSE(std::filesystem::exists("MUJOCO_LOG.TXT"));
}

TEST(DataDeathTest, AnEngineErrorStopsTheProgramWithItsMessage) {
  const Model model = Model::FromMjcf(kPile);
  EXPECT_DEATH(mju_error("the stack is full"), "the stack is full");
}

TEST(DataDeathTest, AStateOfAnotherModelIsOurMistake) {
  Data data(Model::FromMjcf(kPile));
  Data other(Model::FromMjcf("<mujoco/>"));
  EXPECT_DEATH(other.Restore(data.Save()), "another model");
}

// A box on a table. The height of the table is that of a geom.
constexpr char kTable[] = R"(<mujoco>
  <default><geom solref="0.002 1" solimp="0.99 0.9999 0.00001"/></default>
  <worldbody>
    <geom name="table" type="box" size="0.5 0.5 0.05" pos="0 0 -0.05"/>
    <body name="box" pos="0 0 0.02"><freejoint/><geom type="box" size="0.02 0.02 0.02"/></body>
  </worldbody>
</mujoco>)";

TEST(Data, HeightsOfGeomsAreOfOneSimulation) {
  const Model model = Model::FromMjcf(kTable);
  const GeomId table = model.Geom("table");
  Data first(model);
  Data second(model);
  first.SetGeomHeight(table, -0.04);
  EXPECT_EQ(first.GeomHeight(table), -0.04);
  EXPECT_EQ(second.GeomHeight(table), -0.05);
  second.qpos()[2] = first.qpos()[2] = 0.04;
  for (int i = 0; i < 500; ++i) {
    first.Step();
    second.Step();
  }
  EXPECT_NEAR(first.qpos()[2], 0.03, 1e-4) << "rests 10 mm higher";
  EXPECT_NEAR(second.qpos()[2], 0.02, 1e-4);
}

// A saved state holds the heights of geoms, and restores them into another simulation, too.
TEST(Data, StatesHoldTheHeightsOfGeoms) {
  const Model model = Model::FromMjcf(kTable);
  const GeomId table = model.Geom("table");
  Data data(model);
  data.SetGeomHeight(table, -0.045);
  data.qpos()[2] = 0.04;
  for (int i = 0; i < 100; ++i) data.Step();
  const State saved = data.Save();
  for (int i = 0; i < 100; ++i) data.Step();
  const State end = data.Save();
  data.SetGeomHeight(table, -0.05);
  EXPECT_FALSE(data.Save() == end);
  Data other(model);
  for (Data* restored : {&data, &other}) {
    restored->Restore(saved);
    EXPECT_EQ(restored->GeomHeight(table), -0.045);
    for (int i = 0; i < 100; ++i) restored->Step();
    EXPECT_TRUE(restored->Save() == end);
  }
}

// Softer contacts let a box sink deeper. A saved state holds the impedances, too.
TEST(Data, ImpedancesOfGeomsBelongToOneSimulation) {
  const Model model = Model::FromMjcf(kTable);
  const GeomId table = model.Geom("table");
  const auto sunk = [&](Data& data) {
    for (int i = 0; i < 500; ++i) data.Step();
    return 0.02 - data.qpos()[2];
  };
  Data stiff(model);
  Data soft(model);
  stiff.SetImpedance(table, 0.999);
  soft.SetImpedance(table, 0.9);
  Data restored(model);
  restored.Restore(soft.Save());
  const double of_soft = sunk(soft);
  EXPECT_GT(of_soft, 2 * sunk(stiff));
  EXPECT_EQ(sunk(restored), of_soft);
}

// A box on a turntable. The friction is ample for its centripetal acceleration of 0.3 m/s^2. If the
// engine moved the box along tangents, the box would wander outward at half of this acceleration
// times the timestep, or 0.3 mm in two seconds.
constexpr char kTurntable[] = R"(<mujoco>
  <option timestep="0.001" cone="elliptic" impratio="100" tolerance="1e-12"/>
  <default><geom solref="0.002 1" solimp="0.99 0.9999 0.00001" friction="1"/></default>
  <worldbody>
    <body name="table"><joint name="turn" axis="0 0 1" armature="1000"/>
      <geom type="box" size="0.5 0.5 0.05"/></body>
    <body name="box" pos="0.3 0 0.07"><freejoint/><geom type="box" size="0.02 0.02 0.02"/></body>
  </worldbody>
</mujoco>)";

TEST(Data, AFreeBodyGoesWithWhatCarriesIt) {
  Data data(Model::FromMjcf(kTurntable));
  data.qvel()[0] = 1;  // the table turns, and the box moves and turns with it
  data.qvel()[2] = 0.3;
  data.qvel()[6] = 1;
  data.Forward();
  const BodyId table = data.model().Body("table");
  const BodyId box = data.model().Body("box");
  const auto X_TableBox = [&] { return data.BodyPose(table).inverse() * data.BodyPose(box); };
  for (int i = 0; i < 100; ++i) data.Step();
  const geometry::Pose before = X_TableBox();
  for (int i = 0; i < 2000; ++i) data.Step();
  EXPECT_LT((X_TableBox().translation() - before.translation()).norm(), 2e-6);
  EXPECT_NEAR(data.qpos()[0], 2.1, 0.01);
}

}  // namespace
}  // namespace assay::mujoco::data_test
