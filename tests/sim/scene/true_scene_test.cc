#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "planner/geometry/pose.h"
#include "sim/scene/scene.h"
#include "tests/sim/scene/peg_and_block.h"

// Scenes whose true values differ from the problem's.
namespace assay::scene::true_scene_test {
namespace {

using geometry::Vector3;

constexpr double kPi = std::numbers::pi;

// The engine's positions, half sizes and sliding frictions for the geoms of a body.
struct Geoms {
  std::vector<Vector3> position;
  std::vector<Vector3> size;
  std::vector<double> friction;
};

Geoms GeomsOf(const Scene& scene, int body) {
  const mujoco::Data data = scene.Start();
  const mjModel& m = *data.own_model();
  Geoms geoms;
  for (int g = 0; g < m.ngeom; ++g) {
    if (m.geom_bodyid[g] != body) continue;
    geoms.position.emplace_back(m.geom_pos[3 * g], m.geom_pos[3 * g + 1], m.geom_pos[3 * g + 2]);
    geoms.size.emplace_back(m.geom_size[3 * g], m.geom_size[3 * g + 1], m.geom_size[3 * g + 2]);
    geoms.friction.push_back(m.geom_friction[3 * g]);
  }
  return geoms;
}

Geoms GeomsOf(const SceneOptions& options, domain::PartId part) {
  const Scene scene(PegAndBlock(), options);
  return GeomsOf(scene, scene.Body(part).index());
}

// The ring around the block's hole has edges along y and z. Each edge moves by the error or stays.
TEST(TrueScene, HolesAreWiderByTheErrorOfTheClearance) {
  for (const double error : {0.0002, -0.0003, -0.0006}) {
    const Geoms said = GeomsOf({}, kBlock);
    const Geoms truth = GeomsOf({.clearance_error = error}, kBlock);
    ASSERT_EQ(truth.size.size(), said.size.size());
    int moved = 0;
    for (std::size_t g = 0; g < said.size.size(); ++g) {
      for (int axis = 0; axis < 3; ++axis) {
        for (const int side : {-1, 1}) {
          const double edge = said.position[g][axis] + side * said.size[g][axis];
          const double shift = truth.position[g][axis] + side * truth.size[g][axis] - edge;
          if (std::abs(shift) < 1e-12) continue;
          EXPECT_NEAR(std::abs(shift), std::abs(error), 1e-12);
          EXPECT_NE(axis, 0);
          ++moved;
        }
      }
    }
    EXPECT_GE(moved, 4);
  }
}

// The clearance does not widen the peg's alignment hole.
TEST(TrueScene, APartWithoutWidenedHolesStaysAsItIs) {
  EXPECT_EQ(GeomsOf({.clearance_error = 0.0002}, kPeg).size, GeomsOf({}, kPeg).size);
}

TEST(TrueScene, WithoutErrorsIsTheProblem) {
  const domain::Problem problem = PegAndBlock();
  EXPECT_EQ(ToMjcf(problem, {.clearance_error = 0, .friction_error = 0, .pad_friction_error = 0}),
            ToMjcf(problem, {}));
}

TEST(TrueScene, PartsAreRougherByTheErrorOfTheFriction) {
  const double said = PegAndBlock().part(kBlock).model->friction();
  for (const domain::PartId part : {kBlock, kPeg}) {
    for (const double friction : GeomsOf({.friction_error = 0.1}, part).friction) {
      EXPECT_NEAR(friction, said + 0.1, 1e-12);
    }
    const SceneOptions both = {.part_friction = 0.6, .friction_error = -0.1};
    for (const double friction : GeomsOf(both, part).friction) EXPECT_NEAR(friction, 0.5, 1e-12);
    for (const double friction : GeomsOf({.friction_error = -1}, part).friction) {
      EXPECT_EQ(friction, 0);
    }
  }
}

std::vector<double> PadFrictions(const SceneOptions& options) {
  const Scene scene(PegAndBlock(), options);
  const mujoco::Data data = scene.Start();
  std::vector<double> frictions;
  for (const char* finger : {"gripper/finger_left", "gripper/finger_right"}) {
    const int body = scene.model().Body(finger).index();
    const Geoms geoms = GeomsOf(scene, body);
    frictions.insert(frictions.end(), geoms.friction.begin(), geoms.friction.end());
  }
  return frictions;
}

// Only the pad of each finger is rougher. It consists of four tiles.
TEST(TrueScene, PadsAreRougherByTheErrorOfTheirFriction) {
  const std::vector<double> said = PadFrictions({});
  const std::vector<double> truth = PadFrictions({.pad_friction_error = 0.2});
  const double pads = PegAndBlock().workcell->rules().pad_friction;
  ASSERT_EQ(said.size(), truth.size());
  int rougher = 0;
  for (std::size_t g = 0; g < said.size(); ++g) {
    if (said[g] == truth[g]) continue;
    EXPECT_NEAR(said[g], pads, 1e-12);
    EXPECT_NEAR(truth[g], pads + 0.2, 1e-12);
    ++rougher;
  }
  EXPECT_EQ(rougher, 2 * 4);
  EXPECT_EQ(PadFrictions({.friction_error = 0.2}), said);
}

// Returns the sliding frictions of all contacts of a block between the pads.
std::vector<double> ContactFrictions(const SceneOptions& options) {
  const Scene scene(PegAndBlock(), options);
  mujoco::Data data = scene.Start();
  const Pose X_BlockTool =
      geometry::Translation(1.5 * kInch, 0, 6.3 * kInch) * geometry::RotationY(kPi);
  scene.SetPart(data, kBlock, scene.ToolPose(data) * X_BlockTool.inverse());
  scene.SetGripper(data, 3 * kInch - 1e-5);
  data.Forward();
  std::vector<double> frictions;
  for (int c = 0; c < data.get()->ncon; ++c) {
    const mjContact& contact = data.get()->contact[c];
    for (const int geom : {contact.geom1, contact.geom2}) {
      if (data.own_model()->geom_bodyid[geom] != scene.Body(kBlock).index()) continue;
      frictions.push_back(contact.friction[0]);
    }
  }
  return frictions;
}

// Between a pad and a part, the friction of the pads counts. This is so for parts that are rougher
// than the pads and for parts that are smoother.
TEST(TrueScene, BetweenPadAndPartThePadsFrictionCounts) {
  const double pads = PegAndBlock().workcell->rules().pad_friction;
  for (const double error : {-0.1, 0.0, 0.05, 0.5}) {
    for (const double part : {0.1, 0.25, 0.6}) {
      const auto frictions = ContactFrictions({.part_friction = part, .pad_friction_error = error});
      EXPECT_GE(frictions.size(), 2u);
      for (const double friction : frictions) EXPECT_NEAR(friction, pads + error, 1e-12);
    }
  }
}

}  // namespace
}  // namespace assay::scene::true_scene_test
