#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

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

// No command overwrites a file that it has read, whether by its own name or through links.
TEST(OutputFile, IsNeverAnInput) {
  const std::string models = kTree / "models";
  const std::vector<std::vector<std::string>> commands = {
      {"plan", "IN", "--models", models, "-o", "OUT"},
      {"check", "IN", "--models", models, "-o", "OUT"},
      {"export", "IN", "--mjcf", "--models", models, "-o", "OUT"},
      {"export", "IN", "--dot", "--models", models, "-o", "OUT"},
      {"contingent", kTree / "scenarios/know/force-sensing.pks", "IN", "-o", "OUT"},
      {"label", "IN", "-o", "OUT"},
      {"bound", "IN", "-o", "OUT"}};
  for (const std::vector<std::string>& command : commands) {
    const std::string& verb = command.front();
    const std::string text = verb == "contingent" ? TextOf(kTree / "scenarios/know/two-cans.pks")
                             : verb == "label"    ? "{\"nodes\": {\"v\": 2}, \"arcs\": []}"
                             : verb == "bound"
                                 ? "{\"variables\": {\"x\": [0, 1]}, \"expressions\": [\"x\"]}"
                                 : TextOf(kTwoActions);
    const Folder folder;
    const std::string in = folder.Write("in.yaml", text);
    std::filesystem::create_symlink("in.yaml", folder / "symbolic");
    std::filesystem::create_hard_link(in, folder / "hard");
    for (const char* name : {"in.yaml", "symbolic", "hard", "./in.yaml"}) {
      std::vector<std::string> arguments = command;
      std::ranges::replace(arguments, "IN", in);
      std::ranges::replace(arguments, "OUT", folder / name);
      const Ended ended = Assay(arguments);
      EXPECT_EQ(ended.code, 2) << verb << ' ' << name << ended.err;
      EXPECT_THAT(ended.err, HasSubstr("this command has read it")) << verb << ' ' << name;
      EXPECT_EQ(TextOf(in), text) << verb << ' ' << name;
      EXPECT_EQ(TextOf(folder / "hard"), text) << verb << ' ' << name;
    }
    EXPECT_THAT(folder.Contents(), ElementsAre("hard", "in.yaml", "symbolic"));
  }
}

// Models are inputs, too.
TEST(OutputFile, IsNoModelThatWasRead) {
  const Folder folder;
  std::filesystem::copy(kTree / "models", folder / "models",
                        std::filesystem::copy_options::recursive);
  const std::string part = folder / "models/parts/peg/part.yaml";
  const std::string text = TextOf(part);
  EXPECT_EQ(Assay({"plan", kTwoActions, "--models", folder / "models", "-o", part}).code, 2);
  EXPECT_EQ(TextOf(part), text);
}

TEST(OutputFile, APlanThatIsRunInItsFolderStays) {
  const Folder folder;
  ASSERT_EQ(Assay({"plan", kTwoActions, "-o", folder / "plan.json"}).code, 0);
  const std::string text = TextOf(folder / "plan.json");
  EXPECT_EQ(Assay({"run", folder / "plan.json", "-o", folder / ""}).code, 0);
  EXPECT_EQ(TextOf(folder / "plan.json"), text);
}

TEST(OutputFile, HasAName) {
  EXPECT_EQ(Assay({"plan", kTwoActions, "-o", ""}).code, 2);
  EXPECT_EQ(Assay({"run", kTwoActions, "--output="}).code, 2);
}

TEST(OutputFile, KeepsItsPermissions) {
  const Folder folder;
  const std::string file = folder.Write("plan.json", "old");
  const auto mode = std::filesystem::perms(0640);
  std::filesystem::permissions(file, mode);
  ASSERT_EQ(Assay({"plan", kTwoActions, "-o", file}).code, 0);
  EXPECT_EQ(std::filesystem::status(file).permissions(), mode);
  EXPECT_EQ(JsonOf(file)["outcome"], "planned");
}

// Standard output is a file here. The program must not replace it.
TEST(OutputFile, StandardOutputIsWrittenInOrder) {
  const Folder folder;
  ASSERT_EQ(Assay({"plan", kTwoActions, "-o", "/dev/stdout"}, folder / "all").code, 0);
  const std::string all = TextOf(folder / "all");
  const std::size_t plan = all.find("\n{");
  ASSERT_NE(plan, std::string::npos) << all;
  EXPECT_THAT(all.substr(0, plan), HasSubstr("Every precondition is proved"));
  EXPECT_EQ(nlohmann::json::parse(all.substr(plan))["outcome"], "planned");
}

// The program never aborts when streams are missing or full. Its exit code is 4 if a result is
// lost.
TEST(Streams, MayBeMissing) {
  const Folder folder;
  const auto code = [&](const std::string& command, const std::string& streams) {
    const std::string line = fmt::format("'{}' {} {}", ASSAY_PROGRAM, command, streams);
    return cli::Run("/bin/sh", {"-c", line}).code;
  };
  const std::string plan = "plan " + kTwoActions;
  for (const char* err : {"2>/dev/full", "2>&-", "</dev/null 2>/dev/full", "<&- 2>&-"}) {
    EXPECT_EQ(code("plan /nope", err), 3) << err;
    EXPECT_EQ(code("nonsense", err), 2) << err;
    EXPECT_EQ(code(plan, err), 0) << err;
    EXPECT_EQ(code(plan + " --trace", err), 0) << err;
  }
  for (const char* out :
       {">/dev/full", ">&-", ">&- 2>&-", ">/dev/full 2>/dev/full", "<&- >&- 2>&-"}) {
    EXPECT_EQ(code(plan, out), 4) << out;
    EXPECT_EQ(code("--help", out), 4) << out;
  }
}

TEST(Streams, WithoutThemFilesAreWritten) {
  const Folder folder;
  const std::string plan = folder / "plan.json";
  for (const char* streams : {">/dev/full", ">&- 2>&-", "<&- >&- 2>&-"}) {
    const std::string line =
        fmt::format("'{}' plan '{}' -o '{}' {}", ASSAY_PROGRAM, kTwoActions, plan, streams);
    EXPECT_EQ(cli::Run("/bin/sh", {"-c", line}).code, 4) << streams;
    EXPECT_EQ(JsonOf(plan)["outcome"], "planned") << streams;
    std::filesystem::remove(plan);
  }
}

TEST(OutputFile, IsAFolder) {
  const Folder folder;
  EXPECT_EQ(Assay({"plan", kTwoActions, "-o", folder / ""}).code, 4);
}

// A result that cannot be written to a full disk is printed nevertheless.
TEST(OutputFile, OnAFullDisk) {
  const Ended ended = Assay({"plan", kTwoActions, "-o", "/dev/full"});
  EXPECT_EQ(ended.code, 4);
  EXPECT_THAT(ended.err, HasSubstr("/dev/full"));
  EXPECT_THAT(ended.out, HasSubstr("assemble(peg, block"));
}

TEST(OutputFile, StandardOutputOnAFullDisk) {
  const Ended ended = Assay({"plan", kTwoActions}, "/dev/full");
  EXPECT_EQ(ended.code, 4);
  EXPECT_THAT(ended.err, HasSubstr("standard output cannot be written"));
  EXPECT_THAT(ended.err, HasSubstr("files that the command writes are kept"));
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
