#pragma once

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "planner/base/input_files/document.h"
#include "planner/domain/problem/problem_file.h"
#include "planner/geometry/pose.h"
#include "planner/plan/data/plan.h"
#include "tests/planner/plan/actions.h"

// Spar's peg and block, and plans that were written by hand.
namespace assay::plan {

using geometry::Vector3;

constexpr double kInch = 0.0254;
constexpr double kDegree = M_PI / 180;
constexpr PartId kBlock(0);
constexpr PartId kPeg(1);
constexpr MatingId kPegIntoBlock(0);

// The poses of the parts as text of a scenario, in inches and degrees.
struct Start {
  std::string block = "{stable: on-back, at: [24, 6], yaw: 0}";
  std::string peg = "{stable: on-side, at: [24, -8], yaw: 90}";
  std::string other_parts = "";  // further parts as whole lines of the scenario
  std::string sensing = "";      // names of sensors
  std::string goals =
      "  - assembled: {held: peg, fixed: block, features: [[7, 8], [7, 8]],\n"
      "                pose: {columns: [[-1, 0, 0], [0, 1, 0], [0, 0, -1], [3, 0, 3.25]]},\n"
      "                mating_vector: [-4, 0, 0]}\n";
};

inline domain::Problem PegAndBlock(const Start& start) {
  const std::string scenario = fmt::format(
      "format: assay-scenario/1\n"
      "units: {{length: inch, angle: degree}}\n"
      "workcell: puma762-table\n"
      "parts:\n"
      "  block: {{model: block, pose: {}}}\n"
      "  peg: {{model: peg, pose: {}}}\n"
      "{}"
      "sensing: [{}]\n"
      "goal:\n{}",
      start.block, start.peg, start.other_parts, start.sensing, start.goals);
  return domain::ReadProblem(Document::Parse(scenario, "peg-and-block.yaml"),
                             ASSAY_SOURCE_DIR "/models");
}

// The tool at point `p` of a part (inches), with its approach and closing directions in the frame
// of the part.
struct ToolInPart {
  Vector3 p;
  Vector3 approach;
  Vector3 closing;
  double width = 0;  // inches
};

inline Hold HoldWith(const std::string& grasp, const ToolInPart& tool) {
  const Vector3 z = tool.approach.normalized();
  return {grasp, geometry::PoseFromColumns(tool.closing.cross(z), tool.closing, z, tool.p * kInch),
          tool.width * kInch};
}

// Returns a hold across the plate, on its upper and lower sides. When the peg is over the hole, the
// tool leans by `angle` from the direction of the shaft, towards -y.
inline Hold PlateHold(double angle) {
  return HoldWith("across the plate", {.p = {-0.5, 0, 0},
                                       .approach = {std::cos(angle), -std::sin(angle), 0},
                                       .closing = Vector3::UnitZ(),
                                       .width = 3});
}

// Returns a hold across the sides of the block. The tool leans 45 degrees both when the block
// stands on its end and when it lies on its back.
inline Hold BlockHold() {
  return HoldWith(
      "across the block",
      {.p = {2, 0, 5.5}, .approach = {-1, 0, -1}, .closing = Vector3::UnitY(), .width = 3});
}

inline Place PlaceNow(const domain::Problem& problem, PartId part) {
  return {"initial", problem.part(part).X_WorldPart};
}

// The place of the block on its back, with its origin at (x, y), metres. Its z axis points along
// the table's -x axis, turned by yaw (radians).
struct OnBack {
  double x = 0.6;
  double y = 0;
  double yaw = -M_PI / 2;
};
inline Place BlockOnBack(const OnBack& at) {
  return {"BP2", geometry::Translation(at.x, at.y, 0) * geometry::RotationZ(at.yaw) *
                     geometry::RotationY(-M_PI / 2)};
}

inline Plan WithNumbers(const domain::Problem& problem, std::vector<Action> in_order_of_execution) {
  Plan plan;
  plan.problem = problem.name;
  int number = 0;
  for (Action& action : in_order_of_execution) {
    ++number;
    plan.steps.push_back({fmt::format("action_{}", number), std::move(action), number, number});
    if (number > 1) plan.ordering.emplace_back(StepId(number - 2), StepId(number - 1));
  }
  return plan;
}

// Returns a plan for figure 15, where the block lies on its back already. It has two actions. The
// assemble action is inserted first, as in the listings of the paper.
inline Plan TwoSteps(const domain::Problem& problem) {
  const Hold hold = PlateHold(45 * kDegree);
  return {.problem = problem.name,
          .steps = {{"action_1", Assemble(kPegIntoBlock, hold, PlaceNow(problem, kBlock)), 1, 2},
                    {"action_2", Pickup(kPeg, hold, PlaceNow(problem, kPeg)), 2, 1}},
          .ordering = {{StepId(1), StepId(0)}}};
}

// Returns the start of figure 14, where the block stands on its end.
inline Start BlockOnEnd() { return {.block = "{stable: on-end, at: [24, 6], yaw: 0}"}; }

inline Plan FourSteps(const domain::Problem& problem) {
  const Place back = BlockOnBack({});
  const Hold hold = PlateHold(45 * kDegree);
  return WithNumbers(
      problem,
      {Pickup(kBlock, BlockHold(), PlaceNow(problem, kBlock)), Putdown(kBlock, BlockHold(), back),
       Pickup(kPeg, hold, PlaceNow(problem, kPeg)), Assemble(kPegIntoBlock, hold, back)});
}

}  // namespace assay::plan
