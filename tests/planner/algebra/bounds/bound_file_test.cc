#include "planner/algebra/bounds/bound_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "planner/algebra/sup_inf/sup_inf.h"
#include "planner/base/input_files/input_error.h"
#include "planner/numeric/interval_arithmetic.h"

namespace assay::algebra::bound_file_test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

BoundProblem Read(const std::string& text) { return ReadBoundProblem(text, "file"); }

std::string ErrorOf(const std::string& text) {
  try {
    Read(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

std::string ErrorOfEnds(const std::string& ends) {
  return ErrorOf("variables: {x: " + ends + "}\nexpressions: [x]");
}

TEST(BoundFile, ReadsJson) {
  const BoundProblem problem = Read(
      R"({"variables": {"x": [-0.0, 4e-1], "t": ["-5.5 deg", "5.5 deg"], "u": ["-inf", "inf"]},
          "constraints": ["x <= t + 1", "2*x >= u", "x == t"], "expressions": ["3*cos(t) + x", "7"]})");
  EXPECT_EQ(problem.pool->variable_count(), 3);
  EXPECT_EQ(problem.constraints.box[0], (Interval{0, 0.4}));
  EXPECT_EQ(problem.constraints.box[2], kWholeLine);
  ASSERT_EQ(problem.questions.size(), 2);
  EXPECT_EQ(problem.questions[0].text, "3*cos(t) + x");
  const Expression x = problem.pool->Variable(VariableId(0)),
                   t = problem.pool->Variable(VariableId(1)),
                   u = problem.pool->Variable(VariableId(2));
  EXPECT_EQ(problem.questions[0].expression, 3 * Cos(t) + x);
  const std::vector<Inequality>& inequalities = problem.constraints.inequalities;
  ASSERT_EQ(inequalities.size(), 4);
  EXPECT_EQ(inequalities[0].lesser, x);
  EXPECT_EQ(inequalities[0].greater, t + 1);
  EXPECT_EQ(inequalities[1].lesser, u);
  EXPECT_EQ(inequalities[2].lesser, x);
  EXPECT_EQ(inequalities[3].lesser, t);
}

TEST(BoundFile, ReadsYaml) {
  const BoundProblem problem =
      Read("variables: {x: [-1, inf], y: [0, 1]}\nconstraints: [x < y]\nexpressions: [x]\n");
  EXPECT_EQ(Sup(problem.questions[0].expression, {}, problem.constraints), Expression(1));
}

TEST(BoundFile, DegreesAreRoundedOutward) {
  const Interval t = Read("variables: {t: [-5.5 deg, 30deg]}\nexpressions: [t]").constraints.box[0];
  EXPECT_LE(t.low, -5.5L * std::numbers::pi_v<long double> / 180);
  EXPECT_GE(t.high, 30 * std::numbers::pi_v<long double> / 180);
  EXPECT_NEAR(t.low, -5.5 * std::numbers::pi / 180, 1e-16);
  EXPECT_NEAR(t.high, std::numbers::pi / 6, 1e-15);
}

TEST(BoundFile, RefusesWrongEnds) {
  EXPECT_THAT(ErrorOfEnds("[2, 1]"),
              AllOf(StartsWith("file:1:"), HasSubstr("is greater than the upper end")));
  EXPECT_THAT(ErrorOfEnds("[nan, 1]"), AllOf(StartsWith("file:1:17:"), HasSubstr("'nan'")));
  EXPECT_THAT(ErrorOfEnds("[0, 1e999]"), HasSubstr("1e999"));
  EXPECT_THAT(ErrorOfEnds("[0, 1 rad]"), HasSubstr("N deg"));
  EXPECT_THAT(ErrorOfEnds("[inf, inf]"), HasSubstr("no number"));
  EXPECT_THAT(ErrorOfEnds("[0]"), HasSubstr("1 ends"));
  EXPECT_THAT(ErrorOfEnds("3"), HasSubstr("list"));
}

TEST(BoundFile, RefusesWrongNames) {
  EXPECT_THAT(ErrorOf("variables: {2x: [0, 1]}\nexpressions: []"), HasSubstr("'2x'"));
  EXPECT_THAT(ErrorOf("variables: {sin: [0, 1]}\nexpressions: []"), HasSubstr("'sin'"));
  EXPECT_THAT(ErrorOf("variables: {x: [0, 1], x: [0, 1]}\nexpressions: []"), HasSubstr("twice"));
  EXPECT_THAT(ErrorOf("variables: {theta: [0, 1]}\nexpressions: [theat]"),
              AllOf(StartsWith("file:2:"), HasSubstr("theta")));
  EXPECT_THAT(ErrorOf("variables: {}\nexpression: []"), HasSubstr("expressions"));
}

TEST(BoundFile, RefusesWrongConstraints) {
  const auto error = [](const std::string& constraint) {
    return ErrorOf("variables: {x: [0, 1]}\nconstraints:\n  - " + constraint +
                   "\nexpressions: [x]");
  };
  EXPECT_EQ(error("x <= 1"), "no error");
  EXPECT_THAT(error("x + 1"), AllOf(StartsWith("file:3:5"), HasSubstr("compares nothing")));
  EXPECT_THAT(error("0 <= x <= 1"), HasSubstr("more than once"));
  EXPECT_THAT(error("x = 1"), HasSubstr("unknown sign ="));
  EXPECT_THAT(error("x <="), AllOf(StartsWith("file:3:9"), HasSubstr("missing")));
  EXPECT_THAT(error("x <= 1 + u"), StartsWith("file:3:14:"));
}

TEST(BoundFile, RefusesNoExpressions) {
  EXPECT_THAT(ErrorOf("variables: {x: [0, 1]}\nexpressions: []"),
              AllOf(StartsWith("file:2:14:"), HasSubstr("allowed: at least one")));
}

// The columns were counted by hand, in bytes from 1.
TEST(BoundFile, ColumnsOfWhatIsQuoted) {
  EXPECT_THAT(ErrorOf(R"({"variables":{"x":[0,1]},"expressions":["x + y"]})"),
              StartsWith("file:1:46: unknown variable 'y'"));
  EXPECT_THAT(ErrorOf("variables: {x: [0, 1]}\nexpressions: ['x + y']"), StartsWith("file:2:20: "));
  EXPECT_THAT(ErrorOf("variables: {x: [0, 1]}\nexpressions: [x + y]"), StartsWith("file:2:19: "));
  EXPECT_THAT(ErrorOf("\xef\xbb\xbfvariables: {x: [0, 1]}\r\nexpressions: [\"x + y\"]\r\n"),
              StartsWith("file:2:20: "));
  EXPECT_THAT(ErrorOf(R"({"variables":{"x":[0,1]},"constraints":["x <= 1 + u"],)"
                      R"("expressions":["x"]})"),
              StartsWith("file:1:51: unknown variable 'u'"));
  EXPECT_THAT(ErrorOf("variables: {x: [0, 1]}\nexpressions: ['(x + 1']"),
              HasSubstr("')' for the '(' in column 16"));
}

// For these texts the error has the place where the scalar begins. An offset within the text would
// be wrong.
TEST(BoundFile, TextsThatStandOtherwiseInTheFile) {
  const auto error = [](const std::string& rest) {
    return ErrorOf("variables: {x: [0, 1]}\n" + rest);
  };
  for (const std::string indicator : {"|", ">", ">-"}) {
    const std::string in_block = "expressions:\n  - " + indicator + "\n    x +\n    y\n";
    EXPECT_THAT(error(in_block),
                AllOf(StartsWith("file:3:5: character 5 of the expression: unknown variable 'y'")));
  }
  EXPECT_THAT(error("expressions:\n  - x +\n    y\n"), StartsWith("file:3:5: character 5 of"));
  EXPECT_THAT(error("expressions: [\"\\x78 + y\"]"), StartsWith("file:2:15: character 5 of"));
  EXPECT_THAT(error("constraints:\n  - |\n    x <=\n      (y\nexpressions: [x]\n"),
              StartsWith("file:3:5: character 2 of the expression: unknown variable 'y'"));
  EXPECT_THAT(error("expressions:\n  - |\n    (x + 1\n"),
              HasSubstr("')' for the '(' in character 1"));
}

TEST(BoundFile, FilesThatCannotBeReadAreTold) {
  const std::string none = ::testing::TempDir() + "none/none.yaml";
  for (const std::string& file : {none, ::testing::TempDir()}) {
    try {
      LoadBoundProblem(file);
      ADD_FAILURE() << file;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), StartsWith(file + ": "));
    }
  }
}

}  // namespace
}  // namespace assay::algebra::bound_file_test
