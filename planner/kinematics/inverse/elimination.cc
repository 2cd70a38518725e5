#include "planner/kinematics/inverse/elimination.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/kinematics/inverse/dual_quaternion.h"

namespace assay::kinematics {
namespace {

using Matrix8 = Eigen::Matrix<double, 8, 8>;
using Matrix9 = Eigen::Matrix<double, 9, 9>;
using Vector9 = Eigen::Matrix<double, 9, 1>;
using Matrix84 = Eigen::Matrix<double, 8, 4>;
using Vector4 = Eigen::Vector4d;

constexpr double kTurns = 2 * std::numbers::pi;
constexpr int kSamples = 160;
constexpr double kStep = kTurns / kSamples;

// A table of three pairs of numbers has eight products, one for each choice. The index of a product
// has one bit for each pair. The products of opposite corners of a face of this cube are equal, and
// so are those of all four diagonals of the cube.
struct Minor {
  int a, b, c, d;  // product a times product b equals product c times product d
};
constexpr std::array<Minor, 9> kMinors = {{{0, 3, 1, 2},
                                           {4, 7, 5, 6},
                                           {0, 5, 1, 4},
                                           {2, 7, 3, 6},
                                           {0, 6, 2, 4},
                                           {1, 7, 3, 5},
                                           {0, 7, 1, 6},
                                           {0, 7, 2, 5},
                                           {0, 7, 3, 4}}};

// Returns the products of the lines for all choices of 1 or the line, with the first line at the
// highest bit.
Matrix8 Products(const DualQuaternion& before, const std::array<DualQuaternion, 3>& lines) {
  Matrix8 columns;
  for (int index = 0; index < 8; ++index) {
    DualQuaternion product = before;
    for (int i = 0; i < 3; ++i) {
      if (index & (4 >> i)) product = Product(product, lines[static_cast<std::size_t>(i)]);
    }
    columns.col(index) = product;
  }
  return columns;
}

// Adds sign times the product of two linear forms of (x0 y0, x0 y1, x1 y0, x1 y1) to a row of
// coefficients of (x0^2, x0 x1, x1^2) times (y0^2, y0 y1, y1^2).
void AddProduct(const Vector4& f, const Vector4& g, double sign, Matrix9& N, int row) {
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) {
      const int x = (i >> 1) + (j >> 1);
      const int y = (i & 1) + (j & 1);
      N(row, 3 * x + y) += sign * f[i] * g[j];
    }
  }
}

// Returns half the angle whose functions have the squares and the product (c^2, c s, s^2).
double HalfAngle(const Eigen::Vector3d& squares) {
  return std::abs(squares[0]) > std::abs(squares[2]) ? std::atan2(squares[1], squares[0])
                                                     : std::atan2(squares[2], squares[1]);
}

class Eliminator {
 public:
  Eliminator(const SixAxes& axes, const SearchedJoint& joint, const Pose& motion) : joint_(joint) {
    const Pose inverse = motion.inverse();
    std::array<DualQuaternion, 3> first;
    std::array<DualQuaternion, 3> last;
    for (int i = 0; i < 6; ++i) {
      const int at = (joint.start + i) % 6;
      const JointAxis& axis = axes[static_cast<std::size_t>(at)];
      const DualQuaternion line = LineOf(at < joint.start ? Moved(inverse, axis) : axis);
      if (i < 3) first[static_cast<std::size_t>(i)] = line;
      if (i >= 3) last[static_cast<std::size_t>(5 - i)] = -line;  // backward
    }
    // The lowest bit of the second three is the first of them in the cycle.
    const Matrix8 W = Products(DualQuaternion::Unit(0), first)
                          .partialPivLu()
                          .solve(Products(DualQuaternionOf(motion), last));
    const int bit = 1 << joint.searched;
    int without = 0;
    for (int index = 0; index < 8; ++index) {
      if (index & bit) continue;
      cosine_.col(without) = W.col(index);
      sine_.col(without++) = W.col(index | bit);
    }
    for (int row = 0; row < 9; ++row) AddMinor(row);
    scale_ = cc_.norm() + ss_.norm();
  }

  std::vector<SixAngles> Solve() {
    std::array<Sample, kSamples> samples;
    for (int i = 0; i < kSamples; ++i) {
      samples[static_cast<std::size_t>(i)] = SampleAt((i + 0.5) * kStep);
    }
    for (std::size_t i = 0; i < kSamples; ++i) {
      const Sample& before = samples[(i + kSamples - 1) % kSamples];
      const Sample& here = samples[i];
      const Sample& after = samples[(i + 1) % kSamples];
      if ((here.value > 0) != (after.value > 0)) {
        AddRoot(here, i + 1 < kSamples ? after : SampleAt(here.angle + kStep));
      } else if ((here.value > 0) == (before.value > 0) &&
                 std::abs(here.value) <= std::min(std::abs(before.value), std::abs(after.value))) {
        AddLeast(here);
      }
    }
    return std::move(found_);
  }

 private:
  struct Sample {
    double angle = 0;
    double value = 0;  // of the misfit
    Vector9 squares;   // a unit vector that the matrix maps to 0
  };

  // The matrix of the nine equations, with entries that are quadratic in the cosine and sine of
  // half the searched angle.
  void AddMinor(int row) {
    const auto [a, b, c, d] = kMinors[static_cast<std::size_t>(row)];
    const auto add = [&](int f, int g, double sign) {
      const Vector4 fc = cosine_.row(f);
      const Vector4 fs = sine_.row(f);
      const Vector4 gc = cosine_.row(g);
      const Vector4 gs = sine_.row(g);
      AddProduct(fc, gc, sign, cc_, row);
      AddProduct(fc, gs, sign, cs_, row);
      AddProduct(fs, gc, sign, cs_, row);
      AddProduct(fs, gs, sign, ss_, row);
    };
    add(a, b, 1);
    add(c, d, -1);
  }

  Matrix9 At(double angle) const {
    const double c = std::cos(angle / 2);
    const double s = std::sin(angle / 2);
    return c * c * cc_ + c * s * cs_ + s * s * ss_;
  }

  // The matrix has the rank 8 at every angle, because both sides of the equation are motions. With
  // this matrix of rank 1 added, its null vector solves a regular system.
  Sample SampleAt(double angle) const {
    static const Vector9 u = Vector9::LinSpaced(0.3, 1.2).cwiseSqrt();
    static const Vector9 w = Vector9::LinSpaced(1.1, 0.4).cwiseAbs2();
    const Vector9 z = (At(angle) + scale_ * u * w.transpose()).partialPivLu().solve(u).normalized();
    return {angle, Misfit(z), z};
  }

  // Vanishes if the entries are products of squares and products. The combination is arbitrary.
  static double Misfit(const Vector9& z) {
    const double middle = z[4] * z[4];
    return (z[0] * z[8] - middle) + 0.62 * (z[2] * z[6] - middle) + 0.31 * (z[1] * z[7] - middle) -
           0.83 * (z[3] * z[5] - middle);
  }

  // Narrows a change of sign down by the Illinois method, and adds its solution. A few steps
  // suffice, because the caller refines it.
  void AddRoot(Sample low, Sample high) {
    Sample middle = low;
    for (int i = 0; i < 5 && low.value != high.value; ++i) {
      middle =
          SampleAt((low.angle * high.value - high.angle * low.value) / (high.value - low.value));
      if ((middle.value > 0) == (high.value > 0)) {
        low.value /= 2;
      } else {
        low = high;
      }
      high = middle;
    }
    AddSolution(middle.angle, middle.squares);
  }

  // Searches for the least absolute value between the neighbours of a sample. There may be two
  // roots beside it, or a double root.
  void AddLeast(const Sample& sample) {
    const double sign = sample.value > 0 ? 1 : -1;
    Sample least = sample;
    for (double step = kStep / 2; step > kStep / 100; step /= 2) {
      for (const double side : {-step, step}) {
        const Sample next = SampleAt(least.angle + side);
        if (sign * next.value < 0) {
          AddRoot(least, next);
          AddRoot(next, SampleAt(sample.angle + (side < 0 ? -kStep : kStep)));
          return;
        }
        if (sign * next.value < sign * least.value) {
          least = next;
          break;
        }
      }
    }
    AddSolution(least.angle, least.squares);
  }

  // `squares` has nine products of squares and products of the functions of two half angles.
  void AddSolution(double angle, const Vector9& squares) {
    const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> table(squares.data());
    Eigen::Index row = 0;
    Eigen::Index column = 0;
    table.colwise().norm().maxCoeff(&column);
    table.rowwise().norm().maxCoeff(&row);
    const double x = HalfAngle(table.col(column));
    const double y = HalfAngle(table.row(row));
    const Vector4 products(std::cos(x) * std::cos(y), std::cos(x) * std::sin(y),
                           std::sin(x) * std::cos(y), std::sin(x) * std::sin(y));
    const DualQuaternion first =
        (std::cos(angle / 2) * cosine_ + std::sin(angle / 2) * sine_) * products;
    SixAngles q;
    Set(q, 3 + joint_.searched, angle);
    // The higher of the remaining two bits belongs to x.
    Set(q, 3 + (joint_.searched == 2 ? 1 : 2), 2 * x);
    Set(q, 3 + (joint_.searched == 0 ? 1 : 0), 2 * y);
    Eigen::Index most = 0;
    first.cwiseAbs().maxCoeff(&most);
    for (int i = 0; i < 3; ++i) {
      const int bit = 4 >> i;
      const int base = static_cast<int>(most) & ~bit;
      Set(q, i, 2 * std::atan2(first[base | bit], first[base]));
    }
    if (q.allFinite()) found_.push_back(q);
  }

  void Set(SixAngles& q, int place, double angle) const {
    q[(joint_.start + place) % 6] = std::remainder(angle, 2 * std::numbers::pi);
  }

  SearchedJoint joint_;
  Matrix84 cosine_;
  Matrix84 sine_;
  Matrix9 cc_ = Matrix9::Zero();
  Matrix9 cs_ = Matrix9::Zero();
  Matrix9 ss_ = Matrix9::Zero();
  double scale_ = 1;  // size of the matrix
  std::vector<SixAngles> found_;
};

}  // namespace

std::vector<SixAngles> SolveByElimination(const SixAxes& axes, const SearchedJoint& joint,
                                          const Pose& motion) {
  return Eliminator(axes, joint, motion).Solve();
}

}  // namespace assay::kinematics
