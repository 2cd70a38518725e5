#include "planner/kinematics/inverse_batch.h"

#include <numbers>

#include "planner/kinematics/arctangent.h"

namespace assay::kinematics {
namespace {

// A pose is regular if squares of metres, and the squared sine of joint 5, are above this. That is
// well above rounding errors.
constexpr double kRegular = 1e-12;

// One number for each pose, as a vector type of the compiler.
using Row [[gnu::vector_size(sizeof(BatchRow))]] = double;

[[gnu::always_inline]] inline Row Load(const BatchRow& numbers) {
  Row row;
  __builtin_memcpy(&row, numbers.data(), sizeof row);
  return row;
}

[[gnu::always_inline]] inline void Store(const Row& row, BatchRow& numbers) {
  __builtin_memcpy(numbers.data(), &row, sizeof row);
}

[[gnu::always_inline]] inline Row SquareRoot(const Row& row) {
  Row root;
  for (int i = 0; i < kBatch; ++i) root[i] = __builtin_sqrt(row[i] > 0 ? row[i] : 0);
  return root;
}

[[gnu::always_inline]] inline Row Lesser(const Row& a, const Row& b) { return a < b ? a : b; }

[[gnu::always_inline]] inline Row Opposite(const Row& angle) {
  return angle > 0 ? angle - std::numbers::pi : angle + std::numbers::pi;
}

// The rotations of the flanges, by row and column.
struct Rotation {
  Row m[3][3];
};

// Computes joints 4 to 6 of both wrist solutions, from the cosines and sines of joint 1 and of the
// sum of joints 2 and 3. Returns the squared sine of joint 5.
[[gnu::always_inline]] inline Row SolveWrist(const Rotation& R, const Row& c1, const Row& s1,
                                             const Row& c23, const Row& s23,
                                             std::array<BatchRow, 6>* solutions) {
  const Row forward = c1 * R.m[0][2] + s1 * R.m[1][2];
  const Row ax = forward * c23 - s23 * R.m[2][2];
  const Row ay = c1 * R.m[1][2] - s1 * R.m[0][2];
  const Row az = forward * s23 + c23 * R.m[2][2];
  const Row sine2 = ax * ax + ay * ay;
  // y4 is axis 5 times the sine of joint 5. This factor changes no angle.
  const Row y4x = -ax * s1 - ay * c1 * c23;
  const Row y4y = ax * c1 - ay * s1 * c23;
  const Row y4z = ay * s23;
  const Row q4 = Arctangent(ay, ax);
  const Row q5 = Arctangent(SquareRoot(sine2), az);
  const Row q6 = Arctangent<Row>(y4x * R.m[0][0] + y4y * R.m[1][0] + y4z * R.m[2][0],
                                 y4x * R.m[0][1] + y4y * R.m[1][1] + y4z * R.m[2][1]);
  Store(q4, solutions[0][3]);
  Store(q5, solutions[0][4]);
  Store(q6, solutions[0][5]);
  Store(Opposite(q4), solutions[1][3]);
  Store(-q5, solutions[1][4]);
  Store(Opposite(q6), solutions[1][5]);
  return sine2;
}

// The formulas are derived in arm.cc.
[[gnu::always_inline]] inline void Solve(const ArmGeometry& g, const PoseBatch& poses,
                                         SolutionBatch& solutions) {
  Rotation R;
  for (std::size_t i = 0; i < 9; ++i) R.m[i / 3][i % 3] = Load(poses.rotation[i / 3][i % 3]);
  const Row x0 = Load(poses.translation[0]) - g.d6 * R.m[0][2];
  const Row y0 = Load(poses.translation[1]) - g.d6 * R.m[1][2];
  const Row z0 = Load(poses.translation[2]) - g.d6 * R.m[2][2];
  const Row radial2 = x0 * x0 + y0 * y0;
  const Row r2 = radial2 - g.d2 * g.d2;
  const Row R2 = r2 + z0 * z0;
  const double forearm2 = g.a3 * g.a3 + g.d4 * g.d4;
  const Row along = (R2 + g.a2 * g.a2 - forearm2) / (2 * g.a2);
  const Row e2 = R2 - along * along;
  const Row r = SquareRoot(r2);
  const Row e = SquareRoot(e2);
  const Row u = along - g.a2;
  Row margin = Lesser(r2, e2);
  for (std::size_t shoulder = 0; shoulder < 2; ++shoulder) {
    const Row x = shoulder == 0 ? -r : r;
    const Row c1 = (x * x0 + g.d2 * y0) / radial2;
    const Row s1 = (x * y0 - g.d2 * x0) / radial2;
    const Row q1 = Arctangent(s1, c1);
    for (std::size_t elbow = 0; elbow < 2; ++elbow) {
      const Row across = elbow == 0 ? e : -e;
      const Row c3 = (g.a3 * u + g.d4 * across) / forearm2;
      const Row s3 = (g.d4 * u - g.a3 * across) / forearm2;
      const Row c2 = (x * along + z0 * across) / R2;
      const Row s2 = (x * across - z0 * along) / R2;
      const Row q2 = Arctangent(s2, c2);
      const Row q3 = Arctangent(s3, c3);
      std::array<BatchRow, 6>* both = &solutions.q[4 * shoulder + 2 * elbow];
      for (std::size_t flip = 0; flip < 2; ++flip) {
        Store(q1, both[flip][0]);
        Store(q2, both[flip][1]);
        Store(q3, both[flip][2]);
      }
      const Row c23 = c2 * c3 - s2 * s3;
      const Row s23 = s2 * c3 + c2 * s3;
      margin = Lesser(margin, SolveWrist(R, c1, s1, c23, s23, both));
    }
  }
  for (int i = 0; i < kBatch; ++i) {
    solutions.regular[static_cast<std::size_t>(i)] = margin[i] > kRegular;
  }
}

}  // namespace

PoseBatch Batch(std::span<const Pose, kBatch> X_BaseFlange) {
  PoseBatch batch;
  for (std::size_t pose = 0; pose < kBatch; ++pose) {
    for (std::size_t row = 0; row < 3; ++row) {
      const int i = static_cast<int>(row);
      batch.translation[row][pose] = X_BaseFlange[pose].translation()[i];
      for (std::size_t column = 0; column < 3; ++column) {
        batch.rotation[row][column][pose] =
            X_BaseFlange[pose].linear()(i, static_cast<int>(column));
      }
    }
  }
  return batch;
}

JointVector SolutionBatch::Solution(int solution, int pose) const {
  JointVector joints;
  for (int joint = 0; joint < 6; ++joint) {
    joints[joint] = q[static_cast<std::size_t>(solution)][static_cast<std::size_t>(joint)]
                     [static_cast<std::size_t>(pose)];
  }
  return joints;
}

// Compiled for several kinds of vector registers. The version is chosen once, when the program is
// loaded.
[[gnu::target_clones("avx512f", "avx2", "default")]] void Inverse(const ArmGeometry& geometry,
                                                                  const PoseBatch& poses,
                                                                  SolutionBatch& solutions) {
  Solve(geometry, poses, solutions);
}

}  // namespace assay::kinematics
