#include "planner/algebra/expression/transform.h"
#include "planner/algebra/expression/evaluation.h"
#include "planner/algebra/expression/parse.h"
#include "planner/algebra/normal_forms/normalization.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "planner/algebra/expression/simplify.h"
#include "planner/algebra/expression/text.h"
#include "planner/algebra/normal_forms/normal_form.h"
#include "planner/base/random.h"

namespace assay::algebra::transform_test {
namespace {

using Matrix = std::array<std::array<double, 4>, 4>;

Matrix ValueOf(const Transform& t, std::span<const double> point) {
  Matrix m = {};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) m[i][j] = Evaluate(t.rotation[i][j], point);
    m[i][3] = Evaluate(t.translation[i], point);
  }
  m[3][3] = 1;
  return m;
}

Matrix Multiplied(const Matrix& a, const Matrix& b) {
  Matrix m = {};
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      for (std::size_t k = 0; k < 4; ++k) m[i][j] += a[i][k] * b[k][j];
    }
  }
  return m;
}

void ExpectNear(const Matrix& a, const Matrix& b) {
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) EXPECT_NEAR(a[i][j], b[i][j], 1e-12);
  }
}

// Returns a rotation by Rodrigues' formula, computed independently of the three elementary
// rotations.
Matrix RotationAbout(std::size_t axis, double angle) {
  Matrix m = {};
  const std::size_t u = (axis + 1) % 3;
  const std::size_t v = (axis + 2) % 3;
  m[axis][axis] = m[3][3] = 1;
  m[u][u] = m[v][v] = std::cos(angle);
  m[v][u] = std::sin(angle);
  m[u][v] = -std::sin(angle);
  return m;
}

class TransformTest : public testing::Test {
 protected:
  Expression Declare(const std::string& name) { return pool_.Declare(name, {-2, 2}); }

  std::vector<double> DrawPoint() {
    std::vector<double> point;
    for (int i = 0; i < pool_.variable_count(); ++i) point.push_back(random_.Uniform(-2, 2));
    return point;
  }

  ExpressionPool pool_;
  RandomStream random_{1, "transforms"};
  Expression a_ = Declare("a"), b_ = Declare("b"), c_ = Declare("c");
  Expression x_ = Declare("x"), y_ = Declare("y"), z_ = Declare("z");
  Transform first_ = Translation({x_, y_, z_}) * RotationZ(a_) * RotationX(b_);
  Transform second_ = RotationY(c_) * Translation({y_, 1, x_* z_});
  Transform third_ = RotationX(a_) * Translation({c_, 0, z_});
};

TEST_F(TransformTest, ElementaryRotations) {
  for (int i = 0; i < 20; ++i) {
    const std::vector<double> point = DrawPoint();
    ExpectNear(ValueOf(RotationX(a_), point), RotationAbout(0, point[0]));
    ExpectNear(ValueOf(RotationY(b_), point), RotationAbout(1, point[1]));
    ExpectNear(ValueOf(RotationZ(c_), point), RotationAbout(2, point[2]));
  }
}

TEST_F(TransformTest, ComposesLikeMatrices) {
  for (int i = 0; i < 20; ++i) {
    const std::vector<double> point = DrawPoint();
    const Matrix product = Multiplied(ValueOf(first_, point), ValueOf(second_, point));
    ExpectNear(ValueOf(first_ * second_, point), product);
    ExpectNear(ValueOf(Simplify(first_ * second_), point), product);
    ExpectNear(ValueOf(first_ * (second_ * third_), point),
               ValueOf((first_ * second_) * third_, point));
  }
}

TEST_F(TransformTest, AppliesToPoints) {
  const SymbolicVector p = {x_, c_, 1};
  const SymbolicVector moved = first_ * (second_ * p);
  const SymbolicVector at_once = (first_ * second_) * p;
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(NormalFormOf(moved[i]), NormalFormOf(at_once[i]));
  const SymbolicVector sum = SymbolicVector{1, 2, 3} + SymbolicVector{x_, y_, z_};
  EXPECT_EQ(Simplify(Dot(sum - SymbolicVector{x_, y_, z_}, {1, 10, 100})), Expression(321));
}

TEST_F(TransformTest, InverseTimesItselfIsTheIdentity) {
  for (const Transform& t : {first_, second_, first_ * second_, first_ * second_ * third_}) {
    for (const Transform& identity : {Simplify(Inverse(t) * t), Simplify(t * Inverse(t))}) {
      for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
          EXPECT_EQ(identity.rotation[i][j], Expression(i == j ? 1 : 0))
              << Text(identity.rotation[i][j]);
        }
        EXPECT_EQ(identity.translation[i], Expression(0)) << Text(identity.translation[i]);
      }
    }
  }
}

// The pickup of Spar's worked example ("Satisfying Uncertainty-Reduction Goals"). The gripper's y
// axis lies along the world's x axis, and its z axis points down. The origin of the grasp is (1.5,
// 1) in the frame of the object. The gripper is 4 wide, and the object is 3 wide where it is held.
TEST(WorkedExample, GivesThePublishedExpression) {
  ExpressionPool pool;
  const auto declare = [&](const char* name) { return pool.Declare(name, {-1, 1}); };
  const Expression thetagr = declare("thetagr"), dxgr = declare("dxgr"), dygr = declare("dygr");
  const Expression dzgr = declare("dzgr"), theta_o = declare("theta_o"), dx_o = declare("dx_o");
  const Expression dy_o = declare("dy_o"), dz_o = declare("dz_o");
  const Expression x = declare("x"), y = declare("y"), z = declare("z");

  const Transform object = Translation({x, y, z});
  const Transform possible_object = Translation({dx_o, dy_o, dz_o}) * object * RotationZ(theta_o);
  const Transform grasp = {.rotation = {{{0, 1, 0}, {1, 0, 0}, {0, 0, -1}}},
                           .translation = {1.5, 1, 0}};
  const Transform gripper_error = Translation({dxgr, dygr, dzgr}) * RotationZ(thetagr);
  const auto finger = [&](double side) {
    return object * grasp * gripper_error * Translation({0, side * 4 / 2, 0});
  };
  const auto contact = [&](double side) {
    return possible_object * grasp * SymbolicVector{0, side * 3 / 2, 0};
  };

  const std::string rest =
      " + 3*cos(thetagr)*cos(theta_o) + cos(thetagr)*dx_o + sin(thetagr) + sin(thetagr)*dxgr"
      " - cos(thetagr)*sin(theta_o) - 1.5*cos(thetagr) - 3*sin(thetagr)*sin(theta_o)"
      " - cos(theta_o)*sin(thetagr) - sin(thetagr)*dy_o - cos(thetagr)*dygr";
  const auto published = [&](const std::string& leading) {
    return NormalFormOf(Parse(leading + rest, pool, {}));
  };
  // The contact at the edge of the object is seen from each finger.
  const NormalForm from_first = NormalFormOf((Inverse(finger(-1)) * contact(1))[1]);
  EXPECT_EQ(from_first, published("2"));
  EXPECT_EQ(from_first.terms.size(), 11U);
  EXPECT_EQ(NormalFormOf((Inverse(finger(1)) * contact(1))[1]), published("-2"));
}

}  // namespace
}  // namespace assay::algebra::transform_test
