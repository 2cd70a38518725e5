#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "planner/base/input_files/input_error.h"
#include "planner/domain/resting/resting.h"
#include "planner/domain/workcell/workcell_file.h"
#include "tests/planner/domain/scenario.h"
#include "tests/scratch_file.h"

namespace assay::domain::tables_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class TwoTables : public testing::Test {
 protected:
  // Returns whether the first can, upright at this place, is on a table.
  bool IsOnTable(double x, double y) const { return OnTable(problem_, PartId(0), At(x, y)); }
  std::string TableAt(double x, double y) const {
    return TableUnder(*problem_.workcell, problem_.parts[0], At(x, y)).name;
  }
  Pose At(double x, double y) const {
    return PoseAt(problem_.parts[0], problem_.parts[0].resting, {.x = x, .y = y});
  }

  const Problem problem_ = LoadScenario("two-cans");
};

// The tables are separate: a part cannot stand on both or over the gap.
TEST_F(TwoTables, APartStandsOnOneOfThem) {
  EXPECT_TRUE(IsOnTable(0.6, -0.4));
  EXPECT_TRUE(IsOnTable(0.6, 0.4));
  EXPECT_FALSE(IsOnTable(0.6, 0));
  EXPECT_FALSE(IsOnTable(0.6, 0.11));
  EXPECT_FALSE(IsOnTable(0.6, 0.69));
  EXPECT_EQ(TableAt(0.6, -0.4), "table");
  EXPECT_EQ(TableAt(0.6, 0.4), "second-table");
}

TEST_F(TwoTables, TheFirstIsTheOneThatIsLookedAt) {
  EXPECT_EQ(&problem_.workcell->table(), &problem_.workcell->tables().front());
  ASSERT_EQ(problem_.workcell->tables().size(), 2u);
}

// Returns the error message for the workcell file with other text in place of its tables.
std::string ErrorOf(const std::string& tables) {
  std::ostringstream text;
  text << std::ifstream(ModelsFolder() / "workcells/two-tables/workcell.yaml").rdbuf();
  std::string changed = text.str();
  const std::size_t from = changed.find("tables:");
  changed.replace(from, changed.find("rules:") - from, tables + "\n\n");
  for (const char* folder : {"../../robots", "../../grippers"}) {
    changed.replace(changed.find(folder), 5, ModelsFolder());
  }
  const std::filesystem::path file = ScratchFile("workcell.yaml");
  std::ofstream(file) << changed;
  try {
    WorkcellFile::Read(file);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST_F(TwoTables, WrongTablesAreRefused) {
  const std::string one = "{x: [0.3, 0.9], y: [-0.7, -0.1], thickness: 0.04}";
  EXPECT_EQ(ErrorOf("tables: {a: " + one + "}"), "no error");
  EXPECT_EQ(ErrorOf("table: " + one), "no error");
  EXPECT_THAT(ErrorOf("tables: {}"), HasSubstr("there are no tables"));
  EXPECT_THAT(ErrorOf("tables: {a: " + one + "}\ntable: " + one),
              HasSubstr("both table and tables"));
  EXPECT_THAT(ErrorOf("tables: {a: " + one + ", a: " + one + "}"), HasSubstr("twice"));
  EXPECT_THAT(ErrorOf("tables: {a: {x: [0.3, 0.3], y: [0, 1], thickness: 0.04}}"),
              AllOf(HasSubstr("workcell.yaml:"), HasSubstr("no area")));
}

}  // namespace
}  // namespace assay::domain::tables_test
