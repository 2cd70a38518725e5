#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "planner/geometry/coordinates.h"
#include "planner/kinematics/grippers/gripper_model.h"
#include "planner/kinematics/urdf_model.h"

namespace assay::geometry {
struct Box;
}  // namespace assay::geometry

namespace assay::kinematics {

using geometry::Box;
using geometry::Vector2;

// A parallel-jaw gripper. The z axis of its tool frame is the approach direction, and the y axis is
// the closing direction, with the left finger at +y. The origin is midway between the centres of
// the pads. All lengths are read from the collision boxes of the URDF file.
class Gripper {
 public:
  // Reads a gripper from a URDF file. Throws InputError if the file is not URDF or not a gripper of
  // this kind. The links must be `hand` (the root, at the flange), `tool` (fixed to the hand),
  // `finger_left` and `finger_right`. The fingers must have prismatic joints of the same names
  // along +y and -y of the tool, which start at 0 and have the same range. All collision shapes
  // must be boxes. Each finger must have a box named `pad`, and the inner faces of the pads must
  // meet in the tool's origin at joint values 0.
  static Gripper FromUrdf(const std::filesystem::path& file);
  // Reads a parallel gripper with other links, whose pads are named (ParallelGripperModel).
  // `packages` are folders with meshes (ReadUrdf).
  static Gripper FromUrdf(const GripperInFile& gripper,
                          std::span<const std::filesystem::path> packages = {});

  Gripper(const Gripper& other);
  Gripper(Gripper&& other) noexcept;
  Gripper& operator=(const Gripper& other);
  Gripper& operator=(Gripper&& other) noexcept;
  ~Gripper();

  const RobotModel& model() const { return model_; }
  const Pose& X_FlangeTool() const { return X_FlangeTool_; }

  double max_opening() const { return max_opening_; }  // metres between the faces of the pads
  double max_force() const { return max_force_; }      // newtons of one finger

  // Returns the hand's boxes in the tool frame.
  const std::vector<Box>& HandBoxes() const { return hand_; }
  // Returns the boxes of both fingers, pads included, in the tool frame. 0 <= opening <=
  // max_opening(), in metres.
  std::vector<Box> FingerBoxes(double opening) const;

  // Half the extents of a pad's contact face along x and z of the tool frame, in metres.
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
  std::vector<Box> left_;   // the boxes at joint value 0
  std::vector<Box> right_;  // the boxes at joint value 0
  Vector2 pad_half_extents_ = Vector2::Zero();
};

}  // namespace assay::kinematics
