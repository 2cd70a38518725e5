#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <string>

#include "tests/scratch_file.h"
#include "tests/sim/cli/program.h"

namespace assay::cli::export_parts_test {
namespace {

namespace fs = std::filesystem;

using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;

const fs::path kScenarios = kTree / "scenarios";

// The play of the square peg is that of the drawing, and the unmodified engine keeps it.
TEST(ExportParts, APairKeepsItsPlayInTheUnmodifiedEngine) {
  const std::string file = ScratchFile("pair.xml");
  const Ended ended =
      Assay({"export", kScenarios / "mate-square.yaml", "--mated", "--mjcf", "-o", file});
  ASSERT_EQ(ended.code, 0) << ended.err;
  const std::regex play("([0-9.]+) mm as drawn, ([0-9.]+) mm measured in MuJoCo");
  int plays = 0;
  for (std::sregex_iterator i(ended.out.begin(), ended.out.end(), play), end; i != end; ++i) {
    EXPECT_NEAR(std::stod((*i)[1]), 0.5, 1e-3);
    EXPECT_NEAR(std::stod((*i)[2]), 0.5, 0.01);
    ++plays;
  }
  EXPECT_EQ(plays, 2);
  EXPECT_THAT(TextOf(file), AllOf(HasSubstr("<!-- play of peg in block"), EndsWith("</mujoco>\n")));
}

// URDF refers to the meshes of round pieces, which are files beside it.
TEST(ExportParts, UrdfRefersToFilesThatAreThere) {
  const fs::path file = ScratchFile("pair.urdf");
  ASSERT_EQ(Assay({"export", kScenarios / "mate-octagonal.yaml", "--urdf", "-o", file}).code, 0);
  const std::string text = TextOf(file);
  EXPECT_THAT(text, HasSubstr("type=\"floating\""));
  const std::regex mesh("filename=\"([^\"]+)\"");
  int meshes = 0;
  for (std::sregex_iterator i(text.begin(), text.end(), mesh), end; i != end; ++i, ++meshes) {
    EXPECT_TRUE(fs::exists(file.parent_path() / (*i)[1].str())) << (*i)[1];
  }
  EXPECT_GT(meshes, 1);
}

TEST(ExportParts, SaysWhatCannotBeExported) {
  EXPECT_THAT(Assay({"export", kScenarios / "two-cans.yaml", "--obj"}).err,
              HasSubstr("no goal mates parts"));
  EXPECT_THAT(Assay({"export", kScenarios / "round-peg.yaml", "--urdf"}).err,
              HasSubstr("needs a file for each piece"));
  EXPECT_THAT(Assay({"export", kScenarios / "round-peg.yaml", "--mated", "--dot"}).err,
              HasSubstr("--mated needs one of"));
}

}  // namespace
}  // namespace assay::cli::export_parts_test
