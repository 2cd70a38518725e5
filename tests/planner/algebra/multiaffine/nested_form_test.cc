#include "planner/algebra/multiaffine/nested_form.h"

#include <gtest/gtest.h>

#include <cmath>

#include "planner/base/random.h"
#include "planner/numeric/nearest_interval.h"

namespace assay::algebra::nested_form_test {
namespace {

constexpr int kAtoms = 6;
constexpr double kRounding = 1e-12;
using Terms = std::vector<NestedForm::Term>;

Terms RandomTerms(RandomStream& random) {
  Terms terms;
  for (NestedForm::AtomSet set = 0; set < 1U << kAtoms; ++set) {
    if (random.Index(3) == 0) {
      terms.push_back({set << (NestedForm::kMostAtoms - kAtoms), random.Uniform(-2, 2)});
    }
  }
  return terms;
}

NestedForm Nested(Terms terms) {
  NestedForm form;
  form.Assign(terms);
  return form;
}

std::vector<double> RandomPlace(RandomStream& random) {
  std::vector<double> place;
  for (int i = 0; i < kAtoms; ++i) place.push_back(random.Uniform(-1, 1));
  return place;
}

// Returns the sum term by term, as the oracle.
double Sum(const Terms& terms, const std::vector<double>& place) {
  double sum = 0;
  for (const NestedForm::Term& term : terms) {
    double product = term.coefficient;
    for (int atom = 0; atom < kAtoms; ++atom) {
      if ((term.atoms & NestedForm::SetOf(atom)) != 0) product *= place[atom];
    }
    sum += product;
  }
  return sum;
}

// Returns the slope along an atom as a difference, because the form is affine in each atom.
double Slope(const Terms& terms, std::vector<double> place, int atom) {
  place[atom] = 1;
  const double at_one = Sum(terms, place);
  place[atom] = 0;
  return at_one - Sum(terms, place);
}

TEST(NestedForm, IsTheSumOfItsTerms) {
  RandomStream random(1, "nested");
  for (int i = 0; i < 100; ++i) {
    const Terms terms = RandomTerms(random);
    const std::vector<double> place = RandomPlace(random);
    NestedEvaluation<double> evaluation;
    EXPECT_NEAR(evaluation.Value(Nested(terms), place), Sum(terms, place), kRounding);
  }
}

TEST(NestedForm, MergesEqualProducts) {
  const NestedForm::AtomSet x = NestedForm::SetOf(0);
  const NestedForm form = Nested({{x, 2}, {0, 1}, {x, 3}});
  NestedEvaluation<double> evaluation;
  EXPECT_EQ(evaluation.Value(form, std::vector<double>{10}), 51);
}

TEST(NestedForm, OfNoTermsIsZero) {
  NestedEvaluation<double> evaluation;
  EXPECT_EQ(evaluation.Value(Nested({}), std::vector<double>{3}), 0);
  EXPECT_EQ(evaluation.Slopes(Nested({}), std::vector<double>{3}), std::vector<double>{0});
}

TEST(NestedForm, SlopesAreThoseOfTheTerms) {
  RandomStream random(2, "slopes");
  for (int i = 0; i < 100; ++i) {
    const Terms terms = RandomTerms(random);
    const NestedForm form = Nested(terms);
    const std::vector<double> place = RandomPlace(random);
    NestedEvaluation<double> evaluation;
    evaluation.Value(form, place);
    const std::vector<double> slopes = evaluation.Slopes(form, place);
    for (int atom = 0; atom < kAtoms; ++atom) {
      EXPECT_NEAR(slopes[atom], Slope(terms, place, atom), kRounding);
    }
  }
}

// If only one atom varies, each slope is an affine function of this atom. The difference of two
// values of a slope is therefore its rate of change.
TEST(NestedForm, SlopesAlongATangentAreTheirChange) {
  RandomStream random(3, "along");
  for (int i = 0; i < 100; ++i) {
    const Terms terms = RandomTerms(random);
    const NestedForm form = Nested(terms);
    std::vector<double> place = RandomPlace(random);
    const int along = random.Index(kAtoms);
    std::vector<double> tangent(kAtoms, 0);
    tangent[along] = 1;
    NestedEvaluation<double> evaluation;
    evaluation.Value(form, place);
    evaluation.Slopes(form, place);
    const std::vector<double> change = evaluation.SlopesAlong(form, place, tangent);
    for (int atom = 0; atom < kAtoms; ++atom) {
      const double before = Slope(terms, place, atom);
      std::vector<double> next = place;
      next[along] += 1;
      const double after = Slope(terms, next, atom);
      EXPECT_NEAR(change[atom], atom == along ? 0 : after - before, kRounding);
    }
  }
}

TEST(NestedForm, RangesHoldTheValuesAndSlopesInTheBox) {
  RandomStream random(4, "ranges");
  for (int i = 0; i < 100; ++i) {
    const Terms terms = RandomTerms(random);
    const NestedForm form = Nested(terms);
    std::vector<numeric::NearestInterval> box;
    for (const double x : RandomPlace(random)) box.emplace_back(x, x + random.Uniform());
    NestedEvaluation<numeric::NearestInterval> evaluation;
    const numeric::NearestInterval range = evaluation.Value(form, box);
    const std::vector<numeric::NearestInterval> slopes = evaluation.Slopes(form, box);
    for (int sample = 0; sample < 20; ++sample) {
      std::vector<double> place;
      for (const numeric::NearestInterval& x : box) place.push_back(random.Uniform(x.low, x.high));
      EXPECT_LE(range.low, Sum(terms, place) + kRounding);
      EXPECT_GE(range.high, Sum(terms, place) - kRounding);
      const int atom = random.Index(kAtoms);
      EXPECT_LE(slopes[atom].low, Slope(terms, place, atom) + kRounding);
      EXPECT_GE(slopes[atom].high, Slope(terms, place, atom) - kRounding);
    }
  }
}

TEST(NestedReduction, PutsInWhatIsKnown) {
  RandomStream random(5, "reduction");
  for (int i = 0; i < 100; ++i) {
    const Terms terms = RandomTerms(random);
    const std::vector<double> place = RandomPlace(random);
    const NestedForm::AtomSet free = NestedForm::SetOf(1) | NestedForm::SetOf(4);
    NestedReduction reduction;
    NestedForm reduced;
    const NestedForm::AtomSet left = reduction.Reduce(Nested(terms), -1, free, place, reduced);
    EXPECT_EQ(left & ~free, 0U);
    EXPECT_LE(reduced.node_count(), 2);  // at most four products remain
    std::vector<double> elsewhere(kAtoms, std::nan(""));
    elsewhere[1] = place[1];
    elsewhere[4] = place[4];
    NestedEvaluation<double> evaluation;
    EXPECT_NEAR(evaluation.Value(reduced, elsewhere), -Sum(terms, place), kRounding);
  }
}

}  // namespace
}  // namespace assay::algebra::nested_form_test
