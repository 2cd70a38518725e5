#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <random>
#include <stdexcept>

#include "tests/sim/cli/program.h"

namespace assay::cli::certificate_check_test {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;
using ::testing::StartsWith;

using Json = nlohmann::json;

// Returns the plan of a scenario. Each plan is made once.
Json PlanOf(const std::string& scenario) {
  static std::map<std::string, Json> plans;
  if (!plans.contains(scenario)) {
    const Folder folder;
    EXPECT_EQ(Assay({"plan", scenario, "-o", folder / "plan.json"}).code, 0);
    plans[scenario] = JsonOf(folder / "plan.json");
  }
  return plans[scenario];
}

// Returns the first proved precondition of the plan, or its first unproved one if `proved` is
// false.
Json& FirstClaim(Json& plan, bool proved) {
  for (Json& action : plan["actions"]) {
    if (!action.contains("certificate")) continue;
    for (Json& claim : action["certificate"]["preconditions"]) {
      if ((claim["margin"] > 0) == proved) return claim;
    }
  }
  throw std::logic_error("no such precondition");
}

double Sign(const Json& claim) { return claim["relation"] == "<" ? 1 : -1; }

class CertificateCheck : public ::testing::Test {
 protected:
  Ended Check(const Json& plan) { return Assay({"check", Write(plan), "--json"}); }
  std::string Write(const Json& plan) { return folder_.Write("plan.json", plan.dump()); }

  // Returns the flaws that `check` finds. `check` must fail if and only if it finds a flaw.
  std::vector<std::string> FlawsOf(const Json& plan) {
    const Ended ended = Check(plan);
    std::vector<std::string> flaws;
    EXPECT_THAT(ended.code, ::testing::AnyOf(0, 12)) << ended.err;
    const Json report = ended.Json()["files"][0];
    for (const Json& flaw : report["check"]["flaws"]) flaws.push_back(flaw["what"]);
    EXPECT_EQ(ended.code, flaws.empty() ? 0 : 12);
    EXPECT_EQ(report["holds"], flaws.empty());
    return flaws;
  }

  const Folder folder_;
};

TEST_F(CertificateCheck, UntouchedPlansHoldUp) {
  for (const std::string& scenario : {kTwoActions, kTwoLooks, kTwoSqueezes, kUnproved}) {
    EXPECT_THAT(FlawsOf(PlanOf(scenario)), IsEmpty()) << scenario;
  }
}

TEST_F(CertificateCheck, PlansWithoutCertificatesHaveNothingToHoldUp) {
  Json plan = PlanOf(kTwoActions);
  for (Json& action : plan["actions"]) action.erase("certificate");
  EXPECT_THAT(FlawsOf(plan), Contains(HasSubstr("not_covered does not name 'errors with which ")));
  plan.erase("not_covered");
  EXPECT_THAT(FlawsOf(plan), IsEmpty());
}

// The margin of an unproved precondition is replaced by a positive one of about the same size.
TEST_F(CertificateCheck, WhatIsSaidToBeProvedAndIsNot) {
  Json plan = PlanOf(kUnproved);
  Json& claim = FirstClaim(plan, false);
  const double margin = -claim["margin"].get<double>() + 0.001;
  claim["bound"] = claim["limit"].get<double>() - Sign(claim) * margin;
  claim["margin"] = margin;
  claim["worst"] = Json::object();
  EXPECT_THAT(FlawsOf(plan), Contains(HasSubstr("it is said to be proved, but ")));
}

TEST_F(CertificateCheck, TighterLimitThanWasProved) {
  Json plan = PlanOf(kTwoActions);
  Json& claim = FirstClaim(plan, true);
  claim["limit"] = claim["bound"].get<double>() - Sign(claim) * 1.0;
  EXPECT_THAT(FlawsOf(plan), AllOf(Contains(HasSubstr("the margin is said to be ")),
                                   Contains(HasSubstr("it is said to be proved, but "))));
}

TEST_F(CertificateCheck, MarginThatIsNotFromTheBoundToTheLimit) {
  for (const double error : {1e-3, 2e-9}) {
    Json plan = PlanOf(kTwoActions);
    Json& claim = FirstClaim(plan, true);
    claim["margin"] = claim["margin"].get<double>() + error;
    const std::vector<std::string> flaws = FlawsOf(plan);
    ASSERT_THAT(flaws, SizeIs(1)) << error;
    EXPECT_THAT(flaws[0], AllOf(StartsWith("precondition 1, "), HasSubstr("the margin is said")));
  }
}

// The bound is replaced by a tighter one than the value of the expression at its worst corner.
TEST_F(CertificateCheck, BoundThatTheExpressionCrosses) {
  Json plan = PlanOf(kTwoActions);
  Json& claim = FirstClaim(plan, true);
  const double gain = claim["gap"].get<double>() + 1e-6;
  claim["bound"] = claim["bound"].get<double>() - Sign(claim) * gain;
  claim["margin"] = claim["margin"].get<double>() + gain;
  EXPECT_THAT(FlawsOf(plan), Contains(HasSubstr("the bound is said to be ")));
  claim["worst"] = Json::object();  // `check` must find the corner itself
  EXPECT_THAT(FlawsOf(plan), Contains(HasSubstr("but the expression attains ")));
}

// The bound is kept and still proves the precondition, but the expression is another one.
TEST_F(CertificateCheck, ExpressionThatWasReplaced) {
  Json plan = PlanOf(kTwoActions);
  Json& claim = FirstClaim(plan, true);
  const std::string written = claim["expression"];
  claim["expression"] = claim["relation"] == "<" ? written + " - 1" : written + " + 1";
  EXPECT_THAT(FlawsOf(plan), Contains(HasSubstr("the gap is said to be ")));
  claim["expression"] = claim["relation"] == "<" ? written + " + 1" : written + " - 1";
  EXPECT_THAT(FlawsOf(plan), AllOf(Contains(HasSubstr("it is said to be proved, but ")),
                                   Contains(HasSubstr("the bound is said to be "))));
}

TEST_F(CertificateCheck, CornerThatIsNone) {
  Json plan = PlanOf(kTwoActions);
  Json& worst = FirstClaim(plan, true)["worst"];
  const Json written = worst;
  ASSERT_THAT(worst, Not(IsEmpty()));
  const std::string name = worst.begin().key();
  worst[name] = 7;
  EXPECT_THAT(FlawsOf(plan), Contains(HasSubstr("the worst corner is not in the range of ")));
  worst = written;
  worst["dx_nothing"] = 0;
  EXPECT_THAT(FlawsOf(plan), Contains(HasSubstr("'dx_nothing', which is no variable")));
  worst = written;
  worst.erase(name);
  EXPECT_THAT(FlawsOf(plan), Contains(HasSubstr("the worst corner lacks ")));
}

// Narrower ranges do not contain the worst corners. Wider ranges prove less.
TEST_F(CertificateCheck, RangesThatWereReplaced) {
  const auto with_ranges_times = [](double factor) {
    Json plan = PlanOf(kTwoActions);
    for (Json& action : plan["actions"]) {
      for (Json& variable : action["certificate"]["variables"]) {
        for (Json& end : variable["range"]) {
          if (end.is_number()) end = factor * end.get<double>();
        }
      }
    }
    return plan;
  };
  EXPECT_THAT(FlawsOf(with_ranges_times(0.5)), Contains(HasSubstr("is not in the range of ")));
  EXPECT_THAT(FlawsOf(with_ranges_times(20)), Contains(HasSubstr("it is said to be proved, but ")));
}

TEST_F(CertificateCheck, ErrorCount) {
  Json plan = PlanOf(kUnproved);
  ASSERT_EQ(plan["errors"], 2);
  plan["errors"] = 0;
  EXPECT_THAT(FlawsOf(plan), Contains("the error count is said to be 0, but preconditions of 2 "
                                      "steps are not proved"));
  plan = PlanOf(kTwoActions);
  plan["errors"] = 1;
  EXPECT_THAT(FlawsOf(plan), SizeIs(1));
}

TEST_F(CertificateCheck, UnprovedStepsAreVerified) {
  Json plan = PlanOf(kUnproved);
  ASSERT_THAT(plan["verifications"], SizeIs(2));
  plan["verifications"].erase(0);
  EXPECT_THAT(FlawsOf(plan),
              Contains("plan.verifications: 1 entries in the file, 2 entries computed anew"));
  plan = PlanOf(kUnproved);
  plan["recoveries"][0]["radius"] = 0.02;
  EXPECT_THAT(FlawsOf(plan), Contains(StartsWith("plan.recoveries[0].radius: 0.02 in the file, ")));
}

TEST_F(CertificateCheck, WhatDoesNotReadIsToldWithTheFile) {
  Json plan = PlanOf(kTwoActions);
  FirstClaim(plan, true)["expression"] = "dx_peg +";
  const Ended ended = Check(plan);
  EXPECT_EQ(ended.code, 3);
  EXPECT_THAT(ended.err,
              AllOf(StartsWith("assay: " + (folder_ / "plan.json") + ": certificate of "),
                    HasSubstr("ends too early")));
}

// An error set of half its width makes every later claim about the part too strong, although
// nothing in the file contradicts it.
TEST_F(CertificateCheck, SetsAreComputedAnew) {
  for (const char* when : {"before", "after"}) {
    for (const char* what : {"x", "theta"}) {
      Json plan = PlanOf(kTwoLooks);
      Json& set = plan["actions"].back()["certificate"][when][0];
      const double high = set[what][1];
      set[what][1] = high / 2;
      EXPECT_EQ(FlawsOf(plan).size(), high != 0) << when << " " << what;
    }
  }
}

// Removes all preconditions of a kind from the certificate.
void LeaveOut(const std::string& kind, Json& certificate) {
  Json kept = Json::array();
  for (const Json& claim : certificate["preconditions"]) {
    if (claim["condition"] != kind) kept.push_back(claim);
  }
  certificate["preconditions"] = kept;
  certificate["covers"].erase(kind);
}

TEST_F(CertificateCheck, EachKindThatACertificateLacksIsTold) {
  const Json whole = PlanOf(kTwoActions);
  for (std::size_t a = 0; a < whole["actions"].size(); ++a) {
    const Json covers = whole["actions"][a]["certificate"]["covers"];
    ASSERT_GE(covers.size(), 6u);
    for (const auto& [kind, count] : covers.items()) {
      Json plan = whole;
      LeaveOut(kind, plan["actions"][a]["certificate"]);
      EXPECT_THAT(FlawsOf(plan),
                  Contains("the certificate covers no '" + kind + "', which such a step needs"));
    }
  }
}

// The pads close on a part that is next to another part. The reason that nothing is near is
// therefore false, although it is valid in other certificates.
TEST_F(CertificateCheck, AReasonThatIsNotTrueIsTold) {
  Json plan = PlanOf(kTwoActions);
  const std::string kind = "pushed clear";
  const auto beside = std::ranges::find_if(plan["actions"], [&](const Json& action) {
    const Json& covers = action["certificate"]["covers"];
    return covers.contains(kind) && covers[kind].is_number();
  });
  ASSERT_NE(beside, plan["actions"].end());
  Json& certificate = (*beside)["certificate"];
  LeaveOut(kind, certificate);
  certificate["covers"][kind] = "no other part is near enough to be met";
  EXPECT_THAT(FlawsOf(plan),
              Contains(StartsWith("certificate.covers.pushed clear: \"no other part is near")));
}

// Each random edit changes one value of a certificate or pose. A number grows by a hundredth plus a
// micrometre, and a flag or text becomes another one. The variable ASSAY_EDITS sets the number of
// edits.
TEST_F(CertificateCheck, EveryEditIsFound) {
  const char* const asked = std::getenv("ASSAY_EDITS");
  const int edits = asked == nullptr ? 12 : std::atoi(asked);
  const Json whole = PlanOf(kTwoLooks);
  const Json flat = whole["actions"].flatten();
  std::vector<std::string> places;
  for (const auto& [place, value] : flat.items()) {
    const bool is_claim = place.find("/certificate/") != std::string::npos &&
                          place.find("/resolutions/") == std::string::npos;
    const bool is_pose =
        place.find("/hold/") != std::string::npos || place.find("/place/") != std::string::npos;
    if ((is_claim || is_pose) && !value.is_null()) places.push_back(place);
  }
  ASSERT_GT(places.size(), 1000u);
  std::mt19937 random(29);
  for (int i = 0; i < edits; ++i) {
    const std::string& place = places[random() % places.size()];
    Json plan = whole;
    Json& value = plan["actions"][Json::json_pointer(place)];
    if (value.is_number_float()) {
      value = value.get<double>() + std::abs(value.get<double>()) / 100 + 1e-6;
    } else if (value.is_number()) {
      value = value.get<int>() + 1;
    } else if (value.is_boolean()) {
      value = !value.get<bool>();
    } else {
      value = value.get<std::string>() + " + 1";
    }
    const int code = Check(plan).code;
    EXPECT_TRUE(code == 12 || code == 3) << place << " became " << value << ", exit " << code;
  }
}

TEST_F(CertificateCheck, ListsThatLoseAnEntry) {
  const Json whole = PlanOf(kTwoActions);
  for (const char* list : {"variables", "before", "after", "preconditions", "shared"}) {
    Json plan = whole;
    Json& entries = plan["actions"][0]["certificate"][list];
    ASSERT_THAT(entries, Not(IsEmpty())) << list;
    entries.erase(entries.size() - 1);
    EXPECT_NE(Check(plan).code, 0) << list;
  }
}

// The check compares expressions as functions. It accepts a claim that is written in another way,
// and refuses a claim that is another function.
TEST_F(CertificateCheck, ExpressionsAreComparedAsFunctions) {
  Json plan = PlanOf(kTwoActions);
  Json& claim = FirstClaim(plan, true);
  const std::string written = claim["expression"];
  claim["expression"] = "0.5*(" + written + ") + 0.5*(" + written + ")";
  EXPECT_THAT(FlawsOf(plan), IsEmpty());
  const std::string name = claim["worst"].begin().key();
  claim["expression"] = written + " + 0.001*" + name;
  EXPECT_THAT(FlawsOf(plan), Not(IsEmpty()));
}

// The program calls nothing in a flawed plan proved.
TEST_F(CertificateCheck, NoClaimOfAFlawedPlanIsShown) {
  Json plan = PlanOf(kTwoActions);
  plan["errors"] = 1;
  const std::string file = Write(plan);
  for (const auto& arguments :
       {std::vector<std::string>{"plan", file}, std::vector<std::string>{"plan", file, "--check"},
        std::vector<std::string>{"check", file}}) {
    const Ended ended = Assay(arguments);
    EXPECT_EQ(ended.code, 12) << ended.err;
    EXPECT_THAT(ended.out, AllOf(HasSubstr("flaws: 1\n"), HasSubstr("  plan: the error count is "),
                                 Not(ContainsRegex("[0-9] proved")), Not(HasSubstr("is proved"))));
  }
  const Ended explained = Assay({"plan", file, "--explain", "1"});
  EXPECT_EQ(explained.code, 12);
  EXPECT_THAT(explained.out, AllOf(HasSubstr("so nothing in it is proved"), HasSubstr("flaws: 1")));
  const Ended json = Assay({"plan", file, "--json"});
  EXPECT_EQ(json.code, 12);
  EXPECT_EQ(json.Json()["check"]["flaws"].size(), 1u);
  for (const char* what : {"--commands", "--dot"}) {
    const Ended exported = Assay({"export", file, what});
    EXPECT_EQ(exported.code, 3);
    EXPECT_THAT(exported.err, HasSubstr("the plan has a flaw: the error count is "));
  }
}

TEST_F(CertificateCheck, StrategiesAreReplayed) {
  Json plan = PlanOf(kFelt);
  EXPECT_THAT(FlawsOf(plan), IsEmpty());
  const auto felt = std::ranges::find_if(
      plan["actions"], [](const Json& action) { return action.contains("strategy"); });
  ASSERT_NE(felt, plan["actions"].end());
  Json narrower = plan;
  narrower["actions"][felt - plan["actions"].begin()]["strategy"]["certificate"]["d"][1] = 0.001;
  EXPECT_THAT(FlawsOf(narrower), Contains(HasSubstr("limits of the tip's errors are wider")));
  (*felt)["strategy"]["motions"][1]["X_FixedTip"][3][2] = 0.5;
  EXPECT_THAT(FlawsOf(plan), Contains(StartsWith("the strategy: motion 2: ")));
  const std::string file = Write(plan);
  EXPECT_THAT(Assay({"plan", file}).out, AllOf(HasSubstr("flaws: "), HasSubstr("motion 2: ")));
  const Ended ended = Assay({"run", file, "-o", folder_ / "out"});
  EXPECT_EQ(ended.code, 12) << ended.err;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out/trace.jsonl"));
}

TEST_F(CertificateCheck, IsAskedBeforeExecution) {
  Json plan = PlanOf(kTwoActions);
  FirstClaim(plan, true)["margin"] = 1;
  const Ended ended = Assay({"run", Write(plan), "-o", folder_ / "out"});
  EXPECT_EQ(ended.code, 12) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("the margin is said to be "));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out/trace.jsonl"));
}

}  // namespace
}  // namespace assay::cli::certificate_check_test
