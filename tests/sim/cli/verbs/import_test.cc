#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <utility>

#include "tests/sim/cli/program.h"

namespace assay::cli::import_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

// Returns a bar of 20 x 10 x 50 in the units of the reader, as OBJ.
std::string Bar() {
  std::string text;
  for (const char* z : {"0", "50"}) {
    for (const char* xy : {"-10 -5", "10 -5", "10 5", "-10 5"})
      text += std::string("v ") + xy + " " + z + "\n";
  }
  return text + "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
}

TEST(ImportTest, WritesAPartAndTellsWhatItDid) {
  const Folder folder;
  const std::string part = folder / "models/parts/bar";
  const Ended ended =
      Assay({"import", folder.Write("bar.obj", Bar()), "-o", part, "--density", "2700"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_THAT(
      ended.out,
      AllOf(HasSubstr("The unit of the files is mm (found from the size"),
            HasSubstr("It is at most 0 mm from the file"),
            HasSubstr("Feature 8: rectangular shaft, 20 x 10 mm, 50 mm long, tip toward -z."),
            HasSubstr("12 triangles became 1 piece in "), HasSubstr(part + "/part.yaml\n")));
  EXPECT_THAT(TextOf(part + "/part.yaml"),
              AllOf(HasSubstr("name: bar\ninitial: B\n"), HasSubstr("density: 2700\n"),
                    HasSubstr("body: {box: [[-10, -5, 0], [10, 5, 50]]}")));
  EXPECT_THAT(TextOf(part + "/README.md"),
              AllOf(HasSubstr("density of 2700 kg/m^3 the mass is 0.027 kg"),
                    HasSubstr("The friction is 0.3 (assumed)")));
}

TEST(ImportTest, KeepsAPartThatIsThere) {
  const Folder folder;
  const std::string bar = folder.Write("bar.obj", Bar());
  ASSERT_EQ(Assay({"import", bar, "-o", folder / "bar"}).code, 0);
  const Ended again = Assay({"import", bar, "-o", folder / "bar", "--units", "cm"});
  EXPECT_EQ(again.code, 2);
  EXPECT_THAT(again.err, HasSubstr("is there already"));
  EXPECT_EQ(Assay({"import", bar, "-o", folder / "bar", "--units", "cm", "--replace"}).code, 0);
  EXPECT_THAT(TextOf(folder / "bar/part.yaml"), HasSubstr("[100, 50, 500]"));
}

TEST(ImportTest, RefusesWithThePlace) {
  const Folder folder;
  const std::string torn = folder.Write("torn.obj", "v 0 0 0\nv 1 0 0\nf 1 2 3\n");
  const Ended ended = Assay({"import", torn, "-o", folder / "torn"});
  EXPECT_EQ(ended.code, 3);
  EXPECT_THAT(ended.err, HasSubstr(torn + ":3:7: '3' names no vertex"));
  EXPECT_FALSE(std::filesystem::exists(folder / "torn"));
  const std::string bar = folder.Write("bar.obj", Bar());
  EXPECT_EQ(Assay({"import", bar, "-o", folder / "two words"}).code, 2);
  EXPECT_EQ(Assay({"import", bar, "-o", folder / "bar", "--units", "mile"}).code, 2);
  EXPECT_EQ(Assay({"import", bar, "-o", folder / "bar", "--sides", "30"}).code, 2);
  EXPECT_EQ(Assay({"import", bar, "-o", folder / "bar", "--density", "0"}).code, 2);
  EXPECT_EQ(Assay({"import", bar}).code, 2);
}

// Returns a block of 40 x 40 from z = -5 to 20 with a hole down to z = 0 that the bar fits into
// with 0.2 mm a side.
std::string Socket() {
  std::string text;
  const auto add = [&](const char* sign_x, const char* sign_y, const char* half, const char* z) {
    text += fmt::format("v {}{} {}{} {}\n", sign_x, half[0] == 'o' ? "20" : "10.2", sign_y,
                        half[0] == 'o' ? "20" : "5.2", z);
  };
  for (const auto& [half, z] :
       {std::pair("outer", "-5"), {"inner", "0"}, {"outer", "20"}, {"inner", "20"}}) {
    add("-", "-", half, z);
    add("", "-", half, z);
    add("", "", half, z);
    add("-", "", half, z);
  }
  text += "f 4 3 2 1\nf 5 6 7 8\n";  // the base, and the floor of the hole
  for (int a = 1; a <= 4; ++a) {
    const int b = a % 4 + 1;
    text += fmt::format("f {} {} {} {}\n", a, b, b + 8, a + 8);
    text += fmt::format("f {} {} {} {}\n", b + 4, a + 4, a + 12, b + 12);
    text += fmt::format("f {} {} {} {}\n", a + 8, b + 8, b + 12, a + 12);
  }
  return text;
}

TEST(ImportTest, MatedPartsBecomeAScenario) {
  const Folder folder;
  const std::string bar = folder.Write("bar.obj", Bar());
  const std::string socket = folder.Write("socket.obj", Socket());
  const Ended ended = Assay({"import", socket, bar, "--mated", "-o", folder / "own"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_THAT(ended.out, AllOf(HasSubstr("mm deep in feature 7 of socket (rectangular hole, 20.4 x "
                                         "10.4 mm, 20 mm deep). The gaps on the sides of the hole "
                                         "are 0.2, 0.2, 0.2, 0.2 mm."),
                               HasSubstr(folder / "own/bar-into-socket.yaml")));
  EXPECT_THAT(TextOf(folder / "own/bar-into-socket.yaml"),
              AllOf(HasSubstr("clearance: 0.2  #"), HasSubstr("held: bar\n"),
                    ::testing::ContainsRegex("model: bar\n    pose: .stable: [A-Z]P[0-9]+, at: ")));
  // The planner reads the boxes, and the engine finds the clearance that the files have.
  const Ended checked = Assay({"check", folder / "own/bar-into-socket.yaml"});
  EXPECT_EQ(checked.err, "");
  EXPECT_THAT(checked.out, ::testing::ContainsRegex("bar with socket .*0.400 .*holds"));
  EXPECT_EQ(Assay({"import", socket, bar, "--mated", "-o", folder / "own"}).code, 2);
  EXPECT_EQ(Assay({"import", bar, "--mated", "-o", folder / "other"}).code, 2);
}

}  // namespace
}  // namespace assay::cli::import_test
