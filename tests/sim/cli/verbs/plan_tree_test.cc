#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/sim/cli/program.h"

namespace assay::cli::plan_tree_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

const std::string kFallenPeg = kTree / "scenarios/fallen-peg.yaml";

// The poses are those of Spar's figures 15 and 16. The plan has two actions if the peg lies, and
// four if it stands.
TEST(PlanTree, ALookThenAPlanForEachPose) {
  const Ended ended = Assay({"plan", kFallenPeg, "--json"});
  EXPECT_EQ(ended.code, 0) << ended.err;
  const auto json = ended.Json();
  EXPECT_EQ(json["outcome"], "planned");
  EXPECT_THAT(SchemaErrors("sim/cli/verbs/plan_tree.schema.json", json), IsEmpty());
  ASSERT_EQ(json["plans"].size(), 2);
  EXPECT_EQ(json["plans"][0]["worlds"][0]["peg"], "lying");
  EXPECT_EQ(json["plans"][1]["worlds"][0]["peg"], "standing");
  EXPECT_EQ(json["tree"]["nodes"][json["tree"]["root"].get<std::size_t>()]["act"]["name"],
            "look-peg-coarse-camera");
}

TEST(PlanTree, VerificationsOfOneWorldBranch) {
  const Ended ended = Assay({"plan", kTree / "scenarios/uncertain-failing.yaml", "--tree"});
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_THAT(ended.out, AllOf(HasSubstr("1: verify pickup(peg, PG"),
                               HasSubstr("recover from error1\n    go to 1"),
                               HasSubstr("call the operator: error2")));
}

TEST(PlanTree, WhatIsKnownIsWrittenForKnow) {
  const Folder folder;
  const std::string name = folder / "peg";
  EXPECT_EQ(Assay({"export", kFallenPeg, "--pks", "-o", name}).code, 0);
  const Ended known = Assay({"contingent", name + "-domain.pks", name + "-problem.pks", "--check"});
  EXPECT_EQ(known.code, 0) << known.err;
  EXPECT_THAT(known.out, AllOf(StartsWith("look-peg-coarse-camera()\n"),
                               HasSubstr("check: holds in all of the worlds")));
}

// The plan for Spar's figure 15 begins with looks at parts whose pose is known. They are steps like
// others.
TEST(PlanTree, FirstLooksAtKnownPosesAreSteps) {
  const Ended ended = Assay({"plan", kTree / "scenarios/spar-fig15.yaml", "--tree"});
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_THAT(ended.out, AllOf(StartsWith("sense("), HasSubstr("\npickup(peg, "),
                               HasSubstr("\nassemble(peg, block, ")));
}

// A goal of knowledge has a tree with or without --tree, and no task of steps that could be
// written.
TEST(PlanTree, AGoalOfKnowledgeIsPlannedFor) {
  const std::string cans = kTree / "scenarios/two-cans.yaml";
  const Ended plan = Assay({"plan", cans});
  EXPECT_EQ(plan.code, 0) << plan.err;
  EXPECT_THAT(plan.out, AllOf(StartsWith("grasp(can1)\nsenseWeight(can1)\n"),
                              HasSubstr("depth 8, 4 leaves, 3 branch points")));
  EXPECT_EQ(Assay({"plan", cans, "--tree"}).out, plan.out);
  const Ended ended = Assay({"export", cans, "--pks"});
  EXPECT_EQ(ended.code, 3);
  EXPECT_THAT(ended.err, HasSubstr("a scenario with a key `goal`"));
}

TEST(PlanTree, OptionsOfOneWorldAreRefusedWhereThePlanIsATree) {
  const Ended noise = Assay({"run", kFallenPeg, "--noise", "uniform"});
  EXPECT_EQ(noise.code, 2);
  EXPECT_THAT(noise.err, HasSubstr("--noise is for plans without branches"));
  const Ended worlds = Assay({"run", kTree / "scenarios/uncertain-known.yaml", "--worlds", "all"});
  EXPECT_EQ(worlds.code, 2);
  EXPECT_THAT(worlds.err, HasSubstr("--worlds is for plan trees"));
}

TEST(PlanTree, VerbsAboutOneWorldRefuseOpenPoses) {
  const Folder folder;
  const Ended ended = Assay({"render", kFallenPeg, "-o", folder / "out"});
  EXPECT_EQ(ended.code, 3);
  EXPECT_THAT(ended.err,
              AllOf(HasSubstr("fallen-peg.yaml:18:"), HasSubstr("the pose of 'peg' is open")));
  const Ended check = Assay({"check", kFallenPeg});
  EXPECT_EQ(check.code, 0) << check.err;
  EXPECT_THAT(check.out, HasSubstr("worlds: peg lying; peg standing"));
}

}  // namespace
}  // namespace assay::cli::plan_tree_test
