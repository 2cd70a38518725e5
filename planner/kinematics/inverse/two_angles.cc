#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "planner/kinematics/inverse/subproblems.h"
#include "planner/kinematics/inverse/trigonometric_roots.h"

namespace assay::kinematics {
namespace {

using Matrix2 = Eigen::Matrix2d;
using PlaneVector = Eigen::Vector2d;

// Equations whose coefficients are smaller than this say nothing.
constexpr double kNoEquation = 1e-11;
// A matrix whose smaller singular value is below this part of the equations' coefficients has no
// inverse.
constexpr double kNoInverse = 1e-8;

PlaneVector UnitAt(double angle) { return {std::cos(angle), std::sin(angle)}; }

// The equations A u1 + B u2 = d for the unit vectors u1 and u2 at the angles q1 and q2. The
// coefficients of each equation have the norm 1, or are all zero.
class TwoAngleSolver {
 public:
  TwoAngleSolver(const std::array<TwoAngleEquation, 2>& equations,
                 const std::array<double, 2>& reference)
      : reference_(reference) {
    for (int i = 0; i < 2; ++i) {
      const TwoAngleEquation& e = equations[static_cast<std::size_t>(i)];
      const double norm = Eigen::Vector4d(e.cosine1, e.sine1, e.cosine2, e.sine2).norm();
      const double scale = norm < kNoEquation ? 0 : 1 / norm;
      A_.row(i) << e.cosine1 * scale, e.sine1 * scale;
      B_.row(i) << e.cosine2 * scale, e.sine2 * scale;
      d_[i] = e.value * scale;
    }
  }

  BoundedList<SubproblemAngles<2>, 4> Solve() {
    const double a = LeastSingularValue(A_);
    const double b = LeastSingularValue(B_);
    if (A_.norm() < kNoInverse) {
      AddSecond(reference_[0], true);
    } else if (B_.norm() < kNoInverse) {
      Swap();
      AddSecond(reference_[0], true);
    } else if (std::min(a, b) < kNoInverse) {
      if (a < b) Swap();
      SolveSingular();
    } else {
      if (a > b) Swap();
      SolveQuartic();
    }
    return found_;
  }

 private:
  static double LeastSingularValue(const Matrix2& M) {
    const double norm = M.norm();
    return norm == 0 ? 0 : std::abs(M.determinant()) / norm;
  }

  // Exchanges the angles.
  void Swap() {
    std::swap(A_, B_);
    std::swap(reference_[0], reference_[1]);
    swapped_ = !swapped_;
  }

  void Add(double q1, double q2, bool exact, bool is_free) {
    if (found_.size() == 4) return;
    if (swapped_) std::swap(q1, q2);
    found_.push_back({{q1, q2}, exact, is_free});
  }

  // B has an inverse, and |u2| = 1 gives an equation for q1.
  void SolveQuartic() {
    const Matrix2 inverse = B_.inverse();
    const PlaneVector g = inverse * d_;
    const Matrix2 H = inverse * A_;
    const PlaneVector linear = -2 * H.transpose() * g;
    const Matrix2 S = H.transpose() * H;
    const TrigonometricQuadratic f{.constant = g.squaredNorm() - 1 + (S(0, 0) + S(1, 1)) / 2,
                                   .cosine = linear[0],
                                   .sine = linear[1],
                                   .cosine2 = (S(0, 0) - S(1, 1)) / 2,
                                   .sine2 = S(0, 1)};
    const double size = std::abs(f.constant) + linear.norm() + S.norm();
    const double most = std::max({std::abs(f.constant), std::abs(f.cosine), std::abs(f.sine),
                                  std::abs(f.cosine2), std::abs(f.sine2)});
    if (most < 1e-13 * (1 + size + g.squaredNorm())) {
      AddQuotient(reference_[0], g - H * UnitAt(reference_[0]), true);
      return;
    }
    for (const double q1 : RootsOf(f)) AddQuotient(q1, g - H * UnitAt(q1), false);
  }

  void AddQuotient(double q1, const PlaneVector& u2, bool is_free) {
    Add(q1, std::atan2(u2[1], u2[0]), std::abs(u2.norm() - 1) < kExactError, is_free);
  }

  // B has no inverse. The combination of the equations without q2 gives q1. The quartic equation is
  // imprecise here if the other matrix is nearly singular, which it is in common poses of the tool.
  void SolveSingular() {
    const int longer = B_.row(0).norm() > B_.row(1).norm() ? 0 : 1;
    const PlaneVector column = B_ * B_.row(longer).transpose().normalized();
    const PlaneVector without = PlaneVector(-column[1], column[0]).normalized();
    const Eigen::RowVector2d row = without.transpose() * A_;
    if (row.norm() < kNoInverse) {
      AddSecond(reference_[0], true);
      return;
    }
    for (const SubproblemAngles<1>& first : SolveOneAngle(row[0], row[1], without.dot(d_))) {
      AddSecond(first.q[0], false);
    }
  }

  // Adds the solutions with this first angle.
  void AddSecond(double q1, bool is_free) {
    const PlaneVector right = d_ - A_ * UnitAt(q1);
    if (LeastSingularValue(B_) > kNoInverse) {
      AddQuotient(q1, B_.inverse() * right, is_free);
      return;
    }
    const int longer = B_.row(0).norm() > B_.row(1).norm() ? 0 : 1;
    for (const SubproblemAngles<1>& second :
         SolveOneAngle(B_(longer, 0), B_(longer, 1), right[longer], reference_[1])) {
      const bool exact = (B_ * UnitAt(second.q[0]) - right).norm() < kExactError;
      Add(q1, second.q[0], exact, is_free || second.free);
    }
  }

  Matrix2 A_;
  Matrix2 B_;
  PlaneVector d_;
  std::array<double, 2> reference_;
  bool swapped_ = false;
  BoundedList<SubproblemAngles<2>, 4> found_;
};

}  // namespace

BoundedList<SubproblemAngles<2>, 4> SolveTwoAngles(const std::array<TwoAngleEquation, 2>& equations,
                                                   const std::array<double, 2>& reference) {
  return TwoAngleSolver(equations, reference).Solve();
}

}  // namespace assay::kinematics
