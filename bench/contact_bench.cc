#include <benchmark/benchmark.h>
#include <mujoco/mujoco.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "planner/geometry/box.h"
#include "planner/geometry/hull.h"
#include "planner/geometry/pose.h"
#include "sim/mujoco/data.h"
#include "sim/mujoco/model.h"
#include "sim/scene/piece_mjcf.h"
#include "sim/scene/xml_element.h"

// Steps of a peg that stands in its hole and leans against the wall.
namespace assay::scene {
namespace {

using geometry::ConvexHull;
using geometry::Vector3;

constexpr double kApothem = 0.008;
constexpr double kClearance = 1e-4;
constexpr double kOuter = 0.02;
constexpr double kDepth = 0.03;
constexpr double kHeight = 0.05;

Vector3 Corner(int sides, double apothem, double number, double z) {
  const double radius = apothem / std::cos(std::numbers::pi / sides);
  const double angle = 2 * std::numbers::pi * (number + 0.5) / sides;
  return {radius * std::cos(angle), radius * std::sin(angle), z};
}

ConvexHull Prism(int sides, double apothem, double low, double high) {
  std::vector<Vector3> corners;
  for (int i = 0; i < sides; ++i) {
    for (const double z : {low, high}) corners.push_back(Corner(sides, apothem, i, z));
  }
  return geometry::HullOf(corners);
}

// The block: a wedge for each side of the hole, and the floor.
std::vector<ConvexHull> Block(int sides) {
  std::vector<ConvexHull> pieces = {Prism(sides, kOuter, -0.01, 0)};
  for (int i = 0; i < sides; ++i) {
    std::vector<Vector3> corners;
    for (const double apothem : {kApothem + kClearance, kOuter}) {
      for (const int number : {i, i + 1}) {
        for (const double z : {0.0, kDepth}) corners.push_back(Corner(sides, apothem, number, z));
      }
    }
    pieces.push_back(geometry::HullOf(corners));
  }
  return pieces;
}

// An octagonal peg and its hole as boxes, for which the engine has its own collision.
std::vector<ConvexHull> BoxPeg() {
  std::vector<ConvexHull> pieces;
  for (int i = 0; i < 4; ++i) {
    geometry::Box box{
        geometry::Translation(0, 0, kHeight / 2) * geometry::RotationZ(i * std::numbers::pi / 4),
        {}};
    box.half_extents = {kApothem, kApothem * std::tan(std::numbers::pi / 8), kHeight / 2};
    pieces.push_back(geometry::HullOf(box));
  }
  return pieces;
}
std::vector<ConvexHull> BoxBlock() {
  std::vector<ConvexHull> pieces = {
      geometry::HullOf(geometry::Box::FromCorners({-kOuter, -kOuter, -0.01}, {kOuter, kOuter, 0}))};
  const double inner = kApothem + kClearance;
  for (int i = 0; i < 8; ++i) {
    geometry::Box box{geometry::RotationZ(i * std::numbers::pi / 4) *
                          geometry::Translation((inner + kOuter) / 2, 0, kDepth / 2),
                      {}};
    box.half_extents = {(kOuter - inner) / 2, kOuter * std::tan(std::numbers::pi / 8), kDepth / 2};
    pieces.push_back(geometry::HullOf(box));
  }
  return pieces;
}

void AddBody(const std::string& name, const std::vector<ConvexHull>& pieces, XmlElement& body,
             XmlElement& asset) {
  for (const ConvexHull& piece : pieces) {
    AddPiece(piece, "part", name + "/" + std::to_string(&piece - pieces.data()), body, asset);
  }
}

mujoco::Model PegInBlock(const std::vector<ConvexHull>& peg, const std::vector<ConvexHull>& block) {
  XmlElement mujoco("mujoco");
  mujoco.Add("option")
      .Set("timestep", 0.0005)
      .Set("solver", "Newton")
      .Set("cone", "elliptic")
      .Set("impratio", 10)
      .Set("gravity", {2, 0.5, -9.5});
  mujoco.Add("size").Set("njmax", "2000").Set("nconmax", "600");
  mujoco.Add("default")
      .Add("default")
      .Set("class", "part")
      .Add("geom")
      .Set("type", "box")
      .Set("solref", "0.0001 1")
      .Set("solimp", "0.99 0.9999 0.00001")
      .Set("friction", {0.3, 0, 0});
  XmlElement& asset = mujoco.Add("asset");
  XmlElement& world = mujoco.Add("worldbody");
  AddBody("block", block, world, asset);
  XmlElement& body = world.Add("body");
  body.Add("freejoint");
  AddBody("peg", peg, body, asset);
  return mujoco::Model::FromMjcf(mujoco.Text());
}

void TimeSteps(const mujoco::Model& model, benchmark::State& state) {
  mujoco::Data data(model);
  while (data.time() < 0.5) data.Step();
  for (auto _ : state) data.Step();
  state.counters["contacts"] = data.get()->ncon;
  if (data.HasWarnings()) state.SkipWithError("the engine warns");
}

void RoundPeg(benchmark::State& state) {
  const int sides = static_cast<int>(state.range(0));
  TimeSteps(PegInBlock({Prism(sides, kApothem, 0, kHeight)}, Block(sides)), state);
}
BENCHMARK(RoundPeg)->Name("StepOfPegInRingOf")->Arg(8)->Arg(16)->Arg(32)->Arg(64)->Arg(128);

void OctagonOfBoxes(benchmark::State& state) { TimeSteps(PegInBlock(BoxPeg(), BoxBlock()), state); }
BENCHMARK(OctagonOfBoxes)->Name("StepOfPegOfBoxesInRingOf8");

void Compile(benchmark::State& state) {
  const int sides = static_cast<int>(state.range(0));
  const ConvexHull peg = Prism(sides, kApothem, 0, kHeight);
  const std::vector<ConvexHull> block = Block(sides);
  for (auto _ : state) benchmark::DoNotOptimize(PegInBlock({peg}, block));
}
BENCHMARK(Compile)->Name("ModelOfPegInRingOf")->Arg(32)->Arg(128)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace assay::scene
