#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/sim/cli/program.h"

namespace assay::cli::output_file_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(OutputFile, InAFolderThatIsNone) {
  const Folder folder;
  const std::string file = folder.Write("file", "not a folder");
  for (const std::string& output : {file + "/plan.json", folder / "none/plan.json"}) {
    const Ended ended = Assay({"plan", kTwoActions, "-o", output});
    EXPECT_EQ(ended.code, 4) << output;
    EXPECT_THAT(ended.err, HasSubstr(output));
  }
  EXPECT_EQ(Assay({"run", kTwoActions, "-o", file}).code, 4);
  EXPECT_EQ(Assay({"render", kTwoActions, "-o", file + "/pictures"}).code, 4);
  EXPECT_EQ(Assay({"export", kTwoActions, "--mjcf", "-o", folder / "none/scene.xml"}).code, 4);
  EXPECT_THAT(folder.Contents(), ElementsAre("file"));
}

TEST(OutputFile, IsAFolder) {
  const Folder folder;
  EXPECT_EQ(Assay({"plan", kTwoActions, "-o", folder / ""}).code, 4);
}

// On a full disk what was found is still printed.
TEST(OutputFile, OnAFullDisk) {
  const Ended ended = Assay({"plan", kTwoActions, "-o", "/dev/full"});
  EXPECT_EQ(ended.code, 4);
  EXPECT_THAT(ended.err, HasSubstr("/dev/full"));
  EXPECT_THAT(ended.out, HasSubstr("assemble(peg, block"));
}

TEST(OutputFile, StandardOutputOnAFullDisk) {
  const Ended ended = Assay({"plan", kTwoActions}, "/dev/full");
  EXPECT_EQ(ended.code, 4);
  EXPECT_THAT(ended.err, HasSubstr("standard output"));
}

TEST(OutputFile, DevicesAreWrittenInto) {
  EXPECT_EQ(Assay({"plan", kTwoActions, "-o", "/dev/null"}).code, 0);
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

TEST(OutputFile, LinksAreFollowed) {
  const Folder folder;
  folder.Write("file.json", "old");
  std::filesystem::create_symlink("file.json", folder / "link.json");
  ASSERT_EQ(Assay({"plan", kTwoActions, "-o", folder / "link.json"}).code, 0);
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link.json"));
  EXPECT_EQ(JsonOf(folder / "file.json")["outcome"], "planned");
}

}  // namespace
}  // namespace assay::cli::output_file_test
