#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "planner/domain/problem/problem.h"

namespace assay::scene {

// How a closed gripper holds a part.
enum class GraspMode {
  kFriction,  // by the friction of the pads
  kWeld,      // by a rigid constraint besides, to leave slip out of a study
};
std::string_view Name(GraspMode mode);  // "friction", as files and commands have it

// How the problem's world is simulated, and how the true one differs from the problem's.
struct SceneOptions {
  double timestep = 0.0005;  // seconds
  GraspMode grasp = GraspMode::kFriction;
  std::optional<double> part_friction = std::nullopt;  // instead of the part files' values
  // Kilograms, by part, instead of what the part files' densities give: what is hidden in a part.
  // It is spread alike.
  std::map<domain::PartId, double> part_masses = {};
  // Red, green, blue and alpha, by part, instead of what the part files say: what a part's looks
  // tell of what is hidden in it.
  std::map<domain::PartId, Eigen::Vector4d> part_colors = {};
  double light = 1;  // of all lamps, as a factor
  // What parts rest on are planes without end, not boxes: for programs with the engine's own
  // collision of boxes, which shoots parts away that lie flat on a box
  // (mujoco::CheckBoxCollisions).
  bool endless_tables = false;
  // Truth minus what the problem says. No true friction is below 0.
  double clearance_error = 0;     // metres on each side of a mated shaft
  double friction_error = 0;      // of parts: than the part files' values, or part_friction
  double pad_friction_error = 0;  // of the gripper's pads
};

// The whole workcell as a model for the engine, in its XML: floor, pedestal, table, arm, gripper,
// parts as free bodies at their initial poses, sensors, cameras. Names: part NAME is body
// "part/NAME"; arm links and joints have their URDF names after "arm/", those of the gripper after
// "gripper/"; the tables are geoms of the world (TableGeom). With several robots, those names and
// the wrist's begin with the robot's own: "left/arm/". The key frame "home" is where Scene::Start
// is.
std::string ToMjcf(const domain::Problem& problem, const SceneOptions& options);

}  // namespace assay::scene
