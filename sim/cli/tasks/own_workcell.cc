#include "sim/cli/tasks/own_workcell.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numbers>

namespace assay::cli {
namespace {

// What follows the description of the arm and of the table in a workcell's file.
constexpr const char* kUsualRules = R"(
rules:
  tool_lean: 60            # of the tool's axis from straight down
  approach_step: 15        # between approach directions of a pair of faces
  approach_distance: 0.08  # of the straight line along the tool's axis
  safe_height: {safe_height:.2f}        # of the tool, for travel
  friction: 0.25           # of mating surfaces
  pad_friction: 0.15
  grip_force: 100          # newtons
  part_gap: 0.015          # to leave free beside a part that is put down
  contact_allowance: 0.0001
  pad_margin: 0.001        # contact points stay so far inside the edges of the pads
  guarded_travel: 0.008    # of a descent before and beyond the height that is expected
  lateral_compliance: 0    # of the wrist in a mating: rigid

# Where parts may be put down: a grid of places, nearest to the preferred point first, and at each
# place so many yaws from 0 on.
placements: {{x: [{low_x:.3f}, {high_x:.3f}], y: [-{half:.3f}, {half:.3f}], step: {step:.3f}, yaws: 12, nearest_to: [{x:.3f}, 0]}}

# A sensor's error is a promise. `assay calibrate` measures what a camera can promise.
sensors:
  overhead-camera:
    description: a camera that looks down on the whole table
    error: {{x: 0.0003, y: 0.0003, z: 0.0001, theta: 0.2}}

verifications:
  gripper-opening: {{after: pickup, measures: gripper-opening, tolerance: 0.001, below: missed, above: wrong}}
  landed: {{after: putdown, measures: tool-height, tolerance: 0.002, below: off, above: off}}
  seated: {{after: assemble, measures: tool-height, tolerance: 0.002, below: off, above: unseated}}

recoveries:
  missed: {{strategy: groping-search, radius: 0.010, pitch: 0.003}}    # nothing was grasped
  wrong: {{strategy: call-operator}}                                  # something else was grasped
  off: {{strategy: call-operator}}                                    # the part is not where it should be
  unseated: {{strategy: groping-search, radius: 0.004, pitch: 0.001}}  # stopped before it was seated
)";

// Returns a text as YAML, whatever characters it has.
std::string YamlText(const std::string& text) { return nlohmann::json(text).dump(); }

std::string LinksText(const OwnArm& own) {
  const auto& [base, flange, locked] = own.arm;
  std::string text;
  if (!base.empty() || !flange.empty()) {
    text += fmt::format("  links: {{base: {}, flange: {}}}\n", YamlText(base), YamlText(flange));
  }
  for (const auto& [joint, value] : locked) {
    text += fmt::format("  locked: {{{}: {:.6g}}}  # this joint of seven does not move\n",
                        YamlText(joint), value * 180 / std::numbers::pi);
  }
  if (!own.packages.empty()) {
    text += fmt::format("  packages: {}\n", nlohmann::json(own.packages).dump());
  }
  return text;
}

}  // namespace

std::string WorkcellText(const OwnArm& own, const domain::ArmSite& site) {
  constexpr double kBeyond = 0.15;   // metres of table around the square
  constexpr double kMostStep = 0.1;  // metres between placements
  const geometry::Vector3 base = site.X_WorldBase.translation();
  const kinematics::JointVector home = site.home * 180 / std::numbers::pi;
  const double side = site.half_side;
  std::string text = fmt::format(
      "format: assay-workcell/1\n"
      "description: {} with a parallel-jaw gripper beside a table\n"
      "units: {{length: m, angle: degree}}\n\n"
      "# The world's x axis points from the arm to the table, whose top is at z = 0.\n"
      "robot:\n  urdf: {}\n{}"
      "  base: {{columns: [[1, 0, 0], [0, 1, 0], [0, 0, 1], [{:.4g}, {:.4g}, {:.4f}]]}}\n"
      "  home: [{:.4f}]  # the tool points straight down over the middle of the placements\n"
      "  acceleration: [150, 150, 150, 300, 300, 300]  # per second squared\n\n"
      "gripper: {{urdf: {}}}\n\n"
      "table: {{x: [{:.3f}, {:.3f}], y: [-{:.3f}, {:.3f}], thickness: 0.04}}\n",
      own.name, YamlText(own.urdf), LinksText(own), base.x(), base.y(), base.z(),
      fmt::join(home, ", "), YamlText(own.gripper), site.table_edge,
      site.middle.x() + side + kBeyond, side + kBeyond, side + kBeyond);
  return text + fmt::format(kUsualRules, fmt::arg("safe_height", site.safe_height),
                            fmt::arg("low_x", site.middle.x() - side),
                            fmt::arg("high_x", site.middle.x() + side), fmt::arg("half", side),
                            fmt::arg("step", std::min(kMostStep, side)),
                            fmt::arg("x", site.middle.x()));
}

}  // namespace assay::cli
