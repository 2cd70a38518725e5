#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "planner/geometry/coordinates.h"
#include "planner/kinematics/urdf_model.h"

namespace assay::kinematics {

// The face of a pad, a rectangle in the frame of its link. It is normal to the direction in which
// the fingers close.
struct PadFace {
  Vector3 center = Vector3::Zero();
  // The edge lengths, across the approach direction of the gripper and along it, in metres.
  geometry::Vector2 size = geometry::Vector2::Zero();

  friend bool operator==(const PadFace&, const PadFace&) = default;
};

// Where a gripper is described, and which links of the URDF file it has.
struct GripperInFile {
  std::filesystem::path file;
  std::string flange = {};  // the link that is mounted on the arm; empty for the root
  // By the names of their two links. Without pads, the file must have the form that Gripper reads.
  std::map<std::string, PadFace> pads = {};

  friend bool operator==(const GripperInFile&, const GripperInFile&) = default;
};

// Returns a parallel gripper in the form that Gripper reads: with the links `hand`, `tool`,
// `finger_left` and `finger_right`, whose shapes for collision are boxes. The model must have two
// prismatic joints, which move the links of the pads along one line in opposite directions, by
// themselves or because one mimics the other. At one end of their ranges the pads must touch. The
// finger of the joint that comes first in the file is the left one. The approach direction is that
// axis of the flange's frame, normal to the closing direction, that leads to the pads most
// directly.
//
// A shape that is no box is replaced by the box around it. Shapes of fingers are cut half a
// millimetre behind the faces of the pads, because only pads may touch a part that is held. Throws
// InputError if the model is not such a gripper, or if a finger reaches beyond the face of its pad.
RobotModel ParallelGripperModel(const RobotModel& model, const GripperInFile& gripper);

}  // namespace assay::kinematics
