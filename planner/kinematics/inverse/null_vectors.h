#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>

namespace assay::kinematics {

using Matrix9 = Eigen::Matrix<double, 9, 9>;
using Vector9 = Eigen::Matrix<double, 9, 1>;

// A square matrix whose entries are quadratic in the cosine c and the sine s of half an angle:
// c^2 cc + c s cs + s^2 ss.
struct HalfAngleMatrix {
  Matrix9 cc = Matrix9::Zero();
  Matrix9 cs = Matrix9::Zero();
  Matrix9 ss = Matrix9::Zero();
};

// One number for each of eight angles.
inline constexpr std::size_t kAngleBatch = 8;
using AngleRow = std::array<double, kAngleBatch>;

// Returns vectors that the matrix maps to 0 at eight angles: entry i of the vector of angle k is in
// row i and column k. The vectors have any length. The matrix must have the rank 8. Elimination
// without a choice of pivots is quick for eight angles at once, and its rounding is that of random
// matrices: at one angle in a million, half of the digits are lost. All processors give the same
// bits.
std::array<AngleRow, 9> NullVectors(const HalfAngleMatrix& matrix, const AngleRow& angles);

}  // namespace assay::kinematics
