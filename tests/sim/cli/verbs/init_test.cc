#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/sim/cli/program.h"

namespace assay::cli::init_test {
namespace {

using ::testing::HasSubstr;

namespace fs = std::filesystem;

TEST(InitTest, WritesWhatRunsAsItIs) {
  const Folder folder;
  const Ended ended = Assay({"init", folder / "own"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  for (const char* file : {"README.md", "plate-on-stud.yaml", "models/parts/stud/part.yaml",
                           "models/parts/plate/part.yaml", "clearances.yaml"}) {
    EXPECT_THAT(ended.out, HasSubstr(folder / "own" + "/" + file + "\n"));
    EXPECT_TRUE(fs::exists(fs::path(folder / "own") / file)) << file;
  }
  const std::string scenario = folder / "own/plate-on-stud.yaml";
  const Ended checked = Assay({"check", scenario, folder / "own/clearances.yaml"});
  EXPECT_EQ(checked.code, 0) << checked.err << checked.out;
  const Ended planned = Assay({"plan", scenario, "-o", folder / "plan.json"});
  EXPECT_EQ(planned.code, 0) << planned.err;
  EXPECT_THAT(planned.out, HasSubstr("Every precondition is proved"));
  EXPECT_EQ(Assay({"run", folder / "plan.json", "--noise", "uniform", "--trial", "1"}).code, 0);
}

// Every arm that a workcell takes gets a workcell in which it assembles the template's parts.
TEST(InitTest, WritesAWorkcellForTheUsersArm) {
  for (const std::string name : {"puma762", "ur5e", "irb120", "kr6-r900", "puma560", "iiwa7"}) {
    const Folder folder;
    const std::string robot =
        fmt::format("{}/models/robots/{}/{}.urdf", ASSAY_SOURCE_DIR, name, name);
    const Ended ended = Assay({"init", folder / "own", "--robot", robot});
    ASSERT_EQ(ended.code, 0) << ended.err;
    const std::string workcell =
        fmt::format("{}/models/workcells/{}-table/workcell.yaml", folder / "own", name);
    EXPECT_THAT(ended.out, HasSubstr(workcell));
    EXPECT_EQ(Assay({"check", workcell}).code, 0) << name;
    const std::string scenario = folder / "own/plate-on-stud.yaml";
    const Ended planned = Assay({"plan", scenario, "-o", folder / "plan.json"});
    EXPECT_EQ(planned.code, 0) << name << planned.err;
    const Ended run = Assay({"run", folder / "plan.json", "--noise", "uniform", "--trial", "1"});
    EXPECT_EQ(run.code, 0) << name << run.out << run.err;
  }
}

TEST(InitTest, SaysWhatIsWrongWithTheUsersArm) {
  const Folder folder;
  const Ended none = Assay({"init", folder / "own", "--robot", folder / "none.urdf"});
  EXPECT_EQ(none.code, 3);
  EXPECT_THAT(none.err, HasSubstr("none.urdf"));
  const std::string gripper =
      std::string(ASSAY_SOURCE_DIR) + "/models/grippers/parallel-jaw/gripper.urdf";
  EXPECT_EQ(Assay({"init", folder / "own", "--robot", gripper}).code, 3);
  EXPECT_FALSE(fs::exists(folder / "own"));
}

// A file that is already in the folder is kept, and no other file is written beside it.
TEST(InitTest, OverwritesNothing) {
  const Folder folder;
  const std::string kept = folder.Write("clearances.yaml", "mine");
  const Ended ended = Assay({"init", folder / ""});
  EXPECT_EQ(ended.code, 2);
  EXPECT_THAT(ended.err, HasSubstr("is there already"));
  EXPECT_EQ(TextOf(kept), "mine");
  EXPECT_THAT(folder.Contents(), ::testing::ElementsAre("clearances.yaml"));
  fs::remove(kept);
  fs::create_symlink("nowhere", kept);
  EXPECT_EQ(Assay({"init", folder / ""}).code, 2);
}

TEST(InitTest, SaysThatAFolderCannotBeMade) {
  EXPECT_EQ(Assay({"init", "/proc/own"}).code, 4);
  EXPECT_EQ(Assay({"init"}).code, 2);
}

}  // namespace
}  // namespace assay::cli::init_test
