#include "planner/algebra/expression/text.h"
#include "planner/algebra/expression/parse.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "tests/planner/algebra/random_expression.h"

namespace assay::algebra::text_test {
namespace {

class TextTest : public testing::Test {
 protected:
  Expression Read(std::string_view text) {
    return Parse(text, pool_, {.file = "bounds.json", .line = 3, .column = 10});
  }
  std::string ErrorOf(std::string_view text) {
    try {
      Read(text);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  }

  ExpressionPool pool_;
  Expression x_ = pool_.Declare("x", {-1, 2});
  Expression y_ = pool_.Declare("y", {0, 3});
  Expression tg_ = pool_.Declare("theta_g", {0, 1});
};

TEST_F(TextTest, WritesReadably) {
  EXPECT_EQ(Text(2 + 3 * Cos(tg_) * Power(x_, 2) - Min(x_, Sqrt(y_)) / 4),
            "2 + 3*cos(theta_g)*x^2 - min(x, sqrt(y))/4");
  EXPECT_EQ(Text(2 - 3 * x_), "2 - 3*x");
  EXPECT_EQ(Text(-x_ - y_), "-x - y");
  EXPECT_EQ(Text(-(x_ + y_)), "-(x + y)");
  EXPECT_EQ(Text(x_ * -2), "x*(-2)");
  EXPECT_EQ(Text(Power(pool_.Constant(-0.1), 3) + x_), "(-0.1)^3 + x");
  EXPECT_EQ(Text(x_ / (y_ * x_) * y_), "x/(y*x)*y");
  EXPECT_EQ(Text(y_ * (x_ / y_)), "y*(x/y)");
  EXPECT_EQ(Text(Power(Power(x_ + 1, -2), 3)), "((x + 1)^-2)^3");
  EXPECT_EQ(Text(0.1), "0.1");
  EXPECT_EQ(Text(-1e-7), "-1e-07");
}

TEST_F(TextTest, ReadsTheGrammar) {
  EXPECT_EQ(Read("2 + 3*cos(theta_g)*x^2 - min(x, sqrt(y))/4"),
            2 + 3 * Cos(tg_) * Power(x_, 2) - Min(x_, Sqrt(y_)) / 4);
  EXPECT_EQ(Read("2 + (-3)*x"), 2 - 3 * x_);
  EXPECT_EQ(Read("1*x"), x_);
  EXPECT_EQ(Read(" ( x ) "), x_);
  EXPECT_EQ(Read("-x^2"), -Power(x_, 2));
  EXPECT_EQ(Read("x*-y"), x_ * -y_);
  EXPECT_EQ(Read("x/y/2"), x_ / y_ / 2);
  EXPECT_EQ(Read("x - y - 1"), x_ - y_ - 1);
  EXPECT_EQ(Read("x^-2"), Power(x_, -2));
  EXPECT_EQ(Read("x^0"), Expression(1));
  EXPECT_EQ(Read(".5 + 1.e1 + 2E-1"), pool_.Constant(0.5) + 10 + 0.2);
  EXPECT_EQ(Read("5.5 deg"), Expression(5.5 * std::numbers::pi / 180));
  EXPECT_EQ(Read("180deg"), Expression(std::numbers::pi));
  EXPECT_EQ(Read("abs(x) + max(x, y) + sin(y)"), Abs(x_) + Max(x_, y_) + Sin(y_));
}

TEST_F(TextTest, NumbersReadBackAsTheSameDoubles) {
  RandomStream random(1, "numbers");
  for (int i = 0; i < 10'000; ++i) {
    const double value = random.Uniform(-1, 1) * std::pow(10.0, random.Index(600) - 300);
    ASSERT_EQ(Read(Text(value)), Expression(value));
  }
}

TEST_F(TextTest, EveryExpressionReadsBackAsItself) {
  RandomStream random(2, "round trip");
  for (int i = 0; i < 5'000; ++i) {
    RandomExpressions expressions(random, 3);
    const Expression e = expressions.Draw(7);
    const std::string text = Text(e);
    ASSERT_EQ(Parse(text, expressions.pool(), {}), e) << text;
  }
}

TEST_F(TextTest, WhatExpressionsHaveInCommonIsWrittenOnce) {
  const Expression wave = Sin(tg_ * x_);
  const std::vector<Expression> expressions = {2 - wave, Power(wave, 2), x_ + 1, x_ + 1, 7, x_};
  const SharedTexts texts = TextsOf(expressions);
  EXPECT_THAT(texts.shared, testing::ElementsAre("sin(theta_g*x)", "x + 1"));
  EXPECT_THAT(texts.expressions, testing::ElementsAre("2 - #0", "#0^2", "#1", "#1", "7", "x"));
}

TEST_F(TextTest, WhatIsSharedReadsBackAsItself) {
  RandomStream random(5, "shared");
  for (int i = 0; i < 1'000; ++i) {
    RandomExpressions expressions(random, 3);
    std::vector<Expression> drawn;
    for (int k = 0; k < 6; ++k) {
      const Expression e = expressions.Draw(6);
      drawn.push_back(k == 0 ? e : e * drawn[random.Index(k)] - drawn.back());
    }
    const SharedTexts texts = TextsOf(drawn);
    const std::vector<Expression> shared = ParseShared(texts.shared, expressions.pool(), {});
    for (std::size_t k = 0; k < drawn.size(); ++k) {
      ASSERT_EQ(Parse(texts.expressions[k], expressions.pool(), {}, Layout::kOther, shared),
                drawn[k])
          << texts.expressions[k];
    }
  }
}

// Written in full, the expression would have 2^40 terms.
TEST_F(TextTest, WhatDoublesAtEachLevelIsWrittenInProportionToWhatIsStored) {
  Expression e = x_;
  for (int i = 0; i < 40; ++i) e = Sin(e) * Cos(e);
  const SharedTexts texts = TextsOf({{e}});
  EXPECT_EQ(texts.shared.size(), 39U);
  const std::vector<Expression> shared = ParseShared(texts.shared, pool_, {});
  EXPECT_EQ(Parse(texts.expressions[0], pool_, {}, Layout::kOther, shared), e);
}

TEST_F(TextTest, OnlyWhatComesBeforeIsShared) {
  const std::vector<std::string> forward = {"x", "#1"};
  EXPECT_THROW(ParseShared(forward, pool_, {}), InputError);
  EXPECT_THAT(ErrorOf("x + #0"), testing::HasSubstr("there is no shared expression #0"));
  EXPECT_THAT(ErrorOf("#"), testing::HasSubstr("there is no shared expression #"));
  EXPECT_THAT(ErrorOf("#99999999999999999999"), testing::HasSubstr("no shared expression"));
}

TEST_F(TextTest, LargeSumsAndProductsReadBack) {
  std::vector<Expression> terms;
  std::vector<Expression> factors = {-2};
  for (int i = 0; i < 100; ++i) {
    terms.push_back(Sin(i * x_) * -i);
    factors.push_back(Cos(i * x_ + y_));
  }
  const Expression sum = Sum(terms) + x_;
  const Expression product = Product(factors);
  for (const Expression& e : {sum, product, -product, x_ - product, product * x_, sum - sum}) {
    EXPECT_EQ(Read(Text(e)), e) << Text(e);
  }
}

TEST_F(TextTest, DepthCostsNoStack) {
  Expression deep = x_;
  for (int i = 0; i < 10'000; ++i) deep = Sin(deep);
  EXPECT_EQ(Text(deep).size(), 10'000 * 5 + 1U);
}

TEST_F(TextTest, ErrorsNameTheirColumn) {
  using testing::HasSubstr;
  using testing::StartsWith;
  EXPECT_THAT(ErrorOf("2x"), StartsWith("bounds.json:3:11: 'x' follows the number 2"));
  EXPECT_THAT(ErrorOf("2x"), HasSubstr("2*x"));
  EXPECT_THAT(ErrorOf("x + "), StartsWith("bounds.json:3:14: the expression ends too early"));
  EXPECT_THAT(ErrorOf(""), StartsWith("bounds.json:3:10: the expression ends too early"));
  EXPECT_THAT(ErrorOf("x + theta_q"), StartsWith("bounds.json:3:14: unknown variable 'theta_q'"));
  EXPECT_THAT(ErrorOf("x + theta_q"), HasSubstr("did you mean 'theta_g'?"));
  EXPECT_THAT(ErrorOf("sine(x)"), HasSubstr("did you mean 'sin'?"));
  EXPECT_THAT(ErrorOf("tan(x)"), HasSubstr("sin, cos, sqrt, abs, min, max"));
  EXPECT_THAT(ErrorOf("x y"), StartsWith("bounds.json:3:12: unexpected 'y'"));
  EXPECT_THAT(ErrorOf("x $ y"), StartsWith("bounds.json:3:12: unexpected '$'"));
  EXPECT_THAT(ErrorOf("x \u00b7 y"), HasSubstr("unexpected '\u00b7'"));
  EXPECT_THAT(ErrorOf("(x + y"), HasSubstr("')' for the '(' in column 10"));
  EXPECT_THAT(ErrorOf("x)"), StartsWith("bounds.json:3:11: unexpected ')'"));
  EXPECT_THAT(ErrorOf("min(x)"), HasSubstr("min is given 1 arguments; allowed: exactly 2"));
  EXPECT_THAT(ErrorOf("sin(x, y)"), HasSubstr("sin is given 2 arguments; allowed: exactly 1"));
  EXPECT_THAT(ErrorOf("sin()"), StartsWith("bounds.json:3:14: unexpected ')'"));
  EXPECT_THAT(ErrorOf("x + 1e999"), StartsWith("bounds.json:3:14: the number 1e999"));
  EXPECT_THAT(ErrorOf("inf"), HasSubstr("unknown variable 'inf'"));
  EXPECT_THAT(ErrorOf("."), StartsWith("bounds.json:3:10: unexpected '.'"));
}

TEST_F(TextTest, TextThatStandsOtherwiseInItsFile) {
  try {
    Parse("x + (y + q", pool_, {.file = "file", .line = 3, .column = 10}, Layout::kOther);
    ADD_FAILURE() << "no error";
  } catch (const InputError& error) {
    EXPECT_EQ(error.place().column, 10);
    EXPECT_THAT(
        error.what(),
        testing::StartsWith("file:3:10: character 10 of the expression: unknown variable 'q'"));
  }
}

TEST_F(TextTest, ExponentsAreSmallIntegers) {
  using testing::StartsWith;
  EXPECT_THAT(ErrorOf("x^101"), StartsWith("bounds.json:3:12: the exponent 101"));
  EXPECT_THAT(ErrorOf("x^-101"), StartsWith("bounds.json:3:12: the exponent -101"));
  EXPECT_THAT(ErrorOf("x^0.5"), StartsWith("bounds.json:3:12: the exponent 0.5"));
  EXPECT_THAT(ErrorOf("x^99999999999"), StartsWith("bounds.json:3:12: the exponent"));
  EXPECT_THAT(ErrorOf("x^y"), StartsWith("bounds.json:3:12: unexpected 'y'"));
  EXPECT_THAT(ErrorOf("x^2^3"), StartsWith("bounds.json:3:13: a power of a power"));
  EXPECT_EQ(Read("x^100"), Power(x_, 100));
}

TEST_F(TextTest, NestingIsLimited) {
  const auto nested = [](int levels) {
    return std::string(levels, '(') + "x" + std::string(levels, ')');
  };
  EXPECT_EQ(Read(nested(200)), x_);
  EXPECT_THAT(ErrorOf(nested(201)),
              testing::StartsWith("bounds.json:3:210: the expression is nested too deeply"));
  EXPECT_THAT(ErrorOf(nested(100'000)), testing::HasSubstr("200 levels"));
  std::string calls = "x";
  for (int i = 0; i < 201; ++i) calls = fmt::format("sin({})", calls);
  EXPECT_THAT(ErrorOf(calls), testing::HasSubstr("nested too deeply"));
}

TEST_F(TextTest, RandomBytesGiveErrorsOnly) {
  RandomStream random(3, "bytes");
  const std::string_view letters = "xy2.e+-*/^(),sincodegmax \xc3";
  for (int i = 0; i < 20'000; ++i) {
    std::string text;
    for (int k = random.Index(12); k >= 0; --k) {
      text += letters[random.Index(static_cast<int>(letters.size()))];
    }
    try {
      Read(text);
    } catch (const InputError& error) {
      EXPECT_LE(error.place().column, 10 + static_cast<int>(text.size()));
    }
  }
}

}  // namespace
}  // namespace assay::algebra::text_test
