#include "planner/domain/workcell/floor.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>
#include <utility>

#include "planner/domain/workcell/workcell_file.h"
#include "tests/scratch_file.h"

namespace assay::domain::floor_test {
namespace {

namespace fs = std::filesystem;

const fs::path kModels = fs::path(ASSAY_SOURCE_DIR) / "models";

std::string TextOf(const fs::path& file) {
  std::stringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

// Replaces everything between two words, including these words.
std::string Replaced(std::string text, const std::string& from, const std::string& to,
                     const std::string& with) {
  const std::size_t begin = text.find(from);
  const std::size_t end = text.find(to, begin);
  EXPECT_NE(end, std::string::npos) << from;
  return text.replace(begin, end + to.size() - begin, with);
}

// Returns the workcell of the Puma with these visible shapes at the root of its arm.
std::shared_ptr<const Workcell> WithRoot(const std::string& visuals) {
  const fs::path urdf = ScratchFile("arm.urdf");
  std::ofstream(urdf) << Replaced(TextOf(kModels / "robots/puma762/puma762.urdf"),
                                  "<visual name=\"foot\">", "</link>", visuals + "</link>");
  std::string workcell = TextOf(kModels / "workcells/puma762-table/workcell.yaml");
  workcell = Replaced(std::move(workcell), "../../robots", "puma762.urdf", urdf.string());
  workcell = Replaced(std::move(workcell), "../../grippers", "gripper.urdf",
                      kModels / "grippers/parallel-jaw/gripper.urdf");
  fs::create_directories(ScratchFile("any"));
  std::ofstream(ScratchFile("any/workcell.yaml")) << workcell;
  return WorkcellFile::Read(ScratchFile("any/workcell.yaml"));
}

std::string Visual(const std::string& shape, const std::string& origin) {
  return "<visual><origin " + origin + "/><geometry>" + shape + "</geometry></visual>";
}

// The origin of the root of the Puma is 0.7 m above the top of the table and 1.12 m above the
// floor.
TEST(Floor, IsWhereTheShippedArmStands) {
  const auto workcell = WorkcellFile::Read(kModels / "workcells/puma762-table/workcell.yaml");
  EXPECT_NEAR(FloorHeight(*workcell), -0.42, 1e-12);
}

TEST(Floor, IsUnderTheLowestShapeOfAnyKind) {
  const std::string high = "xyz=\"0 0 -0.8\"";
  EXPECT_NEAR(FloorHeight(*WithRoot(Visual("<box size=\"1 1 0.5\"/>", high))), -0.35, 1e-12);
  EXPECT_NEAR(FloorHeight(*WithRoot(Visual("<cylinder radius=\"0.1\" length=\"0.5\"/>", high))),
              -0.35, 1e-12);
  EXPECT_NEAR(FloorHeight(*WithRoot(Visual("<sphere radius=\"0.3\"/>", high))), -0.4, 1e-12);
}

// A cylinder that leans by 30 degrees reaches lowest with the edge of its end.
TEST(Floor, KnowsHowShapesLean) {
  const std::string leaning = "xyz=\"0 0 -0.8\" rpy=\"0.5235987755982988 0 0\"";
  const double reach = 0.25 * std::sqrt(0.75) + 0.2 * 0.5;
  EXPECT_NEAR(FloorHeight(*WithRoot(Visual("<cylinder radius=\"0.2\" length=\"0.5\"/>", leaning))),
              -0.1 - reach, 1e-12);
}

// One arm stands on the table, and the shapes of the other are unknown.
TEST(Floor, IsNowhereAboveATable) {
  const auto on_table = WithRoot(Visual("<box size=\"1 1 0.1\"/>", "xyz=\"0 0 -0.65\""));
  EXPECT_NEAR(FloorHeight(*on_table), -on_table->table().thickness, 1e-12);
  EXPECT_NEAR(FloorHeight(*WithRoot("")), -0.04, 1e-12);
}

}  // namespace
}  // namespace assay::domain::floor_test
