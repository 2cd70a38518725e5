#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "planner/kinematics/arm.h"

namespace assay::kinematics {

// The number of poses that are solved together: as many as the widest vector registers hold
// numbers.
inline constexpr int kBatch = 8;
using BatchRow = std::array<double, kBatch>;  // one number for each pose

// The poses X_BaseFlange of a batch. Each entry has one number for each pose.
struct alignas(64) PoseBatch {
  std::array<std::array<BatchRow, 3>, 3> rotation;  // indexed by row and column
  std::array<BatchRow, 3> translation;              // metres
};
PoseBatch Batch(std::span<const Pose, kBatch> X_BaseFlange);

// All eight solutions of each pose, in the order of kBatchIndicators, which is that of
// Arm::Inverse.
struct alignas(64) SolutionBatch {
  std::array<std::array<BatchRow, 6>, 8> q;  // indexed by solution and joint; radians in [-pi, pi]
  // True if the pose has eight solutions and is well away from all singular poses. For other poses
  // the solutions have no meaning, and Arm::Inverse must be used.
  std::array<bool, kBatch> regular;

  JointVector Solution(int solution, int pose) const;
};
inline constexpr std::array<Indicators, 8> kBatchIndicators = {{
    {Shoulder::kRight, Elbow::kAbove, Wrist::kNoFlip},
    {Shoulder::kRight, Elbow::kAbove, Wrist::kFlip},
    {Shoulder::kRight, Elbow::kBelow, Wrist::kNoFlip},
    {Shoulder::kRight, Elbow::kBelow, Wrist::kFlip},
    {Shoulder::kLeft, Elbow::kBelow, Wrist::kNoFlip},
    {Shoulder::kLeft, Elbow::kBelow, Wrist::kFlip},
    {Shoulder::kLeft, Elbow::kAbove, Wrist::kNoFlip},
    {Shoulder::kLeft, Elbow::kAbove, Wrist::kFlip},
}};

// Solves a batch of poses by the closed form of Arm::Inverse without branches, which is several
// times as fast per pose. The result is the same on every processor, bit for bit.
void Inverse(const ArmGeometry& geometry, const PoseBatch& poses, SolutionBatch& solutions);

}  // namespace assay::kinematics
