#include "planner/kinematics/inverse/elimination.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/kinematics/inverse/dual_quaternion.h"
#include "planner/kinematics/inverse/null_vectors.h"

namespace assay::kinematics {
namespace {

using Matrix8 = Eigen::Matrix<double, 8, 8>;
using Matrix84 = Eigen::Matrix<double, 8, 4>;
using Vector4 = Eigen::Vector4d;

constexpr double kTurns = 2 * std::numbers::pi;
constexpr int kSamples = 96;
constexpr double kStep = kTurns / kSamples;
constexpr int kMostHalvings = 8;
constexpr double kLeastCosine2 = 0.98;
// If the null vector turns sharply between more neighbouring samples than this, the matrix has a
// rank below 8 everywhere.
constexpr std::size_t kMostSharp = 60;
constexpr int kRounds = 5;

// Three pairs of numbers have eight products with one number of each pair. The index of a product
// has one bit for each pair, so the eight products are the corners of a cube. On a face of the
// cube, two opposite corners have the same product as the other two corners. The two corners of a
// space diagonal have the same product for all four space diagonals.
struct Minor {
  int a, b, c, d;  // corner a times corner b equals corner c times corner d
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

// Returns half an angle from three monomials (c^2, c s, s^2) of its cosine c and its sine s.
double HalfAngle(const Eigen::Vector3d& squares) {
  return std::abs(squares[0]) > std::abs(squares[2]) ? std::atan2(squares[1], squares[0])
                                                     : std::atan2(squares[2], squares[1]);
}

struct Sample {
  double angle = 0;
  double value = 0;  // of the misfit
  Vector9 squares;   // a unit vector that the matrix maps to 0

  bool IsPositive() const { return value > 0; }
};

// Three samples in the order of their angles. Between the outer two, the misfit changes its sign
// (`crosses`; the middle sample is the last one), or the middle one has the least absolute value.
struct Bracket {
  Sample low;
  Sample middle;
  Sample high;
  bool crosses = false;

  // Returns where the misfit is estimated to be zero or least.
  double Next() const {
    if (crosses) {
      const double rise = high.value - low.value;
      return rise == 0 ? low.angle : (low.angle * high.value - high.angle * low.value) / rise;
    }
    const double a = low.angle - middle.angle;
    const double b = high.angle - middle.angle;
    const double da = low.value - middle.value;
    const double db = high.value - middle.value;
    const double twice = 2 * (b * da - a * db);
    return twice == 0 ? middle.angle : middle.angle + (b * b * da - a * a * db) / twice;
  }

  // Narrows a change of sign by the Illinois method.
  void Cross(const Sample& sample) {
    middle = sample;
    if (sample.IsPositive() == high.IsPositive()) {
      high = sample;
      low.value /= 2;
    } else {
      low = sample;
      high.value /= 2;
    }
  }

  // Keeps the least absolute value in the middle.
  void Lower(const Sample& sample) {
    const bool is_less = std::abs(sample.value) < std::abs(middle.value);
    const Sample& outer = is_less ? middle : sample;
    const Sample& inner = is_less ? sample : middle;
    (outer.angle < inner.angle ? low : high) = outer;
    middle = Sample(inner);
  }
};

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
  }

  std::vector<SixAngles> Solve() {
    static const std::vector<double> kAngles = [] {
      std::vector<double> angles;
      for (int i = 0; i < kSamples; ++i) angles.push_back((i + 0.5) * kStep);
      return angles;
    }();
    std::vector<Sample> samples = SamplesAt(kAngles);
    for (int round = 0; round < kMostHalvings; ++round) {
      const std::vector<double> angles = SharpTurns(samples);
      if (angles.size() > kMostSharp) return {};
      if (angles.empty()) break;
      const std::vector<Sample> added = SamplesAt(angles);
      samples.insert(samples.end(), added.begin(), added.end());
      std::ranges::sort(samples, {}, &Sample::angle);
    }
    std::vector<Bracket> brackets = BracketsOf(samples);
    for (int round = 0; round < kRounds; ++round) Narrow(brackets);
    for (const Bracket& bracket : brackets) AddSolution(bracket.middle);
    return std::move(found_);
  }

 private:
  // The matrix of the nine equations, with entries that are quadratic in the cosine and sine of
  // half the searched angle.
  void AddMinor(int row) {
    const auto [a, b, c, d] = kMinors[static_cast<std::size_t>(row)];
    const auto add = [&](int f, int g, double sign) {
      const Vector4 fc = cosine_.row(f);
      const Vector4 fs = sine_.row(f);
      const Vector4 gc = cosine_.row(g);
      const Vector4 gs = sine_.row(g);
      AddProduct(fc, gc, sign, matrix_.cc, row);
      AddProduct(fc, gs, sign, matrix_.cs, row);
      AddProduct(fs, gc, sign, matrix_.cs, row);
      AddProduct(fs, gs, sign, matrix_.ss, row);
    };
    add(a, b, 1);
    add(c, d, -1);
  }

  // Vanishes if the vector consists of the nine monomials (elimination.h) of some angles. The
  // factors of the sum are arbitrary.
  static double Misfit(const Vector9& z) {
    const double middle = z[4] * z[4];
    return (z[0] * z[8] - middle) + 0.62 * (z[2] * z[6] - middle) + 0.31 * (z[1] * z[7] - middle) -
           0.83 * (z[3] * z[5] - middle);
  }

  // Returns the middle angles between neighbours whose vectors differ much in their directions.
  // Roots cluster at such places.
  static std::vector<double> SharpTurns(const std::vector<Sample>& samples) {
    std::vector<double> angles;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const Sample& here = samples[i];
      const Sample& next = samples[(i + 1) % samples.size()];
      const double cosine = here.squares.dot(next.squares);
      const double turn = i + 1 == samples.size() ? kTurns : 0;
      if (cosine * cosine < kLeastCosine2) angles.push_back((here.angle + next.angle + turn) / 2);
    }
    return angles;
  }

  // Returns the changes of sign between neighbours of the circle of samples, and the least absolute
  // values.
  static std::vector<Bracket> BracketsOf(const std::vector<Sample>& samples) {
    std::vector<Bracket> brackets;
    const std::size_t count = samples.size();
    for (std::size_t i = 0; i < count; ++i) {
      Sample before = samples[(i + count - 1) % count];
      const Sample& here = samples[i];
      Sample after = samples[(i + 1) % count];
      if (i == 0) before.angle -= kTurns;
      if (i + 1 == count) after.angle += kTurns;
      if (here.IsPositive() != after.IsPositive()) {
        brackets.push_back({.low = here, .middle = here, .high = after, .crosses = true});
      } else if (here.IsPositive() == before.IsPositive() &&
                 std::abs(here.value) <= std::min(std::abs(before.value), std::abs(after.value))) {
        brackets.push_back({.low = before, .middle = here, .high = after, .crosses = false});
      }
    }
    return brackets;
  }

  // Narrows each bracket by one sample. A few rounds suffice, because the caller refines solutions.
  void Narrow(std::vector<Bracket>& brackets) const {
    std::vector<double> angles;
    for (const Bracket& bracket : brackets) angles.push_back(bracket.Next());
    const std::vector<Sample> samples = SamplesAt(angles);
    for (std::size_t i = 0; i < samples.size(); ++i) {
      if (brackets[i].crosses) {
        brackets[i].Cross(samples[i]);
      } else if (samples[i].IsPositive() == brackets[i].middle.IsPositive()) {
        brackets[i].Lower(samples[i]);
      } else {
        brackets.push_back({samples[i], samples[i], brackets[i].high, true});
        brackets[i] = {brackets[i].low, samples[i], samples[i], true};
      }
    }
  }

  // At every angle the matrix has at most the rank 8, so that there is a vector that it maps to 0.
  // The reason is that both sides of the equation in elimination.h are motions, and that the dual
  // quaternion of every motion satisfies Study's condition. One combination of the nine linear
  // equations says only that this condition holds, so it holds for all angles.
  std::vector<Sample> SamplesAt(const std::vector<double>& angles) const {
    std::vector<Sample> samples(angles.size());
    for (std::size_t first = 0; first < angles.size(); first += kAngleBatch) {
      const std::size_t count = std::min(kAngleBatch, angles.size() - first);
      AngleRow batch = {};
      std::copy_n(angles.begin() + static_cast<std::ptrdiff_t>(first), count, batch.begin());
      const std::array<AngleRow, 9> vectors = NullVectors(matrix_, batch);
      for (std::size_t k = 0; k < count; ++k) {
        Sample& sample = samples[first + k];
        sample.angle = batch[k];
        for (int i = 0; i < 9; ++i) sample.squares[i] = vectors[static_cast<std::size_t>(i)][k];
        sample.squares.normalize();
        sample.value = Misfit(sample.squares);
      }
    }
    return samples;
  }

  // The vector has nine products of squares and products of the functions of two half angles.
  void AddSolution(const Sample& sample) {
    const double angle = sample.angle;
    const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> table(
        sample.squares.data());
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
  HalfAngleMatrix matrix_;
  std::vector<SixAngles> found_;
};

}  // namespace

std::vector<SixAngles> SolveByElimination(const SixAxes& axes, const SearchedJoint& joint,
                                          const Pose& motion) {
  return Eliminator(axes, joint, motion).Solve();
}

}  // namespace assay::kinematics
