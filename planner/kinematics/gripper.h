#pragma once

#include <filesystem>
#include <vector>

#include "planner/geometry/box.h"
#include "planner/kinematics/urdf_model.h"

namespace assay::kinematics {

using geometry::Box;
using geometry::Vector2;

// A parallel-jaw gripper. Its tool frame has z = approach direction, y = closing direction (the
// left finger at +y) and its origin midway between the centres of the pads. Every length is read
// out of the URDF's collision boxes.
class Gripper {
 public:
  // Throws InputError if the file is not URDF or not such a gripper: links `hand` (the root, at
  // the flange), `tool` (fixed to the hand), `finger_left` and `finger_right` (prismatic joints of
  // these names along +y and -y of the tool, from 0, with the same range); all collisions boxes,
  // and the fingers' boxes named `pad` with their inner faces meeting in the tool's origin at
  // joint values 0.
  static Gripper FromUrdf(const std::filesystem::path& file);

  const RobotModel& model() const { return model_; }
  const Pose& X_FlangeTool() const { return X_FlangeTool_; }

  double max_opening() const { return max_opening_; }  // metres, between the pads' faces
  double max_force() const { return max_force_; }      // newtons, of one finger

  // The hand's boxes in the tool frame.
  const std::vector<Box>& HandBoxes() const { return hand_; }
  // Both fingers' boxes, pads included, in the tool frame; 0 <= opening <= max_opening().
  std::vector<Box> FingerBoxes(double opening) const;

  // Half the size of a pad's contact face: along x and along z of the tool frame, metres.
  const Vector2& pad_half_extents() const { return pad_half_extents_; }

 private:
  explicit Gripper(RobotModel model);
  void ReadTool(LinkId tool);
  void ReadFingers(LinkId left, LinkId right);

  RobotModel model_;
  Pose X_FlangeTool_ = Pose::Identity();
  double max_opening_ = 0;
  double max_force_ = 0;
  std::vector<Box> hand_;
  std::vector<Box> left_;   // at joint value 0
  std::vector<Box> right_;  // at joint value 0
  Vector2 pad_half_extents_ = Vector2::Zero();
};

}  // namespace assay::kinematics
