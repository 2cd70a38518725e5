#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/sim/cli/program.h"

namespace assay::cli::contingent_test {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;
using Json = nlohmann::json;

std::string Scenario(const std::string& name) { return kTree / "scenarios/know" / (name + ".pks"); }

Ended Know(const std::string& domain, const std::string& problem,
           std::vector<std::string> options = {}) {
  options.insert(options.begin(), {"contingent", Scenario(domain), Scenario(problem)});
  return Assay(options);
}

TEST(Contingent, ThePapersTree) {
  const Ended ended = Know("force-sensing", "two-cans", {"--unfold", "--check"});
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_THAT(ended.out, StartsWith("grasp(can1)\nsenseWeight(can1)\nbranch isSpillable(can1)\n"
                                    "  transferUpright(can1)\n  ungrasp(can1)\n"));
  EXPECT_THAT(ended.out, HasSubstr("depth 8, 4 leaves, 3 branch points, 10 actions in 13 nodes"));
  EXPECT_THAT(ended.out, HasSubstr("check: holds in all of the worlds"));
  EXPECT_THAT(ended.out, HasSubstr(", as 4 cases\n"));
}

// It is also unknown whether it rains, but neither the goal nor a sensing action depends on the
// rain.
TEST(Contingent, CasesAreToldApartByWhatMatters) {
  const Folder folder;
  const std::string domain =
      folder.Write("domain.pks",
                   "domain door\npredicates: open, rains, isReady\n"
                   "action look\n  preconds: true\n  effects: add(Kw, open)\n"
                   "action wait\n  preconds: K(rains)\n  effects: add(Kf, isReady)\n");
  const auto said = [&](const std::string& init, const std::string& goal) {
    const std::string problem = folder.Write(
        "problem.pks", "problem door\ndomain door\ninit: " + init + "\ngoal: " + goal + "\n");
    return Assay({"contingent", domain, problem, "--check"}).out;
  };
  EXPECT_THAT(said("add(Kf, !isReady)", "K(open) | K(!open)"), HasSubstr(", as 2 cases\n"));
  EXPECT_THAT(said("add(Kf, open)", "K(open)"), HasSubstr(", as 1 case\n"));
}

TEST(Contingent, JsonIsBySchema) {
  for (const auto& [domain, problem] :
       {std::pair("force-sensing", "ten-cans"), std::pair("opening-a-safe", "safe-with-note"),
        std::pair("slippery-grasp", "hold-the-cup"), std::pair("unix", "find-a-file")}) {
    const Ended ended = Know(domain, problem, {"--json", "--check"});
    EXPECT_EQ(ended.code, 0) << ended.err;
    const Json json = ended.Json();
    EXPECT_THAT(SchemaErrors("sim/cli/verbs/contingent.schema.json", json), IsEmpty());
    EXPECT_THAT(SchemaErrors("planner/contingent/plan_tree/tree.schema.json", json["tree"]),
                IsEmpty());
    EXPECT_EQ(json["check"]["holds"], true);
  }
}

TEST(Contingent, ShortestIsSaidToBe) {
  const Ended ended = Know("visual-sensing", "one-bottle", {"--shortest", "--json"});
  EXPECT_EQ(ended.Json()["guarantee"], "least depth");
  EXPECT_EQ(ended.Json()["depth"], 5);
  EXPECT_EQ(ended.Json()["leaves"], 2);
}

TEST(Contingent, Dot) {
  const Ended ended = Know("slippery-grasp", "hold-the-cup", {"--dot"});
  EXPECT_EQ(ended.code, 0);
  EXPECT_THAT(ended.out, StartsWith("digraph plan {"));
  EXPECT_THAT(ended.out, HasSubstr("style=dashed"));
}

// A tree is data. One program can write it and another one can check it.
TEST(Contingent, TreesAreReadBack) {
  const Folder folder;
  for (const auto& [domain, problem] :
       {std::pair("force-sensing", "three-cans"), std::pair("opening-a-safe", "safe-with-note"),
        std::pair("slippery-grasp", "hold-the-cup")}) {
    const std::string file = folder / "tree.json";
    EXPECT_EQ(Know(domain, problem, {"--json", "-o", file}).code, 0);
    const Ended read = Know(domain, problem, {"--tree", file, "--json"});
    EXPECT_EQ(read.code, 0) << read.err;
    EXPECT_EQ(read.Json()["tree"], JsonOf(file)["tree"]);
    EXPECT_EQ(read.Json()["check"]["holds"], true);
  }
}

TEST(Contingent, AWrongTreeIsRefused) {
  const Folder folder;
  const std::string early =
      folder.Write("early.json",
                   R"({"format": "assay-tree/1", "root": 1, "nodes": [{"goal": true},
          {"act": {"name": "grasp", "arguments": ["can1"]}, "then": 0}]})");
  const Ended fails = Know("force-sensing", "two-cans", {"--tree", early});
  EXPECT_EQ(fails.code, 12);
  EXPECT_THAT(fails.out, HasSubstr("check: FAILS: the goal is not known after grasp(can1)"));
  const std::string endless =
      folder.Write("endless.json", R"({"format": "assay-tree/1", "root": 0, "nodes": [
          {"act": {"name": "grasp", "arguments": ["can1"]}, "then": 0}]})");
  EXPECT_EQ(Know("force-sensing", "two-cans", {"--tree", endless}).code, 3);
  EXPECT_THAT(Know("force-sensing", "two-cans", {"--tree", endless}).err,
              HasSubstr(endless + ":2:11: this leads back to itself"));
}

TEST(Contingent, OutcomesHaveTheirCodes) {
  const Ended spent = Know("force-sensing", "ten-cans", {"--budget", "5", "--json"});
  EXPECT_EQ(spent.code, 11);
  EXPECT_EQ(spent.Json()["outcome"], "budget");
  const Folder folder;
  const std::string domain = folder.Write("d.pks",
                                          "domain d predicates: p, q\n"
                                          "action a preconds: K(p) effects: add(Kf, q)\n");
  const std::string problem =
      folder.Write("p.pks", "problem p domain d init: add(Kf, !p) goal: K(q)\n");
  const Ended none = Assay({"contingent", domain, problem, "--json"});
  EXPECT_EQ(none.code, 10);
  EXPECT_EQ(none.Json()["outcome"], "none");
  EXPECT_THAT(SchemaErrors("sim/cli/verbs/contingent.schema.json", none.Json()), IsEmpty());
}

TEST(Contingent, WrongFilesAreToldWithTheirPlace) {
  const Folder folder;
  const std::string domain =
      folder.Write("d.pks", "domain d\npredicates: p\naction a preconds: K(q)");
  const std::string problem = folder.Write("p.pks", "problem p domain d goal: K(p)");
  const Ended ended = Assay({"contingent", domain, problem});
  EXPECT_EQ(ended.code, 3);
  EXPECT_THAT(ended.err, HasSubstr(domain + ":3:22: unknown predicate 'q'"));
  EXPECT_EQ(Know("force-sensing", "one-bottle").code, 3);
  EXPECT_EQ(Know("force-sensing", "no-such-problem").code, 3);
}

TEST(Contingent, ReadsThePddlThatExportWrites) {
  const Folder folder;
  const Ended written = Assay({"export", Scenario("bomb-in-the-toilet"), "--pddl",
                               Scenario("four-packages"), "-o", folder / "bomb"});
  EXPECT_EQ(written.code, 0) << written.err;
  const Ended known = Assay({"contingent", folder / "bomb-domain.pddl",
                             folder / "bomb-problem.pddl", "--shortest", "--json", "--check"});
  EXPECT_EQ(known.code, 0) << known.err;
  EXPECT_EQ(known.Json()["depth"], 4);
  const Ended refused = Assay({"export", Scenario("pouring"), "--pddl", Scenario("half-full-jug")});
  EXPECT_EQ(refused.code, 3);
  EXPECT_THAT(refused.err, HasSubstr("PDDL has no intervals"));
}

}  // namespace
}  // namespace assay::cli::contingent_test
