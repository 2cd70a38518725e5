#include "planner/kinematics/inverse/subproblems.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/base/random.h"
#include "planner/geometry/pose.h"
#include "planner/kinematics/inverse/trigonometric_roots.h"
#include "tests/oracle/random_pose.h"

namespace assay::kinematics::subproblems_test {
namespace {

using oracle::RandomVector;

constexpr double kPi = std::numbers::pi;
constexpr int kCases = 200;

Vector3 RandomDirection(RandomStream& random) { return RandomVector(random, 1).normalized(); }
double RandomAngle(RandomStream& random) { return random.Uniform(-kPi, kPi); }
JointAxis RandomAxis(RandomStream& random) {
  return {RandomDirection(random), RandomVector(random, 1)};
}

Vector3 Turned(const Vector3& k, double angle, const Vector3& p) {
  return Eigen::AngleAxisd(angle, k) * p;
}

// The least value of a function of an angle, on a dense grid that is refined around the best angle.
template <class Function>
double LeastOnGrid(const Function& f) {
  double best = 0;
  double least = f(0.0);
  double width = kPi;
  for (int round = 0; round < 6; ++round) {
    const double middle = best;
    for (int i = -200; i <= 200; ++i) {
      const double value = f(middle + width * i / 200);
      if (value >= least) continue;
      least = value;
      best = middle + width * i / 200;
    }
    width /= 50;
  }
  return least;
}

// The number of changes of sign of a function of an angle, on a dense grid.
template <class Function>
std::size_t CountRoots(const Function& f, int samples = 20000) {
  std::size_t roots = 0;
  double before = f(-kPi);
  for (int i = 1; i <= samples; ++i) {
    const double value = f(-kPi + 2 * kPi * i / samples);
    if ((value > 0) != (before > 0)) ++roots;
    before = value;
  }
  return roots;
}

bool Has(double angle, double known, double tolerance = 1e-7) {
  return std::abs(std::remainder(angle - known, 2 * kPi)) < tolerance;
}

template <std::size_t N, class List>
bool Contains(const List& found, const std::array<double, N>& known, double tolerance = 1e-5) {
  return std::any_of(found.begin(), found.end(), [&](const SubproblemAngles<N>& solution) {
    for (std::size_t i = 0; i < N; ++i) {
      if (!Has(solution.q[i], known[i], tolerance)) return false;
    }
    return true;
  });
}

TEST(TurnToVector, HasTheLeastDistance) {
  RandomStream random(1, "subproblem 1");
  for (int i = 0; i < kCases; ++i) {
    const Vector3 k = RandomDirection(random);
    const Vector3 p1 = RandomVector(random, 1);
    const bool exact = i % 2 == 0;
    const Vector3 p2 = exact ? Turned(k, RandomAngle(random), p1) : RandomVector(random, 1);
    const SubproblemAngles<1> found = TurnToVector(k, p1, p2);
    const auto distance = [&](double q) { return (Turned(k, q, p1) - p2).norm(); };
    EXPECT_EQ(found.exact, exact);
    EXPECT_FALSE(found.free);
    EXPECT_LT(distance(found.q[0]), LeastOnGrid(distance) + 1e-9);
  }
}

TEST(TurnToVector, IsFreeForVectorsOnTheAxis) {
  const Vector3 k = Vector3::UnitX();
  const SubproblemAngles<1> found = TurnToVector(k, 2 * k, 2 * k, 0.7);
  EXPECT_TRUE(found.free && found.exact);
  EXPECT_EQ(found.q[0], 0.7);
  EXPECT_FALSE(TurnToVector(k, 2 * k, 3 * k, 0.7).exact);
}

TEST(TurnTogether, FindsAllOrTheLeastDistance) {
  RandomStream random(2, "subproblem 2");
  for (int i = 0; i < kCases; ++i) {
    const Vector3 k1 = RandomDirection(random);
    const Vector3 k2 = RandomDirection(random);
    const Vector3 p1 = RandomVector(random, 1);
    const std::array<double, 2> known = {RandomAngle(random), RandomAngle(random)};
    const bool made = i % 2 == 0;
    const Vector3 p2 = made ? Turned(k2, -known[1], Turned(k1, known[0], p1))
                            : Vector3(RandomDirection(random) * p1.norm());
    const auto found = TurnTogether(k1, p1, k2, p2);
    if (made) {
      EXPECT_TRUE(Contains<2>(found, known));
    }
    // For each first angle, subproblem 1 gives the best second angle.
    const auto distance = [&](double q) {
      const Vector3 turned = Turned(k1, q, p1);
      return (turned - Turned(k2, TurnToVector(k2, p2, turned).q[0], p2)).norm();
    };
    const double least = LeastOnGrid(distance);
    for (const SubproblemAngles<2>& solution : found) {
      const double reached = (Turned(k1, solution.q[0], p1) - Turned(k2, solution.q[1], p2)).norm();
      EXPECT_LT(reached, least + 1e-8);
      EXPECT_EQ(solution.exact, least < 1e-8) << least;
    }
    EXPECT_EQ(found.size(), least < 1e-8 ? 2u : 1u);
  }
}

TEST(TurnTogether, IsFreeForParallelAxes) {
  const Vector3 k = Vector3(1, 2, 2) / 3;
  const Vector3 p(0.3, -0.2, 0.9);
  for (const double sign : {1.0, -1.0}) {
    const auto found = TurnTogether(k, p, sign * k, Turned(k, 0.4, p), {0.1, 0});
    ASSERT_EQ(found.size(), 1u);
    EXPECT_TRUE(found[0].free && found[0].exact);
    EXPECT_EQ(found[0].q[0], 0.1);
    EXPECT_NEAR(found[0].q[1], sign * -0.3, 1e-12);
  }
}

// Vectors beside an axis have a direction in spite of rounding.
TEST(TurnTogether, IsPreciseBesideAnAxis) {
  const Vector3 k1 = Vector3::UnitX();
  const Vector3 k2 = Vector3::UnitZ();
  for (const double tilt : {1e-3, 1e-6, 1e-9}) {
    const Vector3 p1 = Turned(k1, 0.3, k2);
    const Vector3 p2 = Turned(k2, 0.8, Turned(k1, tilt, k2));
    EXPECT_TRUE(Contains<2>(TurnTogether(k1, p1, k2, p2), {tilt - 0.3, -0.8}, 1e-6)) << tilt;
  }
}

TEST(TurnTogether, GivesATangencyOnce) {
  // Two cones of 45 degrees about axes at right angles touch each other.
  const double d = std::numbers::sqrt2 / 2;
  const auto found =
      TurnTogether(Vector3::UnitX(), Vector3(d, 0, d), Vector3::UnitY(), Vector3(0, d, d));
  ASSERT_FALSE(found.empty());
  for (const SubproblemAngles<2>& solution : found) {
    EXPECT_NEAR(
        (Turned(Vector3::UnitX(), solution.q[0], Vector3(d, 0, d)) - Vector3(d, d, 0)).norm(), 0,
        1e-7);
  }
}

// Expects the angles of all roots of an error, or if it has none, an angle at which it is least.
template <class Found, class Function>
void ExpectAllRootsOrTheLeast(const Found& found, const Function& error) {
  const std::size_t roots = CountRoots(error);
  EXPECT_EQ(found.size(), std::max<std::size_t>(roots, 1));
  const double least = LeastOnGrid([&](double q) { return std::abs(error(q)); });
  for (const SubproblemAngles<1>& solution : found) {
    EXPECT_EQ(solution.exact, roots > 0);
    EXPECT_LT(std::abs(error(solution.q[0])), least + 1e-9);
  }
}

TEST(TurnToHeight, FindsAllOrTheLeastError) {
  RandomStream random(4, "subproblem 4");
  for (int i = 0; i < kCases; ++i) {
    const Vector3 k = RandomDirection(random);
    const Vector3 p = RandomVector(random, 1);
    const Vector3 h = RandomDirection(random);
    const double height = random.Uniform(-1.2, 1.2);
    const auto found = TurnToHeight(k, p, h, height);
    const auto error = [&](double q) { return h.dot(Turned(k, q, p)) - height; };
    ExpectAllRootsOrTheLeast(found, error);
  }
}

TEST(TurnToDistance, FindsAllOrTheLeastError) {
  RandomStream random(3, "subproblem 3");
  for (int i = 0; i < kCases; ++i) {
    const Vector3 k = RandomDirection(random);
    const Vector3 p1 = RandomVector(random, 1);
    const Vector3 p2 = RandomVector(random, 1);
    const double distance = random.Uniform(0, 2);
    const auto found = TurnToDistance(k, p1, p2, distance);
    const auto error = [&](double q) { return (Turned(k, q, p1) - p2).norm() - distance; };
    ExpectAllRootsOrTheLeast(found, error);
  }
}

TEST(TurnToDistance, FindsATangency) {
  const auto found = TurnToDistance(Vector3::UnitZ(), Vector3(1, 0, 0), Vector3(0, 3, 0), 2);
  ASSERT_FALSE(found.empty());
  for (const SubproblemAngles<1>& solution : found) {
    EXPECT_TRUE(solution.exact);
    EXPECT_NEAR(solution.q[0], kPi / 2, 1e-7);
  }
}

double ErrorOf(const TwoAngleEquation& e, const std::array<double, 2>& q) {
  return e.cosine1 * std::cos(q[0]) + e.sine1 * std::sin(q[0]) + e.cosine2 * std::cos(q[1]) +
         e.sine2 * std::sin(q[1]) - e.value;
}

TwoAngleEquation RandomEquation(RandomStream& random, const std::array<double, 2>& q) {
  TwoAngleEquation e{random.Uniform(-1, 1), random.Uniform(-1, 1), random.Uniform(-1, 1),
                     random.Uniform(-1, 1), 0};
  e.value = ErrorOf(e, q);
  return e;
}

// Newton's method from a grid of starts, which knows nothing of the closed form.
std::vector<std::array<double, 2>> SearchTwoAngles(const std::array<TwoAngleEquation, 2>& e) {
  constexpr int kStarts = 16;
  std::vector<std::array<double, 2>> found;
  for (int start = 0; start < kStarts * kStarts; ++start) {
    std::array<double, 2> q = {2 * kPi * (start / kStarts) / kStarts,
                               2 * kPi * (start % kStarts) / kStarts};
    for (int step = 0; step < 30; ++step) {
      Eigen::Matrix2d slope;
      for (int i = 0; i < 2; ++i) {
        const TwoAngleEquation& at = e[static_cast<std::size_t>(i)];
        slope.row(i) << at.sine1 * std::cos(q[0]) - at.cosine1 * std::sin(q[0]),
            at.sine2 * std::cos(q[1]) - at.cosine2 * std::sin(q[1]);
      }
      const Eigen::Vector2d change =
          slope.partialPivLu().solve(Eigen::Vector2d(ErrorOf(e[0], q), ErrorOf(e[1], q)));
      const double length = std::max(1.0, change.norm());
      for (std::size_t i = 0; i < 2; ++i) q[i] -= change[static_cast<int>(i)] / length;
    }
    if (std::hypot(ErrorOf(e[0], q), ErrorOf(e[1], q)) < 1e-12) found.push_back(q);
  }
  return found;
}

TEST(SolveTwoAngles, FindsAll) {
  RandomStream random(6, "subproblem 6");
  for (int i = 0; i < kCases; ++i) {
    const std::array<double, 2> known = {RandomAngle(random), RandomAngle(random)};
    const std::array<TwoAngleEquation, 2> equations = {RandomEquation(random, known),
                                                       RandomEquation(random, known)};
    const auto found = SolveTwoAngles(equations);
    EXPECT_TRUE(Contains<2>(found, known)) << i;
    for (const SubproblemAngles<2>& solution : found) {
      if (!solution.exact) continue;
      for (const TwoAngleEquation& e : equations) EXPECT_LT(std::abs(ErrorOf(e, solution.q)), 1e-8);
    }
    for (const std::array<double, 2>& q : SearchTwoAngles(equations)) {
      EXPECT_TRUE(Contains<2>(found, q)) << i;
    }
  }
}

// Each row and column of coefficients in turn is 0, as it is where axes meet or are parallel.
TEST(SolveTwoAngles, FindsTheKnownAnglesOfDegenerateEquations) {
  RandomStream random(7, "subproblem 6");
  for (int i = 0; i < kCases; ++i) {
    const std::array<double, 2> known = {RandomAngle(random), RandomAngle(random)};
    std::array<TwoAngleEquation, 2> e = {RandomEquation(random, known),
                                         RandomEquation(random, known)};
    const int kind = i % 4;
    if (kind == 0) e[0].cosine1 = e[0].sine1 = 0;
    if (kind == 1) e[0].cosine2 = e[0].sine2 = 0;
    if (kind == 2) {
      e[0].cosine1 = e[0].sine1 = 0;
      e[1].cosine2 = e[1].sine2 = 0;
    }
    if (kind == 3) e[0].cosine1 = e[0].sine1 = e[1].cosine1 = e[1].sine1 = 0;
    for (TwoAngleEquation& equation : e) {
      equation.value = 0;
      equation.value = ErrorOf(equation, known);
    }
    const auto found = SolveTwoAngles(e, known);
    EXPECT_TRUE(Contains<2>(found, known)) << kind << ' ' << i;
    if (kind == 3) {
      EXPECT_TRUE(found[0].free);
    }
  }
}

// The first equation is about one angle alone, as for arms like those of Universal Robots. In
// common poses of their tools, both equations say nearly the same about this angle.
TEST(SolveTwoAngles, IsPreciseWhereBothEquationsSayTheSameAboutOneAngle) {
  RandomStream random(9, "subproblem 6");
  for (int i = 0; i < kCases; ++i) {
    const std::array<double, 2> known = {RandomAngle(random), RandomAngle(random)};
    std::array<TwoAngleEquation, 2> e = {RandomEquation(random, known),
                                         RandomEquation(random, known)};
    const double off = std::pow(10, random.Uniform(-12, -2));
    e[0].cosine1 = e[0].sine1 = 0;
    e[1].cosine2 = e[0].cosine2 + off * e[1].cosine2;
    e[1].sine2 = e[0].sine2 + off * e[1].sine2;
    for (TwoAngleEquation& equation : e) {
      equation.value = 0;
      equation.value = ErrorOf(equation, known);
    }
    EXPECT_TRUE(Contains<2>(SolveTwoAngles(e), known)) << i << ": " << off;
  }
}

// One equation twice leaves the first angle free.
TEST(SolveTwoAngles, TakesAFreeAngleFromTheReference) {
  RandomStream random(8, "subproblem 6");
  for (int i = 0; i < kCases; ++i) {
    const std::array<double, 2> known = {RandomAngle(random), RandomAngle(random)};
    const TwoAngleEquation e = RandomEquation(random, known);
    const auto found = SolveTwoAngles({e, e}, known);
    EXPECT_TRUE(Contains<2>(found, known));
    EXPECT_TRUE(found[0].free);
  }
}

Vector3 Product(const std::array<JointAxis, 3>& axes, const std::array<double, 3>& q,
                const Vector3& p) {
  return Turn(axes[0], q[0]) * (Turn(axes[1], q[1]) * (Turn(axes[2], q[2]) * p));
}

// Two of the axes in turn meet, are parallel, or are the same.
std::array<JointAxis, 3> AxesOfKind(int kind, RandomStream& random) {
  std::array<JointAxis, 3> axes = {RandomAxis(random), RandomAxis(random), RandomAxis(random)};
  if (kind == 1) axes[1].point = axes[0].point;
  if (kind == 2) axes[1].direction = axes[0].direction;
  if (kind == 3) axes[2].point = axes[1].point;
  if (kind == 4) axes[2].direction = -axes[1].direction;
  if (kind == 5) axes[0].direction = axes[1].direction = axes[2].direction = Vector3::UnitZ();
  if (kind == 6) axes[0].point = axes[1].point = axes[2].point;
  if (kind == 7) axes[1] = axes[0];
  return axes;
}

TEST(TurnToPoint, FindsTheKnownAnglesForAllKindsOfAxes) {
  RandomStream random(5, "subproblem 5");
  for (int i = 0; i < 4 * kCases; ++i) {
    const std::array<JointAxis, 3> axes = AxesOfKind(i % 8, random);
    const std::array<double, 3> known = {RandomAngle(random), RandomAngle(random),
                                         RandomAngle(random)};
    const Vector3 from = RandomVector(random, 1);
    const Vector3 to = Product(axes, known, from);
    // Where an angle is free, the known angles are the reference.
    const auto found = TurnToPoint(axes, from, to, known);
    EXPECT_TRUE(Contains<3>(found, known)) << "kind " << i % 8 << ", case " << i;
    for (const SubproblemAngles<3>& solution : found) {
      if (!solution.exact) continue;
      EXPECT_LT((Product(axes, solution.q, from) - to).norm(), 1e-7) << i % 8;
    }
  }
}

TEST(TurnToPoint, FindsNothingOutOfReach) {
  RandomStream random(9, "subproblem 5");
  for (int i = 0; i < kCases; ++i) {
    const std::array<JointAxis, 3> axes = AxesOfKind(i % 5, random);
    for (const SubproblemAngles<3>& solution :
         TurnToPoint(axes, RandomVector(random, 1), Vector3(30, 0, 0))) {
      EXPECT_FALSE(solution.exact);
    }
  }
}

TEST(RootsOf, FindsAllRootsOfTheFunction) {
  RandomStream random(10, "roots");
  for (int i = 0; i < kCases; ++i) {
    const TrigonometricQuadratic f{random.Uniform(-1, 1), random.Uniform(-1, 1),
                                   random.Uniform(-1, 1), random.Uniform(-1, 1),
                                   random.Uniform(-1, 1)};
    const auto roots = RootsOf(f);
    std::size_t exact = 0;
    for (const double root : roots) exact += std::abs(f.At(root)) < 1e-10 ? 1 : 0;
    EXPECT_EQ(exact, CountRoots([&](double x) { return f.At(x); })) << i;
  }
}

TEST(RootsOf, FindsDoubleRoots) {
  // (1 - cos(x - 1))^2 and (1 - cos(x - 1)) (1 - cos(x + 2))
  const auto product = [](double a, double b) {
    return TrigonometricQuadratic{1 + std::cos(a - b) / 2, -std::cos(a) - std::cos(b),
                                  -std::sin(a) - std::sin(b), std::cos(a + b) / 2,
                                  std::sin(a + b) / 2};
  };
  const auto roots = RootsOf(product(1, -2));
  for (const double root : {1.0, -2.0}) {
    EXPECT_TRUE(std::any_of(roots.begin(), roots.end(),
                            [&](double found) { return Has(found, root, 1e-6); }));
  }
  ASSERT_FALSE(RootsOf(product(1, 1)).empty());
  EXPECT_TRUE(Has(RootsOf(product(1, 1))[0], 1, 1e-3));
}

}  // namespace
}  // namespace assay::kinematics::subproblems_test
