#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "planner/geometry/box.h"
#include "planner/geometry/pose.h"
#include "sim/mujoco/contact.h"
#include "sim/mujoco/data.h"
#include "sim/mujoco/model.h"
#include "tests/sim/mujoco/convex_bodies.h"

// Experiments with convex pieces: they rest, slide and fall as bodies do.
namespace assay::mujoco::convex_physics_test {
namespace {

using geometry::RotationX;
using geometry::RotationZ;
using geometry::Translation;

constexpr double kPi = std::numbers::pi;
constexpr double kGravity = 9.81;

// The top of the table is at height 0.
ConvexBody Table() {
  return {.name = "table",
          .pieces = {},
          .boxes = {geometry::Box::FromCorners({-0.5, -0.5, -0.05}, {0.5, 0.5, 0})},
          .is_free = false};
}

// Returns the pose of a body of these pieces that is turned and stands on a plane of this height.
Pose Standing(const std::vector<Points>& pieces, const Pose& turn, double height = 0) {
  double lowest = 1e9;
  for (const Points& points : pieces) {
    for (const Vector3& p : points) lowest = std::min(lowest, (turn * p).z());
  }
  return Translation(0, 0, height - lowest) * turn;
}

void Simulate(Data& data, double seconds) {
  const double end = data.time() + seconds;
  while (data.time() < end) data.Step();
  ASSERT_FALSE(data.HasWarnings()) << data.Warnings().front().text;
}

// Returns how far the body has moved and turned (radians times 1 cm) since it had this pose.
double MovedSince(const Pose& before, const Pose& now) {
  return (now.translation() - before.translation()).norm() +
         0.01 * geometry::AngleBetween(before.linear(), now.linear());
}

// Bodies may sink in by some tenths of a micrometre in the first 50 ms. After that, they must keep
// still for two seconds.
void ExpectStill(const std::vector<ConvexBody>& bodies) {
  const Model model = Model::FromMjcf(ModelOf(bodies));
  Data data(model);
  Simulate(data, 0.05);
  std::vector<Pose> before;
  for (const ConvexBody& body : bodies) before.push_back(data.BodyPose(model.Body(body.name)));
  double greatest = 0;
  while (data.time() < 2.05) {
    Simulate(data, 0.01);
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      const BodyId body = model.Body(bodies[i].name);
      greatest = std::max(greatest, MovedSince(before[i], data.BodyPose(body)));
    }
  }
  EXPECT_LT(greatest, 1e-5);
  testing::Test::RecordProperty("moved", fmt::format("{}", greatest));
}

struct Solid {
  const char* name;
  std::vector<Points> pieces;
  Pose turn = Pose::Identity();
};

void PrintTo(const Solid& solid, std::ostream* out) { *out << solid.name; }

// A hull that stands on a triangle.
const Points kWedge = {
    {-0.02, -0.01, 0}, {0.02, -0.012, 0}, {0.001, 0.02, 0}, {0.002, 0, 0.03}, {-0.01, 0.003, 0.02}};

std::vector<Points> BlockWithRoundHole() { return Ring(32, 0.0081, 0.02, 0, 0.03); }

const std::vector<Solid> kSolids = {
    {"hexagonal", {Prism(6, 0.008, 0, 0.04)}},
    {"of16Sides", {Prism(16, 0.008, 0, 0.04)}},
    {"of64Sides", {Prism(64, 0.008, 0, 0.04)}},
    {"hexagonalOnItsSide", {Prism(6, 0.008, 0, 0.04)}, RotationX(kPi / 2) * RotationZ(kPi / 6)},
    {"of16SidesOnItsSide", {Prism(16, 0.008, 0, 0.04)}, RotationX(kPi / 2)},
    {"of64SidesOnItsSide", {Prism(64, 0.008, 0, 0.04)}, RotationX(kPi / 2)},
    {"wedge", {kWedge}},
    {"blockWithRoundHole", BlockWithRoundHole()},
    {"blockWithRoundHoleOnItsSide", BlockWithRoundHole(), RotationX(kPi / 2)},
};

class ConvexSolid : public testing::TestWithParam<Solid> {};

TEST_P(ConvexSolid, KeepsStillOnATable) {
  const Solid& solid = GetParam();
  for (const double yaw : {0.0, 0.4}) {
    const Pose X = RotationZ(yaw) * Standing(solid.pieces, solid.turn);
    ExpectStill({Table(), {.name = "solid", .pieces = solid.pieces, .X_World = X}});
  }
}

TEST_P(ConvexSolid, KeepsStillOnTopOfAPrism) {
  const Solid& solid = GetParam();
  const std::vector<Points> base = {Prism(16, 0.03, 0, 0.02)};
  ExpectStill({Table(),
               {.name = "base", .pieces = base},
               {.name = "solid",
                .pieces = solid.pieces,
                .X_World = RotationZ(0.2) * Standing(solid.pieces, solid.turn, 0.02)}});
}

TEST_P(ConvexSolid, KeepsStillOnTopOfARing) {
  const Solid& solid = GetParam();
  const std::vector<Points> ring = Ring(32, 0.0041, 0.03, 0, 0.02);
  ExpectStill({Table(),
               {.name = "ring", .pieces = ring},
               {.name = "solid",
                .pieces = solid.pieces,
                .X_World = RotationZ(0.2) * Standing(solid.pieces, solid.turn, 0.02)}});
}

// Coulomb's law: a body of any shape that slides at a speed v stops after v^2 / (2 mu g).
TEST_P(ConvexSolid, StopsAsFrictionSays) {
  constexpr double kFriction = 0.15;  // so small that nothing tips over
  constexpr double kSpeed = 0.3;
  const Solid& solid = GetParam();
  const Model model = Model::FromMjcf(
      ModelOf({Table(),
               {.name = "solid",
                .pieces = solid.pieces,
                .X_World = Translation(-0.05, 0, 0) * Standing(solid.pieces, solid.turn)}},
              {.friction = kFriction}));
  Data data(model);
  Simulate(data, 0.05);
  const Pose before = data.BodyPose(model.Body("solid"));
  data.qvel()[1] = kSpeed;
  data.Forward();
  Simulate(data, 0.5);
  const Vector3 way = data.BodyPose(model.Body("solid")).translation() - before.translation();
  constexpr double kWay = kSpeed * kSpeed / (2 * kFriction * kGravity);
  EXPECT_NEAR(way.y(), kWay, 0.01 * kWay);
  EXPECT_LT(std::hypot(way.x(), way.z()), 0.01 * kWay);
}

INSTANTIATE_TEST_SUITE_P(Solids, ConvexSolid, testing::ValuesIn(kSolids),
                         [](const auto& solid) { return std::string(solid.param.name); });

// Gravity is tilted instead of the table. Below the angle of friction the body holds, above it the
// body is accelerated by g (sin - mu cos).
TEST(ConvexPhysics, ASlopeHoldsUpToTheAngleOfFriction) {
  constexpr double kFriction = 0.3;
  for (const double angle : {0.9 * std::atan(kFriction), 1.3 * std::atan(kFriction)}) {
    const std::vector<Points> prism = {Prism(16, 0.02, 0, 0.01)};
    const Model model = Model::FromMjcf(
        ModelOf({Table(), {.name = "prism", .pieces = prism}},
                {.friction = kFriction,
                 .gravity = kGravity * Vector3(std::sin(angle), 0, -std::cos(angle))}));
    Data data(model);
    Simulate(data, 0.3);
    const double along = kGravity * (std::sin(angle) - kFriction * std::cos(angle));
    const double way = along > 0 ? along * 0.3 * 0.3 / 2 : 0;
    EXPECT_NEAR(data.BodyPose(model.Body("prism")).translation().x(), way, 0.03 * way + 1e-5);
  }
}

double EnergyOf(const Data& data) { return data.get()->energy[0] + data.get()->energy[1]; }

// A peg that is let go over its hole falls in and rests on the floor of the hole. It never gains
// energy.
TEST(ConvexPhysics, APegFallsIntoItsHole) {
  constexpr double kApothem = 0.008;
  constexpr double kClearance = 1e-4;
  constexpr double kDepth = 0.03;
  for (const int sides : {32, 64}) {
    std::vector<Points> block = Ring(sides, kApothem + kClearance, 0.02, 0, kDepth);
    block.push_back(Prism(sides, 0.02, -0.01, 0));
    for (const double aside : {0.0, 0.9e-4}) {
      const Model model =
          Model::FromMjcf(ModelOf({{.name = "block", .pieces = block, .is_free = false},
                                   {.name = "peg",
                                    .pieces = {Prism(sides, kApothem, 0, 0.05)},
                                    .X_World = Translation(aside, 0.3 * aside, kDepth + 0.001)}},
                                  {.friction = 0.1}));
      Data data(model);
      double energy = EnergyOf(data);
      const double scale = energy;
      while (data.time() < 1) {
        data.Step();
        EXPECT_LT(EnergyOf(data), energy + 1e-3 * scale) << "at " << data.time();
        energy = std::min(energy, EnergyOf(data));
      }
      const Pose at_rest = data.BodyPose(model.Body("peg"));
      EXPECT_NEAR(at_rest.translation().z(), 0, 2e-6) << sides << " sides, aside " << aside;
      EXPECT_LT(at_rest.translation().head<2>().norm(), 1.5 * kClearance);
      Simulate(data, 1);
      EXPECT_LT(MovedSince(at_rest, data.BodyPose(model.Body("peg"))), 1e-6);
    }
  }
}

// A regular octagonal prism is also the union of four boxes, for which the engine has collisions of
// its own.
TEST(ConvexPhysics, AnOctagonIsAsItsBoxesAre) {
  constexpr double kApothem = 0.01;
  std::vector<geometry::Box> boxes;
  for (int i = 0; i < 4; ++i) {
    geometry::Box box{Translation(0, 0, 0.02) * RotationZ(i * kPi / 4), {}};
    box.half_extents = {kApothem, kApothem * std::tan(kPi / 8), 0.02};
    boxes.push_back(box);
  }
  std::array<double, 2> ways{};
  std::array<double, 2> depths{};
  for (const bool as_hull : {false, true}) {
    ConvexBody octagon{.name = "octagon", .pieces = {}};
    if (as_hull) {
      octagon.pieces = {Prism(8, kApothem, 0, 0.04)};
    } else {
      octagon.boxes = boxes;
    }
    const Model model = Model::FromMjcf(ModelOf({Table(), octagon}));
    Data data(model);
    Simulate(data, 0.2);
    depths[as_hull] = data.BodyPose(model.Body("octagon")).translation().z();
    data.qvel()[0] = 0.3;
    data.Forward();
    Simulate(data, 0.5);
    ways[as_hull] = data.BodyPose(model.Body("octagon")).translation().x();
  }
  EXPECT_NEAR(ways[0], ways[1], 0.01 * ways[0]);
  EXPECT_NEAR(depths[0], depths[1], 1e-7);
}

}  // namespace
}  // namespace assay::mujoco::convex_physics_test
