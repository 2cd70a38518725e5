#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "tests/architecture/include_rules.h"
#include "tests/architecture/library_table.h"
#include "tests/architecture/size_rules.h"
#include "tests/scratch_file.h"

namespace assay::architecture {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::IsSupersetOf;
using ::testing::Not;
using ::testing::UnorderedElementsAre;

const std::filesystem::path kTree = ASSAY_SOURCE_DIR;

TEST(SourceTree, IncludesStayInsideTheTable) { EXPECT_THAT(CrossedBorders(kTree), IsEmpty()); }
TEST(SourceTree, PlannerKnowsNoSimulator) { EXPECT_THAT(CrossedMujocoLine(kTree), IsEmpty()); }
TEST(SourceTree, OwnHeaderComesFirst) { EXPECT_THAT(OwnHeaderNotFirst(kTree), IsEmpty()); }
TEST(SourceTree, HeadersAreLight) { EXPECT_THAT(HeavyHeaders(kTree), IsEmpty()); }
TEST(SourceTree, EveryFileHasALibrary) { EXPECT_THAT(FilesOfNoLibrary(kTree), IsEmpty()); }

TEST(SourceTree, TheTableNamesOnlyWhatIsIncluded) {
  EXPECT_THAT(UnusedLibraries(kTree), IsEmpty());
}
TEST(SourceTree, NoFileIncludesItselfByWayOfOthers) { EXPECT_THAT(Cycles(kTree), IsEmpty()); }
TEST(SourceTree, NoFolderHoldsMoreThan24Files) {
  EXPECT_THAT(CrowdedFolders(kTree, 24), IsEmpty());
}
TEST(SourceTree, FilesAreShort) { EXPECT_THAT(LongFiles(kTree, 400), IsEmpty()); }
TEST(SourceTree, FunctionsAreShort) { EXPECT_THAT(LongFunctions(kTree, 50), IsEmpty()); }
TEST(SourceTree, ClassesInSourceFilesAreShort) { EXPECT_THAT(LongClasses(kTree, 250), IsEmpty()); }
TEST(SourceTree, ReadmesAreShort) { EXPECT_THAT(LongReadmes(kTree, 60), IsEmpty()); }
TEST(SourceTree, TheFirstReadmeIsShort) { EXPECT_THAT(LongRootReadme(kTree, 150, 900), IsEmpty()); }

TEST(SourceTree, TheTableIsRead) {
  EXPECT_THAT(LibraryTable::Read(kTree).folders(),
              IsSupersetOf(
                  {"planner/base", "planner/geometry", "planner/constraint_posting", "sim/scene"}));
}

// Planners of different papers may be combined in planner/assembly only.
TEST(SourceTree, PlannersDoNotKnowEachOther) {
  const LibraryTable table = LibraryTable::Read(kTree);
  const std::vector<std::string> planners = {"planner/constraint_posting", "planner/finemotion",
                                             "planner/contingent"};
  for (const std::string& planner : table.folders()) {
    if (std::ranges::find(planners, planner) == planners.end()) continue;
    for (const std::string& other : planners) {
      if (other == planner) continue;
      EXPECT_THAT(table.OpenTo(planner), Not(Contains(other))) << planner;
    }
  }
}

TEST(SourceTree, PlannerLibrariesUsePlannerLibraries) {
  const LibraryTable table = LibraryTable::Read(kTree);
  for (const std::string& folder : table.folders()) {
    if (!folder.starts_with("planner/")) continue;
    for (const std::string& open : table.OpenTo(folder)) {
      EXPECT_TRUE(open.starts_with("planner/")) << folder << " uses " << open;
    }
  }
}

// A small tree that breaks every rule once, so that each rule is tested.
class BrokenTree : public ::testing::Test {
 protected:
  BrokenTree() {
    Write("CMakeLists.txt",
          "# assay_library(planner/ghost)\n"
          "assay_library(planner/base LINKS fmt::fmt)\n"
          "assay_library(planner/geometry USES base\n  HIDES fcl)\n"
          "assay_library(planner/plan USES geometry)\n"
          "assay_library(sim/scene USES plan)\n");
  }
  ~BrokenTree() override { std::filesystem::remove_all(root_); }

  void Write(const std::string& file, const std::string& text) const {
    std::filesystem::create_directories((root_ / file).parent_path());
    std::ofstream(root_ / file) << text;
  }

  const std::filesystem::path root_ =
      ScratchFile(::testing::UnitTest::GetInstance()->current_test_info()->name());
};

TEST_F(BrokenTree, TableIsClosedUnderUse) {
  const LibraryTable table = LibraryTable::Read(root_);
  EXPECT_THAT(table.folders(),
              ElementsAre("planner/base", "planner/geometry", "planner/plan", "sim/scene"));
  EXPECT_THAT(table.OpenTo("planner/plan"),
              UnorderedElementsAre("planner/plan", "planner/geometry", "planner/base"));
}

TEST_F(BrokenTree, UnknownLibraryInTheTable) {
  Write("CMakeLists.txt", "assay_library(planner/base USES nothing)\n");
  EXPECT_THROW(LibraryTable::Read(root_), std::runtime_error);
}

TEST_F(BrokenTree, BordersAreSeen) {
  Write("planner/geometry/box.h", "#pragma once\n#include \"planner/base/id.h\"\n");
  Write("planner/geometry/hull.cc",
        "\n#include \"planner/plan/data/plan.h\"\n#include \"box.h\"\n");
  EXPECT_THAT(
      CrossedBorders(root_),
      ElementsAre("planner/geometry/hull.cc:2: planner/plan/data/plan.h: is not of a library that "
                  "planner/geometry uses",
                  "planner/geometry/hull.cc:3: box.h: is not written from the root"));
}

TEST_F(BrokenTree, MujocoLineIsSeen) {
  Write("planner/plan/data/plan.cc",
        "#include <mujoco/mujoco.h>\n#include \"sim/scene/scene.h\"\n");
  Write("sim/scene/scene.cc", "#include <mujoco/mujoco.h>\n");
  EXPECT_THAT(
      CrossedMujocoLine(root_),
      ElementsAre(
          "planner/plan/data/plan.cc:1: mujoco/mujoco.h: the planner knows no simulator",
          "planner/plan/data/plan.cc:2: sim/scene/scene.h: the planner knows no simulator"));
}

TEST_F(BrokenTree, LateOwnHeaderIsSeen) {
  Write("planner/base/id.h", "#pragma once\n");
  Write("planner/base/id.cc", "#include <string>\n#include \"planner/base/id.h\"\n");
  Write("planner/base/main.cc", "#include <string>\n");
  EXPECT_THAT(OwnHeaderNotFirst(root_),
              ElementsAre("planner/base/id.cc:1: does not include planner/base/id.h first"));
}

TEST_F(BrokenTree, HeavyHeaderIsSeen) {
  Write("planner/geometry/hull.h", "#include <Eigen/Geometry>\n  #  include <fcl/fcl.h>\n");
  EXPECT_THAT(HeavyHeaders(root_),
              ElementsAre("planner/geometry/hull.h:2: fcl/fcl.h: belongs into the .cc file"));
}

TEST_F(BrokenTree, UnusedLibraryIsSeen) {
  Write("planner/geometry/box.h", "#include \"planner/base/id.h\"\n");
  Write("planner/plan/plan.h", "#include \"planner/base/id.h\"\n");
  Write("sim/scene/scene.h", "#include \"planner/plan/plan.h\"\n");
  EXPECT_THAT(UnusedLibraries(root_),
              ElementsAre("CMakeLists.txt:1: planner/plan includes nothing of planner/geometry"));
}

TEST_F(BrokenTree, CycleIsSeen) {
  Write("planner/base/a.h", "#pragma once\n");
  Write("planner/base/a.cc", "#include \"planner/base/a.h\"\n#include \"planner/base/b.h\"\n");
  Write("planner/base/b.h", "#include \"planner/base/c.h\"\n");
  Write("planner/base/c.h", "#include \"planner/base/a.h\"\n");
  Write("planner/base/d.h", "#include \"planner/base/b.h\"\n");
  EXPECT_THAT(Cycles(root_), ElementsAre("planner/base/a planner/base/b planner/base/c"));
}

TEST_F(BrokenTree, CrowdedFolderIsSeen) {
  for (const char* name : {"a.h", "a.cc", "b.h", "rooms/c.h"}) {
    Write(std::string("planner/base/") + name, "");
  }
  EXPECT_THAT(CrowdedFolders(root_, 2), ElementsAre("planner/base: 3 source files"));
}

TEST_F(BrokenTree, LongFileIsSeen) {
  Write("planner/base/a.h", "int a;\nint b;\n");
  Write("planner/base/b.h", "int a;\nint b;\nint c;\n");
  EXPECT_THAT(LongFiles(root_, 2), ElementsAre("planner/base/b.h:1: a file of 3 lines"));
}

// Braces in texts, characters, comments and lambdas are part of the function around them.
TEST_F(BrokenTree, LongFunctionIsSeen) {
  Write("planner/base/a.cc",
        "namespace base {\n\nint F() const noexcept {\n  return 1;\n}\n"
        "std::string G(\n    int a) {\n  // {\n  const char c = '{';\n"
        "  const auto d = [&] {\n    return 1'000;\n  };\n  return \"{\" + R\"x({)\")x\";\n}\n\n"
        "const Table kTable = {\n    {1},\n    {2},\n    F(),\n};\n\n}  // namespace base\n");
  EXPECT_THAT(LongFunctions(root_, 1), ElementsAre("planner/base/a.cc:7: a function of 6 lines"));
  EXPECT_THAT(LongFunctions(root_, 6), IsEmpty());
}

TEST_F(BrokenTree, LongClassIsSeen) {
  const std::string text =
      "template <class Number>\nclass C : public D<Number> {\n public:\n  int f() { return 1; }\n"
      " private:\n  int a;\n};\n";
  Write("planner/base/a.h", text);
  Write("planner/base/b.cc", text);
  EXPECT_THAT(LongClasses(root_, 3), ElementsAre("planner/base/b.cc:2: a class of 4 lines"));
  EXPECT_THAT(LongClasses(root_, 4), IsEmpty());
}

TEST_F(BrokenTree, LongReadmeIsSeen) {
  Write("README.md", "# House\n\nIt is full\nof rooms.\n");
  Write("planner/README.md", "a\nb\nc\n");
  Write("planner/base/README.md", "a\nb\n");
  EXPECT_THAT(LongReadmes(root_, 2), ElementsAre("planner/README.md:1: a README of 3 lines"));
  EXPECT_THAT(LongReadmes(root_, 1), ElementsAre("planner/README.md:1: a README of 3 lines",
                                                 "planner/base/README.md:1: a README of 2 lines"));
  EXPECT_THAT(LongRootReadme(root_, 4, 7), IsEmpty());
  EXPECT_THAT(LongRootReadme(root_, 3, 7), ElementsAre("README.md:1: 4 lines, 7 words"));
  EXPECT_THAT(LongRootReadme(root_, 4, 6), ElementsAre("README.md:1: 4 lines, 7 words"));
}

TEST_F(BrokenTree, StrayFileIsSeen) {
  Write("planner/stray/stray.cc", "");
  EXPECT_THAT(FilesOfNoLibrary(root_),
              ElementsAre("planner/stray/stray.cc:1: no line of the table of libraries covers it"));
}

}  // namespace
}  // namespace assay::architecture
