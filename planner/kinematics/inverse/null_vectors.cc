#include "planner/kinematics/inverse/null_vectors.h"

#include <cmath>

namespace assay::kinematics {
namespace {

// One number for each angle, as a vector type of the compiler.
using Lanes [[gnu::vector_size(sizeof(AngleRow))]] = double;

// With a matrix of rank 1 added, the null vector solves a regular system. The two vectors have no
// meaning, and make the leading minors of the sum differ from 0.
constexpr std::array<double, 9> kLeft = {0.83, -0.41, 0.67, 0.29, -0.95, 0.53, 0.71, -0.37, 0.59};
constexpr std::array<double, 9> kRight = {0.61, 0.87, -0.33, 0.79, 0.45, -0.69, 0.97, 0.51, -0.73};

// Solves the triangular system that the elimination leaves.
[[gnu::always_inline]] inline void SubstituteBack(const Lanes (&a)[9][10], double* found) {
  Lanes z[9];
  for (int i = 8; i >= 0; --i) {
    Lanes sum = a[i][9];
    for (int j = i + 1; j < 9; ++j) sum -= a[i][j] * z[j];
    z[i] = sum / a[i][i];
  }
  __builtin_memcpy(found, z, sizeof z);
}

[[gnu::always_inline]] inline void Eliminate(const double* cc, const double* cs, const double* ss,
                                             double scale, const AngleRow& cosines,
                                             const AngleRow& sines, double* found) {
  Lanes c;
  Lanes s;
  __builtin_memcpy(&c, cosines.data(), sizeof c);
  __builtin_memcpy(&s, sines.data(), sizeof s);
  const Lanes c2 = c * c;
  const Lanes s2 = s * s;
  const Lanes both = c * s;
  Lanes a[9][10];
  for (int j = 0; j < 9; ++j) {
    for (int i = 0; i < 9; ++i) {
      const int at = 9 * j + i;
      a[i][j] = c2 * cc[at] + both * cs[at] + s2 * ss[at] +
                scale * kLeft[static_cast<std::size_t>(i)] * kRight[static_cast<std::size_t>(j)];
    }
  }
  for (int i = 0; i < 9; ++i) a[i][9] = c - c + kLeft[static_cast<std::size_t>(i)];
  for (int k = 0; k < 8; ++k) {
    const Lanes inverse = 1 / a[k][k];
    for (int i = k + 1; i < 9; ++i) {
      const Lanes factor = a[i][k] * inverse;
      for (int j = k + 1; j < 10; ++j) a[i][j] -= factor * a[k][j];
    }
  }
  SubstituteBack(a, found);
}

// Compiled for several kinds of vector registers. The version is chosen once, when the program is
// loaded.
[[gnu::target_clones("avx512f", "avx2", "default")]] void EliminateEight(
    const double* cc, const double* cs, const double* ss, double scale, const AngleRow& cosines,
    const AngleRow& sines, double* found) {
  Eliminate(cc, cs, ss, scale, cosines, sines, found);
}

}  // namespace

std::array<AngleRow, 9> NullVectors(const HalfAngleMatrix& matrix, const AngleRow& angles) {
  AngleRow cosines;
  AngleRow sines;
  for (std::size_t i = 0; i < kAngleBatch; ++i) {
    cosines[i] = std::cos(angles[i] / 2);
    sines[i] = std::sin(angles[i] / 2);
  }
  const double scale = matrix.cc.norm() + matrix.ss.norm();
  std::array<AngleRow, 9> vectors;
  EliminateEight(matrix.cc.data(), matrix.cs.data(), matrix.ss.data(), scale, cosines, sines,
                 vectors.front().data());
  return vectors;
}

}  // namespace assay::kinematics
