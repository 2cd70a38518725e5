#include <gtest/gtest.h>

#include "planner/domain/problem/problem_file.h"
#include "planner/geometry/solids/mass_properties.h"
#include "sim/scene/scene.h"
#include "tests/sim/scene/peg_and_block.h"

namespace assay::scene::two_tables_test {
namespace {

const domain::Problem& TwoCans() {
  static const domain::Problem problem = domain::ReadProblem(
      Document::Load(ASSAY_SOURCE_DIR "/scenarios/two-cans.yaml"), ModelsFolder());
  return problem;
}

// Lets a can go a millimetre above the tables' plane. Returns its height after a quarter of a
// second, in metres.
double HeightOfCanLetGo(const Scene& scene, mujoco::Data& data, double y) {
  const PartId can(0);
  Pose X_WorldCan = scene.TruePose(data, can);
  X_WorldCan.translation() = Vector3(0.6, y, 0.001);
  scene.SetPart(data, can, X_WorldCan);
  while (data.time() < 0.25) data.Step();
  return scene.TruePose(data, can).translation().z();
}

double HeightOfCanLetGo(double y) {
  const Scene scene(TwoCans(), {});
  mujoco::Data data = scene.Start();
  return HeightOfCanLetGo(scene, data, y);
}

TEST(TwoTables, BothCarryAndTheGapDoesNot) {
  EXPECT_NEAR(HeightOfCanLetGo(-0.4), 0, 1e-4);
  EXPECT_NEAR(HeightOfCanLetGo(0.4), 0, 1e-4);
  EXPECT_LT(HeightOfCanLetGo(0), -0.2);  // free fall by 0.5 * 9.81 * 0.25^2 = 0.31 m
}

TEST(TwoTables, AreAsHighAsIsSaidUnderEachPart) {
  const Scene scene(TwoCans(), {});
  mujoco::Data data = scene.Start();
  scene.SetTableHeight(data, PartId(0), 0.0005);
  EXPECT_NEAR(scene.TableHeight(data, PartId(0)), 0.0005, 1e-12);
  EXPECT_NEAR(scene.TableHeight(data, PartId(1)), 0, 1e-12);
  EXPECT_NEAR(HeightOfCanLetGo(scene, data, 0.4), 0.0005, 1e-4);
}

// The hidden mass of a part is distributed like its own mass.
TEST(HiddenMass, IsTheEnginesMass) {
  const Scene said(TwoCans(), {});
  const Scene truth(TwoCans(), {.part_masses = {{PartId(1), 0.42}}});
  EXPECT_DOUBLE_EQ(said.TrueMass(PartId(0)), TwoCans().parts[0].model->mass().mass);
  EXPECT_DOUBLE_EQ(truth.TrueMass(PartId(0)), said.TrueMass(PartId(0)));
  EXPECT_DOUBLE_EQ(truth.TrueMass(PartId(1)), 0.42);
}

}  // namespace
}  // namespace assay::scene::two_tables_test
