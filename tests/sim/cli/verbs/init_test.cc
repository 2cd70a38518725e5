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
