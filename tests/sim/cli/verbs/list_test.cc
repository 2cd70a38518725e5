#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/sim/cli/program.h"

namespace assay::cli::list_test {
namespace {

using ::testing::AnyOf;
using ::testing::HasSubstr;

TEST(List, HasEverythingWithALine) {
  const auto json = Assay({"list", "--json", "--models", kTree / "models"}).Json();
  for (const char* kind : {"scenarios", "parts", "workcells", "actions", "skills", "meanings"}) {
    ASSERT_GT(json[kind].size(), 0) << kind;
    for (const auto& entry : json[kind]) {
      EXPECT_NE(entry["name"], "");
      EXPECT_NE(entry["text"], "") << entry["name"];
    }
  }
  EXPECT_EQ(json["actions"].size(), 3);
}

// A file that cannot be read is listed with its error among the other files.
TEST(List, AFileThatCannotBeReadHidesNoOther) {
  const Folder folder;
  std::filesystem::copy(kTree / "models", folder / "models",
                        std::filesystem::copy_options::recursive);
  std::filesystem::create_directories(folder / "scenarios");
  folder.Write("scenarios/bad.yaml", "format: [\n");
  folder.Write("scenarios/good.yaml", "title: all is well\n");
  folder.Write("models/parts/peg/part.yaml", "\xff");
  const Ended ended = Assay({"list", "--models", folder / "models"});
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("all is well"));
  EXPECT_THAT(ended.out, HasSubstr("cannot be read: "));
  EXPECT_THAT(ended.out, HasSubstr("bad.yaml:2:1: "));
  const auto json = Assay({"list", "--json", "--models", folder / "models"}).Json();
  EXPECT_THAT(json["scenarios"][0]["error"].get<std::string>(), HasSubstr("bad.yaml:2:1: "));
  EXPECT_EQ(json["scenarios"][1]["text"], "all is well");
}

TEST(List, OneKind) {
  const Ended ended = Assay({"list", "actions", "--models", kTree / "models"});
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("putdown"));
  EXPECT_THAT(ended.out, ::testing::Not(HasSubstr("scenarios")));
}

// The list contains the skills and meanings that the scenarios use.
TEST(List, WhatADomainsWordsMayMean) {
  const Ended ended = Assay({"list", "skills", "--models", kTree / "models"});
  for (const char* skill : {"pick-up", "weigh", "carry", "put-down", "look"}) {
    EXPECT_THAT(ended.out, HasSubstr(skill));
  }
  const Ended meanings = Assay({"list", "meanings", "--models", kTree / "models"});
  for (const char* meaning :
       {"internal", "held", "hand-empty", "over", "heavier", "colored", "occupied"}) {
    EXPECT_THAT(meanings.out, HasSubstr(meaning));
  }
}

TEST(List, WorkcellsTellWhatTheyCanDoAboutUncertainty) {
  const Ended ended = Assay({"list", "workcells", "--models", kTree / "models"});
  EXPECT_THAT(ended.out, HasSubstr("sensors: overhead-camera; verifications: gripper-opening, "));
  EXPECT_THAT(ended.out, HasSubstr("recoveries: error1, "));
}

TEST(Doctor, TellsTheVersionsAndTheRenderer) {
  const Ended ended = Assay({"doctor", "--json"});
  const auto json = ended.Json();
  EXPECT_EQ(json["mujoco"], "2.2.2");
  EXPECT_GE(json["cores"], 1);
  EXPECT_THAT(json["renderer"], AnyOf("OSMesa", "EGL", ""));
  EXPECT_EQ(ended.code, json["renderer"] == "" ? 4 : 0);
}

}  // namespace
}  // namespace assay::cli::list_test
