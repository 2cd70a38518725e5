#include "planner/algebra/multiaffine/trigonometric_polynomial.h"

#include <gtest/gtest.h>

#include <cmath>

#include "planner/base/random.h"

namespace assay::algebra::trigonometric_polynomial_test {
namespace {

constexpr int kAngles = 3;
constexpr double kRounding = 1e-12;
constexpr double kStep = 1e-4;  // step of second differences
const std::vector<int> kCosines = {0, 2, 4};

using Point = std::vector<double>;

// A random sum of products. Each product has the sine, the cosine or nothing of each angle.
struct Products {
  std::vector<NestedForm::Term> terms;
  NestedForm form;

  explicit Products(RandomStream& random) {
    for (int code = 0; code < 27; ++code) {
      NestedForm::AtomSet set = 0;
      for (int angle = 0, rest = code; angle < kAngles; ++angle, rest /= 3) {
        if (rest % 3 != 0) set |= NestedForm::SetOf(kCosines[angle] + rest % 3 - 1);
      }
      if (random.Index(2) == 0) terms.push_back({set, random.Uniform(-2, 2)});
    }
    form.Assign(terms);
  }

  double At(const Point& angles) const {
    std::vector<double> atoms;
    for (const double angle : angles) {
      atoms.push_back(std::cos(angle));
      atoms.push_back(std::sin(angle));
    }
    NestedEvaluation<double> evaluation;
    return evaluation.Value(form, atoms);
  }

  double Slope(Point angles, int i) const {
    angles[i] += kStep;
    const double after = At(angles);
    angles[i] -= 2 * kStep;
    return (after - At(angles)) / (2 * kStep);
  }

  // Returns the second derivative along a direction.
  double Curvature(const Point& angles, const Point& direction) const {
    Point before = angles;
    Point after = angles;
    for (int i = 0; i < kAngles; ++i) {
      before[i] -= kStep * direction[i];
      after[i] += kStep * direction[i];
    }
    return (At(before) - 2 * At(angles) + At(after)) / (kStep * kStep);
  }
};

std::vector<numeric::NearestInterval> RandomBox(double widest, RandomStream& random) {
  std::vector<numeric::NearestInterval> box;
  for (int i = 0; i < kAngles; ++i) {
    const double low = random.Uniform(-4, 4);
    box.emplace_back(low, low + random.Uniform(0, widest));
  }
  return box;
}

Point Within(const std::vector<numeric::NearestInterval>& box, RandomStream& random) {
  Point point;
  for (const numeric::NearestInterval& x : box) point.push_back(random.Uniform(x.low, x.high));
  return point;
}

TrigonometricPolynomial PolynomialOf(const Products& products) {
  TrigonometricPolynomial sum;
  EXPECT_TRUE(sum.Assign(products.form, kCosines));
  EXPECT_LT(sum.left_out(), 1e-12);
  return sum;
}

TEST(TrigonometricPolynomial, HasTheValuesOfTheProducts) {
  RandomStream random(1, "waves");
  for (int i = 0; i < 100; ++i) {
    const Products products(random);
    const TrigonometricPolynomial sum = PolynomialOf(products);
    const Point point = Within(RandomBox(0, random), random);
    TrigonometricEvaluation evaluation;
    evaluation.Enter(sum, std::vector<numeric::NearestInterval>(point.begin(), point.end()));
    EXPECT_NEAR(evaluation.range().low, products.At(point), kRounding);
    EXPECT_NEAR(evaluation.range().high, products.At(point), kRounding);
  }
}

TEST(TrigonometricPolynomial, RangesHoldValuesSlopesAndCurvatures) {
  RandomStream random(2, "wave ranges");
  for (int i = 0; i < 200; ++i) {
    const Products products(random);
    const std::vector<numeric::NearestInterval> box = RandomBox(i % 2 == 0 ? 0.3 : 2, random);
    TrigonometricEvaluation evaluation;
    evaluation.Enter(PolynomialOf(products), box);
    for (int sample = 0; sample < 20; ++sample) {
      const Point point = Within(box, random);
      EXPECT_LE(evaluation.range().low, products.At(point) + kRounding);
      EXPECT_GE(evaluation.range().high, products.At(point) - kRounding);
      for (int angle = 0; angle < kAngles; ++angle) {
        EXPECT_LE(evaluation.Slope(angle).low, products.Slope(point, angle) + 1e-6);
        EXPECT_GE(evaluation.Slope(angle).high, products.Slope(point, angle) - 1e-6);
        Point along(kAngles, 0);
        along[angle] = 1;
        EXPECT_LE(evaluation.LeastCurvature(angle), products.Curvature(point, along) + 1e-5);
      }
    }
  }
}

TEST(TrigonometricPolynomial, NoDirectionBendsMoreThanTheGreatestCurvature) {
  RandomStream random(3, "wave curvature");
  for (int i = 0; i < 100; ++i) {
    const Products products(random);
    const std::vector<numeric::NearestInterval> box = RandomBox(0.5, random);
    TrigonometricEvaluation evaluation;
    evaluation.Enter(PolynomialOf(products), box);
    const numeric::SymmetricMatrix& greatest = evaluation.greatest_curvature();
    for (int sample = 0; sample < 20; ++sample) {
      const Point direction = {random.Uniform(-1, 1), random.Uniform(-1, 1), random.Uniform(-1, 1)};
      double most = 0;
      for (int k = 0; k < kAngles; ++k) {
        for (int j = 0; j < kAngles; ++j) {
          most += direction[k] * direction[j] * greatest(std::max(k, j), std::min(k, j));
        }
      }
      EXPECT_GE(most, products.Curvature(Within(box, random), direction) - 1e-5);
    }
  }
}

// The products hide that cos(s) cos(t) - sin(s) sin(t) = cos(s + t).
TEST(TrigonometricPolynomial, KnowsSumsOfAngles) {
  std::vector<NestedForm::Term> terms = {{NestedForm::SetOf(0) | NestedForm::SetOf(2), 1},
                                         {NestedForm::SetOf(1) | NestedForm::SetOf(3), -1}};
  NestedForm form;
  form.Assign(terms);
  TrigonometricPolynomial sum;
  ASSERT_TRUE(sum.Assign(form, std::vector<int>{0, 2}));
  TrigonometricEvaluation evaluation;
  evaluation.Enter(sum, std::vector<numeric::NearestInterval>{{0.1, 0.4}, {0.2, 0.3}});
  EXPECT_NEAR(evaluation.range().low, std::cos(0.7), kRounding);
  EXPECT_NEAR(evaluation.range().high, std::cos(0.3), kRounding);
}

}  // namespace
}  // namespace assay::algebra::trigonometric_polynomial_test
