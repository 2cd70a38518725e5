#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "tests/sim/cli/program.h"

namespace assay::cli::explanation_test {
namespace {

using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

using Json = nlohmann::json;

Json Variable(const std::string& name, double low, double high) {
  return {{"name", name}, {"range", {low, high}}};
}

// Returns the precondition expression < limit, with its bound and the corner of its greatest value.
Json Less(const std::string& condition, const std::string& expression, double limit, double bound,
          const std::vector<std::pair<std::string, double>>& corner) {
  Json worst = Json::object();
  for (const auto& [name, value] : corner) worst[name] = value;
  return {{"condition", condition},   {"meaning", "what " + condition + " means"},
          {"expression", expression}, {"relation", "<"},
          {"limit", limit},           {"bound", bound},
          {"margin", limit - bound},  {"gap", 0},
          {"rung", "termwise"},       {"worst", worst}};
}

// Explains a plan whose first executed step has a certificate made by hand.
class Explained : public ::testing::Test {
 protected:
  Explained() {
    certificate_["variables"] = {Variable("dx_peg", -0.003, 0.003),
                                 Variable("dy_peg", -0.002, 0.004),
                                 Variable("theta_peg", -0.1, 0.1)};
    certificate_["shared"] = Json::array();
    certificate_["preconditions"] = Json::array();
  }

  Ended Explain() {
    certificate_["covers"] = Json::object();
    for (const Json& claim : certificate_["preconditions"]) {
      Json& count = certificate_["covers"][claim["condition"].get<std::string>()];
      count = count.is_null() ? 1 : count.get<int>() + 1;
    }
    plan_["actions"][1]["certificate"] = certificate_;
    return Assay({"plan", folder_.Write("plan.json", plan_.dump()), "--explain", "1"});
  }

  Json plan_ = Assay({"plan", kTwoActions, "--json"}).Json();
  Json certificate_ = plan_["actions"][1]["certificate"];
  const Folder folder_;
};

// SUP is 2 * 3 mm + 10 mm * sin(0.1). It would be 6 mm without theta's error, and 0.9983 mm without
// dx's. It is less than 5 mm if dx_peg is within (5 - 0.9983) / 2 = 2.0008 mm, which is 0.666 of 3
// mm to three digits.
TEST_F(Explained, UnprovedWithItsWorstCornerSharesAndRemedy) {
  const double sup = 0.006 + 0.01 * std::sin(0.1);
  certificate_["preconditions"].push_back(Less("between fingers", "2*dx_peg + 0.01*sin(theta_peg)",
                                               0.005, sup,
                                               {{"dx_peg", 0.003}, {"theta_peg", 0.1}}));
  const Ended ended = Explain();
  // The checker refuses the plan because of the precondition that was added by hand. The program
  // explains the step in spite of this.
  EXPECT_EQ(ended.code, 12) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("between fingers: what between fingers means: NOT PROVED\n"));
  EXPECT_THAT(ended.out, HasSubstr("SUP 6.998 mm, must be < 5 mm: 1.998 mm short of a proof; at "
                                   "the worst corner it is false\n"));
  EXPECT_THAT(ended.out, HasSubstr("0 mm if all is as believed, 6.998 mm at the worst corner; "
                                   "rung termwise, gap 0 mm\n"));
  EXPECT_THAT(ended.out, HasSubstr("    2*dx_peg + 0.01*sin(theta_peg)\n"));
  EXPECT_THAT(ended.out, ContainsRegex("dx_peg +\\+-3 mm +3 mm +6 mm\n"));
  EXPECT_THAT(ended.out, ContainsRegex("theta_peg +\\+-5.73 deg +5.73 deg +0.9983 mm\n"));
  EXPECT_THAT(
      ended.out,
      HasSubstr("A smaller range of dx_peg is enough for a proof: +-1.998 instead of +-3 mm.\n"));
}

// Either variable alone exceeds the limit, so that no single range can be tightened enough.
TEST_F(Explained, UnprovedWhereNoSingleRangeIsEnough) {
  certificate_["preconditions"].push_back(Less("between fingers", "dx_peg + dy_peg", 0.0005, 0.007,
                                               {{"dx_peg", 0.003}, {"dy_peg", 0.004}}));
  const std::string text = Explain().out;
  EXPECT_THAT(text, HasSubstr("No smaller range of a single variable is enough for a proof.\n"));
  EXPECT_THAT(text, ContainsRegex("dy_peg +-2 to 4 mm +4 mm +3 mm\n"));
}

// A bound is loose if the expression comes near it at no known corner. A loose bound does not make
// the precondition false.
TEST_F(Explained, LooseBoundIsNotCalledFalse) {
  certificate_["preconditions"].push_back(
      Less("between fingers", "dx_peg - dx_peg^3", 0.0031, 0.0032, {{"dx_peg", 0.003}}));
  EXPECT_THAT(Explain().out,
              HasSubstr("0.1 mm short of a proof; no corner is known at which it is false\n"));
}

TEST_F(Explained, UnprovedComesFirstAndProvedIsShorter) {
  certificate_["preconditions"] = {
      Less("pad contact", "dx_peg", 0.004, 0.003, {{"dx_peg", 0.003}}),
      Less("tilt", "theta_peg", 0.2, 0.1, {{"theta_peg", 0.1}}),
      Less("fingertip", "dy_peg", 0.003, 0.004, {{"dy_peg", 0.004}}),
      Less("pad contact", "-dx_peg", 0.004, 0.003, {{"dx_peg", -0.003}})};
  const std::string text = Explain().out;
  EXPECT_THAT(text, HasSubstr("3 of 4 proved, the tightest first"));
  EXPECT_LT(text.find("fingertip: what fingertip means: NOT PROVED\n"),
            text.find("\npad contact: what pad contact means: proved in all 2 cases\n"));
  EXPECT_THAT(text, ContainsRegex("2 +SUP 3 mm +< 4 mm +1 mm +termwise +0 mm\n"));
  EXPECT_THAT(text, ContainsRegex("1 +SUP 5.73 deg +< 11.46 deg +5.73 deg +termwise +0 deg\n"));
  EXPECT_EQ(text.find("worst corner", text.find("\npad contact:")), std::string::npos);
}

TEST_F(Explained, InfiniteBounds) {
  certificate_["variables"][0]["range"] = {"-inf", "inf"};
  Json precondition = Less("between fingers", "dx_peg + dy_peg", 0.005, 0, {});
  precondition["bound"] = precondition["gap"] = "inf";
  precondition["margin"] = "-inf";
  certificate_["preconditions"].push_back(precondition);
  const Ended ended = Explain();
  // The checker refuses the plan because of the precondition that was added by hand. The program
  // explains the step in spite of this.
  EXPECT_EQ(ended.code, 12) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("SUP infinite, must be < 5 mm: no finite bound is known\n"));
  EXPECT_THAT(ended.out, Not(ContainsRegex("\\binf\\b")));
  EXPECT_THAT(ended.out, HasSubstr("gap unknown"));
}

// The pads may jam on the peg, so that nothing bears it. The planner writes a number that stands
// for infinity. It means nothing to a person, and neither does a value without errors: the number
// is that of all errors together.
TEST(Explain, NothingBearsTheLoad) {
  const std::string text = Assay({"plan", kUnproved, "--explain", "1"}).out;
  EXPECT_THAT(text, HasSubstr("\nholding: the pads' friction bears the part: NOT PROVED\n"
                              "  SUP infinite, must be < 1: at worst, nothing bears the load\n"
                              "  one number for all errors together; rung termwise, gap 0\n\n"));
  EXPECT_THAT(text, Not(HasSubstr("1e+06")));
}

TEST_F(Explained, OneNumberForAllErrorsSaysNothingOfSingleErrors) {
  certificate_["preconditions"] = {Less("upright", "1.626", 1, 1.626, {}),
                                   Less("fixed stays", "0.5", 1, 0.5, {})};
  const std::string text = Explain().out;
  EXPECT_THAT(text,
              HasSubstr("  SUP 1.626, must be < 1: 0.626 short of a proof; no corner is known "
                        "at which it is false\n"
                        "  one number for all errors together; rung termwise, gap 0\n\n"));
  EXPECT_THAT(text, Not(HasSubstr("if all is as believed")));
  EXPECT_THAT(text, Not(HasSubstr("No smaller range")));
  EXPECT_THAT(text, Not(HasSubstr("    0.5\n")));
}

TEST_F(Explained, LongExpressionsAreFolded) {
  std::string sum = "dy_peg";
  for (int i = 1; i <= 60; ++i)
    sum += " + " + std::to_string(i) + ".25*dx_peg*cos(theta_peg)^" + std::to_string(i);
  certificate_["preconditions"].push_back(Less("seat", sum, 1, 0.5, {}));
  const std::string text = Explain().out;
  EXPECT_THAT(text, ContainsRegex("\\.\\.\\. and [0-9]+ more terms that vary less\n"));
  std::istringstream lines(text.substr(0, text.find("flaws: ")));
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 100) << line;
}

TEST_F(Explained, ErrorSetsAreInMillimetresAndDegrees) {
  certificate_["before"][0]["x"] = {-0.0025, 0.0025};
  certificate_["before"][0]["y"] = {-0.001, 0.002};
  certificate_["before"][0]["z"] = {"-inf", "inf"};
  certificate_["before"][0]["theta"] = {0, 0};
  EXPECT_THAT(Explain().out,
              ContainsRegex("before +peg +resting +\\+-2.5 +-1 to 2 +unknown +0 +0 +0\n"));
}

TEST_F(Explained, WrongExpressionsAndNamesAreTold) {
  certificate_["preconditions"].push_back(Less("between fingers", "dx_peg + dx_pgeg", 1, 0.5, {}));
  Ended ended = Explain();
  EXPECT_EQ(ended.code, 3);
  EXPECT_THAT(ended.err, AllOf(HasSubstr("certificate of action_2:1:10: "), HasSubstr("dx_peg")));
  certificate_["variables"][1]["name"] = "dx_peg";
  ended = Explain();
  EXPECT_EQ(ended.code, 3);
  EXPECT_THAT(ended.err, HasSubstr("'dx_peg' is no new variable"));
}

TEST(Explain, WrongStepTellsWhatIsAllowed) {
  for (const char* step : {"0", "3", "-1"}) {
    const Ended ended = Assay({"plan", kTwoActions, "--explain", step});
    EXPECT_EQ(ended.code, 2) << step;
    EXPECT_THAT(ended.err, HasSubstr("allowed: 1 to 2"));
    EXPECT_EQ(ended.out, "");
  }
}

// The explanation of a scenario is the same as that of its plan file.
TEST(Explain, NeedsOnlyTheCertificate) {
  const Folder folder;
  ASSERT_EQ(Assay({"plan", kUnproved, "-o", folder / "plan.json"}).code, 0);
  for (const char* step : {"1", "2"}) {
    const Ended of_scenario = Assay({"plan", kUnproved, "--explain", step});
    const Ended of_file = Assay({"plan", folder / "plan.json", "--explain", step});
    EXPECT_EQ(of_scenario.code, 0) << of_scenario.err;
    EXPECT_EQ(of_scenario.out, of_file.out);
  }
}

TEST(Explain, TellsWhatWasInsertedAndWhatFor) {
  EXPECT_THAT(Assay({"plan", kTwoLooks, "--explain", "1"}).out,
              AllOf(HasSubstr("inserted for step 2\n"),
                    HasSubstr("reach: joints stay within their ranges")));
  EXPECT_THAT(Assay({"plan", kTwoLooks, "--explain", "4"}).out,
              HasSubstr("What the plan does about errors: sensing (step 3), because\n"));
  EXPECT_THAT(Assay({"plan", kTwoActions, "--explain", "2"}).out,
              Not(HasSubstr("does about errors")));
}

TEST(Explain, PlansWithoutCertificatesSaySo) {
  const Folder folder;
  Json plan = Assay({"plan", kTwoActions, "--json"}).Json();
  for (Json& action : plan["actions"]) action.erase("certificate");
  EXPECT_THAT(Assay({"plan", folder.Write("plan.json", plan.dump()), "--explain", "1"}).out,
              HasSubstr("The step has no certificate"));
}

}  // namespace
}  // namespace assay::cli::explanation_test
