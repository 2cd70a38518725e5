#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/sim/cli/program.h"

namespace assay::cli::bound_test {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;
using Json = nlohmann::json;

const std::string kSparPickup = kTree / "scenarios/expressions/spar-pickup.yaml";

class BoundVerb : public ::testing::Test {
 protected:
  static Json Bounds(std::vector<std::string> arguments, int code = 0) {
    arguments.insert(arguments.begin(), "bound");
    arguments.push_back("--json");
    const Ended ended = Assay(arguments);
    EXPECT_EQ(ended.code, code) << ended.err;
    EXPECT_THAT(SchemaErrors("sim/cli/verbs/bound.schema.json", ended.Json()), IsEmpty());
    return ended.Json()["expressions"];
  }

  const Folder folder_;
};

// The paper prints the lower bound 3.2793. The exact range is [3.279336, 3.693041].
TEST_F(BoundVerb, SparsPickup) {
  const Json refined = Bounds({kSparPickup})[0];
  EXPECT_NEAR(refined["inf"].get<double>(), 3.279336, 2e-6);
  EXPECT_NEAR(refined["sup"].get<double>(), 3.693041, 2e-6);
  EXPECT_LE(refined["gap"].get<double>(), 1e-6);
  EXPECT_NEAR(refined["termwise"]["inf"].get<double>(), 3.279301, 1e-6);

  const Json termwise = Bounds({kSparPickup, "--rung", "termwise"})[0];
  EXPECT_EQ(termwise["inf"], refined["termwise"]["inf"]);
  EXPECT_EQ(termwise["sup"], refined["termwise"]["sup"]);
  EXPECT_EQ(termwise["rung"], "termwise");
}

TEST_F(BoundVerb, LinearWithInfiniteEnds) {
  const std::string file =
      folder_.Write("linear.json", R"({"variables": {"x": ["-inf", "inf"], "y": ["-inf", "inf"]},
                         "constraints": ["x <= y + 1", "x <= 5 - y"], "expressions": ["x", "x + y"]})");
  const Json bounds = Bounds({file, "--keep", "y"});
  EXPECT_EQ(bounds[0]["sup"], 3);
  EXPECT_EQ(bounds[0]["inf"], "-inf");
  EXPECT_EQ(bounds[0]["rung"], "linear");
  EXPECT_EQ(bounds[0]["kept"]["inf"], "-inf");
  EXPECT_THAT(bounds[0]["kept"]["sup"].get<std::string>(), StartsWith("min("));
  EXPECT_EQ(bounds[1]["sup"], 5);
}

// Neighbouring doubles near 1e16 differ by 2.
TEST_F(BoundVerb, AGapThatRoundingLeavesIsNoAnswer) {
  const std::string file = folder_.Write("gap.json", R"({"variables": {"x": [99999999, 100000001]},
                      "expressions": ["x*x - 2*100000000*x + 1e16"]})");
  EXPECT_GT(Bounds({file}, 11)[0]["gap"].get<double>(), 1e-6);
  EXPECT_THAT(Assay({"bound", file}).err, HasSubstr("no finer rounding"));
  EXPECT_LE(Bounds({file, "--gap", "10"})[0]["gap"].get<double>(), 10);
}

TEST_F(BoundVerb, TableForPeople) {
  const Ended ended = Assay({"bound", kSparPickup});
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_THAT(ended.out, StartsWith("expression"));
  EXPECT_THAT(ended.out, HasSubstr("3.27933"));
  EXPECT_THAT(ended.out, HasSubstr("would improve most if these variables were known: dx"));
}

TEST_F(BoundVerb, SameBytesButForSeconds) {
  Json first = Bounds({kSparPickup}), second = Bounds({kSparPickup});
  for (Json* bounds : {&first, &second}) (*bounds)[0].erase("seconds");
  EXPECT_EQ(first.dump(), second.dump());
}

TEST_F(BoundVerb, WritesToAFile) {
  const std::string out = folder_ / "bounds.json";
  EXPECT_EQ(Assay({"bound", kSparPickup, "-o", out}).code, 0);
  EXPECT_THAT(SchemaErrors("sim/cli/verbs/bound.schema.json", JsonOf(out)), IsEmpty());
}

// No number satisfies both constraints, and the root of a negative number has no value.
TEST_F(BoundVerb, BoundsOfNothing) {
  const std::string contradiction = folder_.Write(
      "contradiction.yaml",
      "variables: {x: [-inf, inf]}\nconstraints: [x <= 0, x >= 1]\nexpressions: [x, x + 1]\n");
  const std::string no_value = folder_.Write(
      "no-value.yaml", "variables: {x: [0, 1]}\nexpressions: [sqrt(x - 2), sqrt(x)]\n");
  const Json of_contradiction = Bounds({contradiction}), of_no_value = Bounds({no_value});
  for (const Json& answer : {of_contradiction[0], of_contradiction[1], of_no_value[0]}) {
    EXPECT_EQ(answer["vacuous"], true);
    EXPECT_EQ(answer["inf"], "inf");
    EXPECT_EQ(answer["sup"], "-inf");
  }
  EXPECT_EQ(of_no_value[1]["vacuous"], false);
  const std::string words =
      "sqrt(x - 2)\n  no point satisfies the constraints, or the expression has no value\n";
  EXPECT_THAT(Assay({"bound", no_value}).out, HasSubstr(words));
}

TEST_F(BoundVerb, NoExpressions) {
  const std::string file = folder_.Write("none.yaml", "variables: {x: [0, 1]}\nexpressions: []\n");
  const Ended ended = Assay({"bound", file});
  EXPECT_EQ(ended.code, 3);
  EXPECT_THAT(ended.err, HasSubstr("allowed: at least one"));
}

TEST_F(BoundVerb, WrongInput) {
  const std::string file =
      folder_.Write("wrong.yaml", "variables: {x: [0, 1]}\nexpressions: [x + u]\n");
  const Ended ended = Assay({"bound", file});
  EXPECT_EQ(ended.code, 3);
  EXPECT_THAT(ended.err, StartsWith("assay: " + file + ":2:"));
}

TEST_F(BoundVerb, WrongCommandLine) {
  const Ended keep = Assay({"bound", kSparPickup, "--keep", "dxx"});
  EXPECT_EQ(keep.code, 2);
  EXPECT_THAT(keep.err, HasSubstr("did you mean"));
  EXPECT_EQ(Assay({"bound", kSparPickup, "--rung", "best"}).code, 2);
  EXPECT_EQ(Assay({"bound", kSparPickup, "--gap", "-1"}).code, 2);
}

}  // namespace
}  // namespace assay::cli::bound_test
