#include "planner/algebra/sup_inf/linear_sup_inf.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "planner/algebra/sup_inf/linear_program.h"
#include "planner/base/random.h"
#include "planner/numeric/interval_arithmetic.h"
#include "tests/planner/algebra/random_linear_programs.h"

namespace assay::algebra::linear_sup_inf_test {
namespace {

using testing::ElementsAre;

const ColumnId kX(0), kY(1), kZ(2);

LinearForm Form(const std::map<ColumnId, numeric::Rational>& coefficients,
                const numeric::Rational& constant) {
  return {.coefficients = coefficients, .constant = constant};
}

TEST(Supp, SolvesForTheColumn) {
  EXPECT_THAT(Supp(kX, Form({{kX, 0.5}}, 1)).Forms(), ElementsAre(Form({}, 2)));
  EXPECT_THAT(Supp(kX, Form({{kY, 3}}, 1)).Forms(), ElementsAre(Form({{kY, 3}}, 1)));
  EXPECT_THAT(Supp(kX, Form({{kX, -1}, {kY, 3}}, 1)).Forms(), ElementsAre(Form({{kY, 1.5}}, 0.5)));
}

TEST(Supp, KnowsWhatSaysNothing) {
  EXPECT_TRUE(Supp(kX, Form({{kX, 1}}, 0)).IsInfinite());
  EXPECT_TRUE(Supp(kX, Form({{kX, 1}}, 1)).IsInfinite());
  EXPECT_TRUE(Supp(kX, Form({{kX, 1}, {kY, 1}}, -1)).IsInfinite());
  EXPECT_TRUE(Supp(kX, Form({{kX, 2}}, -5)).IsInfinite());
  EXPECT_TRUE(Supp(kX, Form({{kX, 1}}, -1)).IsContradiction());
}

std::vector<LinearForm> RowsOf(const oracle::LinearProgram& program) {
  std::vector<LinearForm> rows;
  for (std::size_t v = 0; v < program.box.size(); ++v) {
    const auto [low, high] = program.box[v];
    if (std::isfinite(high)) rows.push_back(Form({{ColumnId(v), 1}}, -high));
    if (std::isfinite(low)) rows.push_back(Form({{ColumnId(v), -1}}, low));
  }
  for (const oracle::LinearProgram::Row& row : program.rows) {
    LinearForm form{.constant = -row.upper};
    for (std::size_t v = 0; v < row.coefficients.size(); ++v) {
      form.Add(ColumnId(v), row.coefficients[v]);
    }
    rows.push_back(form);
  }
  return rows;
}

LinearForm ObjectiveOf(const oracle::LinearProgram& program) {
  LinearForm form;
  for (std::size_t v = 0; v < program.objective.size(); ++v) {
    form.Add(ColumnId(v), program.objective[v]);
  }
  return form;
}

double GreatestOf(const oracle::Maximum& maximum) {
  switch (maximum.kind) {
    case oracle::Maximum::Kind::kFinite:
      return oracle::RoundedUp(maximum.value);
    case oracle::Maximum::Kind::kUnbounded:
      return kInfinity;
    case oracle::Maximum::Kind::kContradiction:
      return -kInfinity;
  }
  return 0;
}

double GreatestOf(const LinearOptimum& optimum) {
  switch (optimum.kind) {
    case LinearOptimum::Kind::kFinite:
      return optimum.value.RoundedUp();
    case LinearOptimum::Kind::kUnbounded:
      return kInfinity;
    case LinearOptimum::Kind::kContradiction:
      return -kInfinity;
  }
  return 0;
}

struct Size {
  int variables;
  int rows;
  int systems;
};

class AgainstGlpk : public testing::TestWithParam<Size> {};

// The answer is the exact value, rounded. This holds for the recursion and, with a limit of one
// step, for the simplex method. Contradictory systems are compared only between GLPK and the
// simplex method.
TEST_P(AgainstGlpk, SupIsExact) {
  const auto [variables, rows, systems] = GetParam();
  RandomStream random(2026, "linear-sup-inf");
  int finite = 0, unbounded = 0;
  for (int system = 0; system < systems; ++system) {
    const oracle::LinearProgram program = RandomLinearProgram(random, variables, rows);
    const oracle::Maximum expected = oracle::Maximize(program);
    const std::vector<LinearForm> at_most_zero = RowsOf(program);
    const LinearForm objective = ObjectiveOf(program);
    ASSERT_EQ(GreatestOf(Maximize(objective, at_most_zero)), GreatestOf(expected)) << system;
    if (expected.kind == oracle::Maximum::Kind::kContradiction) continue;
    ++(expected.kind == oracle::Maximum::Kind::kFinite ? finite : unbounded);
    for (const int most_steps : {1, LinearSupInf::kMostSteps}) {
      const LinearSupInf core(at_most_zero, most_steps);
      ASSERT_EQ(core.Sup(objective, {}).Greatest(), GreatestOf(expected)) << system;
    }
  }
  EXPECT_GT(finite, systems / 10);
  EXPECT_GT(unbounded, systems / 50);
}

INSTANTIATE_TEST_SUITE_P(Small, AgainstGlpk,
                         testing::Values(Size{2, 3, 1000}, Size{3, 3, 800}, Size{3, 6, 800},
                                         Size{4, 5, 600}, Size{5, 5, 400}));
// Most of these systems use up the steps of the recursion.
INSTANTIATE_TEST_SUITE_P(Larger, AgainstGlpk, testing::Values(Size{7, 12, 30}));

// With a limit that is never reached, the recursion alone is exact, without the simplex method.
TEST(LinearSupInf, IsExactWithoutTheSimplexMethod) {
  RandomStream random(2026, "recursion");
  for (int system = 0; system < 500; ++system) {
    const oracle::LinearProgram program = RandomLinearProgram(random, 3, 5);
    const oracle::Maximum expected = oracle::Maximize(program);
    if (expected.kind == oracle::Maximum::Kind::kContradiction) continue;
    const LinearSupInf core(RowsOf(program), 1'000'000'000);
    ASSERT_EQ(core.Sup(ObjectiveOf(program), {}).Greatest(), GreatestOf(expected)) << system;
  }
}

// The system is x + y over y <= x, y <= 4 - 2x, 0 <= x <= 2. The greatest value is at (4/3, 4/3),
// where the least of two bounds on y is greatest.
TEST(LinearSupInf, SumsAreExact) {
  const std::vector<LinearForm> rows = {Form({{kY, 1}, {kX, -1}}, 0), Form({{kY, 1}, {kX, 2}}, -4),
                                        Form({{kX, -1}}, 0), Form({{kX, 1}}, -2)};
  EXPECT_THAT(LinearSupInf(rows, 1'000'000).Sup(Form({{kX, 1}, {kY, 1}}, 0), {}).Forms(),
              ElementsAre(Form({}, numeric::Rational(8) / 3)));
}

// Where the rows hold, each kept bound bounds the form. The answer contains only kept columns.
TEST(LinearSupInf, KeptColumnsBound) {
  RandomStream random(2026, "kept");
  int symbolic = 0;
  for (int system = 0; system < 500; ++system) {
    const oracle::LinearProgram program = RandomLinearProgram(random, 3, 4);
    const std::vector<LinearForm> rows = RowsOf(program);
    const LeastOf sup = LinearSupInf(rows).Sup(ObjectiveOf(program), {kZ});
    for (const LinearForm& form : sup.Forms()) {
      symbolic += form.IsConstant() ? 0 : 1;
      ASSERT_TRUE(form.Without(kZ).IsConstant());
      // The form minus the bound is positive nowhere.
      const double worst = GreatestOf(Maximize(ObjectiveOf(program) - form, rows));
      ASSERT_LE(worst, 0) << system;
    }
  }
  EXPECT_GT(symbolic, 100);
}

}  // namespace
}  // namespace assay::algebra::linear_sup_inf_test
