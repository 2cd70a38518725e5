#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "planner/domain/problem/problem.h"

namespace assay::scene {

// The ways in which a closed gripper holds a part.
enum class GraspMode {
  kFriction,  // by the friction of the pads
  kWeld,      // by friction and a rigid constraint, for studies without slip
};
std::string_view Name(GraspMode mode);

// Settings of the simulated world of a problem, and its differences from the problem.
struct SceneOptions {
  double timestep = 0.0005;  // seconds
  GraspMode grasp = GraspMode::kFriction;
  std::optional<double> part_friction = std::nullopt;  // overrides the part files' values
  // Masses by part, kg. They override the masses that follow from the part files' densities, and
  // stand for something hidden in a part. The mass distribution is scaled as a whole.
  std::map<domain::PartId, double> part_masses = {};
  // Colours by part, as red, green, blue and alpha. They override the colours of the part files,
  // and show from outside what is hidden in a part.
  std::map<domain::PartId, Eigen::Vector4d> part_colors = {};
  double light = 1;  // factor on the brightness of all lamps
  // Parts rest on infinite planes, not on boxes. This is for programs with the engine's own box
  // collision, which throws off parts that lie flat on a box (mujoco::CheckBoxCollisions).
  bool endless_tables = false;
  // Errors: the true value minus the problem's value. No true friction is below 0.
  double clearance_error = 0;     // metres on each side of a mated shaft
  double friction_error = 0;      // of the parts' friction, relative to files or part_friction
  double pad_friction_error = 0;  // of the friction of the gripper's pads
};

// Returns the whole workcell as a MuJoCo model in XML (MJCF): floor, pedestal, table, arm, gripper,
// parts as free bodies at their initial poses, sensors and cameras. Part NAME is the body
// "part/NAME". The names of arm links and joints are "arm/" and their URDF name, and those of the
// gripper are "gripper/" and their URDF name. The tables are geoms of the world (TableGeom). If
// there are several robots, the names of arm, gripper and wrist begin with the robot's name:
// "left/arm/". The key frame "home" is the state of Scene::Start.
std::string ToMjcf(const domain::Problem& problem, const SceneOptions& options);

}  // namespace assay::scene
