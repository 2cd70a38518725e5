#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "planner/kinematics/arm.h"

namespace assay::kinematics {

// Poses that are solved side by side: as many as the widest vector registers hold numbers.
inline constexpr int kBatch = 8;
using BatchRow = std::array<double, kBatch>;  // one number of each pose

// X_BaseFlange of kBatch poses, number by number.
struct alignas(64) PoseBatch {
  std::array<std::array<BatchRow, 3>, 3> rotation;  // row, column
  std::array<BatchRow, 3> translation;              // metres
};
PoseBatch Batch(std::span<const Pose, kBatch> X_BaseFlange);

// All eight solutions of each pose, in the order and with the indicators of Arm::Inverse.
struct alignas(64) SolutionBatch {
  std::array<std::array<BatchRow, 6>, 8> q;  // solution, joint; radians in [-pi, pi]
  // The pose has eight solutions and is well away from all singular ones. Of others the solutions
  // mean nothing: Arm::Inverse knows them.
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

// The closed form of Arm::Inverse without branches, for many poses at a time: several times as
// quick a pose. Bits do not depend on the processor.
void Inverse(const ArmGeometry& geometry, const PoseBatch& poses, SolutionBatch& solutions);

}  // namespace assay::kinematics
