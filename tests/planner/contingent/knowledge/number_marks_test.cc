#include "planner/contingent/knowledge/number_marks.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "planner/base/random.h"
#include "planner/contingent/tree_check/tree_check.h"
#include "tests/planner/contingent/tasks.h"

namespace assay::contingent::number_marks_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr int kTasks = 300;

// f increases by 3 before it is tested. The error is therefore at the initial values from 2 to 2.4.
TEST(NumberMarks, AreCarriedBackThroughShifts) {
  const auto check = [](double finishes_above, const std::string& shift) {
    const GroundTask task =
        GroundText(fmt::format("domain n predicates: done functions: f: number\n"
                               "action shift effects: add(Kf, f = {})\n"
                               "action look effects: add(Kw, f > 5)\n"
                               "action finishHigh preconds: K(f > {}) effects: add(Kf, done)\n"
                               "action finishLow preconds: K(f <= 5) effects: add(Kf, done)\n",
                               shift, finishes_above),
                   "problem n domain n init: add(Kf, f = [0, 10]) goal: K(done)");
    const PlanTree tree = {
        .nodes = {ActOf(task, "shift", 1), ActOf(task, "look", 2), BranchOf(task, "f > 5", 3, 4),
                  ActOf(task, "finishHigh", 5), ActOf(task, "finishLow", 5), PlanNode{}},
        .root = NodeId(0)};
    return CheckTree(task, tree);
  };
  for (const char* shift : {"f + 3", "f - 3", "7 - f", "f + [0, 0.1]", "f - [0.1, 0.2]"}) {
    EXPECT_TRUE(check(5, shift).holds) << shift;
    EXPECT_TRUE(check(5, shift).AreAllWorlds()) << shift;
    EXPECT_THAT(check(5.4, shift).failure, HasSubstr("the precondition of finishHigh() is not"));
    EXPECT_FALSE(check(5 + 1e-9, shift).holds) << shift;
  }
}

TEST(NumberMarks, AreAsFineAsWidthsAreAsked) {
  const auto holds = [](const std::string& goal) {
    const GroundTask task = GroundText(
        "domain n functions: f: number\n"
        "action shift effects: add(Kf, f = f + [0, 0.5])\n"
        "action told effects: add(Kf, f > 2)\n",
        "problem n domain n init: add(Kf, f = [0, 3]) goal: " + goal);
    const PlanTree tree = {.nodes = {ActOf(task, "shift", 1), ActOf(task, "told", 2), PlanNode{}},
                           .root = NodeId(0)};
    const TreeCheck check = CheckTree(task, tree);
    EXPECT_TRUE(check.AreAllWorlds());
    return check.holds;
  };
  EXPECT_TRUE(holds("Kv(f within 0.75)"));
  EXPECT_FALSE(holds("Kv(f within 0.749999999)"));
}

TEST(NumberMarks, TellWhereNumbersAreASample) {
  const auto check = [](const std::string& init, const std::string& goal) {
    const GroundTask task = GroundText(
        "domain n predicates: done functions: f: number, g: number\n"
        "action add effects: add(Kf, f = f + g), add(Kf, done)\n"
        "action doubt effects: !K(f <= 3) => add(Kf, done)\n",
        "problem n domain n init: " + init + " goal: " + goal);
    const PlanTree tree = {.nodes = {ActOf(task, "add", 1), ActOf(task, "doubt", 2), PlanNode{}},
                           .root = NodeId(0)};
    return CheckTree(task, tree);
  };
  const TreeCheck sampled = check("add(Kf, f = [0, 1]), add(Kf, g = [2, 3])", "K(f <= 4)");
  EXPECT_EQ(sampled.failure, "");
  EXPECT_TRUE(sampled.are_numbers_sampled);
  EXPECT_FALSE(sampled.were_drawn);
  // In all samples it is known that f is at most 3. But samples cannot prove that this is known.
  EXPECT_THAT(check("add(Kf, f = [0, 1]), add(Kf, g = [1, 2])", "K(done)").failure,
              HasSubstr("a sample of numbers cannot decide this"));
}

// Only one of two numbers that are added is ever tested, so that the other one does not matter.
TEST(NumberMarks, LeaveOutWhatNothingAsks) {
  const GroundTask task = GroundText(
      "domain n predicates: done functions: f: number, g: number\n"
      "action count effects: add(Kf, g = g + f), add(Kf, done)\n",
      "problem n domain n init: add(Kf, f = [0, 1]) goal: K(done) & K(f <= 1)");
  const PlanTree tree = {.nodes = {ActOf(task, "count", 1), PlanNode{}}, .root = NodeId(0)};
  EXPECT_TRUE(NumberMarks(task, tree).AreComplete());
}

TEST(NumberMarks, StandForTheirRange) {
  const GroundTask task =
      GroundText("domain n functions: f: number action wait effects: add(Kf, f = f)",
                 "problem n domain n init: add(Kf, f = [0, 3]) goal: K(f < 2)");
  const NumberMarks marks(task, {.nodes = {PlanNode{}}, .root = NodeId(0)});
  EXPECT_THAT(marks.In({.low = 1, .high = 3}, 0),
              ElementsAre(Number{1}, Number{2, -1}, Number{2}, Number{2, 1}, Number{3}));
  EXPECT_THAT(marks.In({.low = 2, .high = 3, .excludes_low = true, .excludes_high = true}, 0),
              ElementsAre(Number{2, 1}, Number{3, -1}));
  EXPECT_THAT(marks.In({.low = 2, .high = 2, .excludes_low = true}, 0), ElementsAre());
}

// Ends of ranges are exactly the numbers in the file, however near they are to a mark.
TEST(NumberMarks, DoNotMoveEndsOfRanges) {
  const auto check = [](const std::string& range, const std::string& asked) {
    const GroundTask task = GroundText(
        "domain n predicates: done functions: f: number\n"
        "action finish preconds: K(f >= " +
            asked + ") effects: add(Kf, done)",
        "problem n domain n init: add(Kf, f = " + range + ") goal: K(done)");
    return CheckTree(task, {.nodes = {ActOf(task, "finish", 1), PlanNode{}}, .root = NodeId(0)});
  };
  EXPECT_FALSE(check("[1700000000, 1700000001]", "1700000000.001").holds);
  EXPECT_FALSE(check("[1e-13, 1]", "4e-13").holds);
  EXPECT_TRUE(check("[4e-13, 1]", "4e-13").holds);
}

TEST(NumberMarks, StandForSumsThatAreRounded) {
  const GroundTask task = GroundText("domain n functions: f: number",
                                     "problem n domain n init: add(Kf, f = 1) goal: K(f < 2)");
  const NumberMarks marks(task, {.nodes = {PlanNode{}}, .root = NodeId(0)});
  const double below = std::nextafter(2, 0);
  EXPECT_THAT(marks.BetweenSums({below}, {below}, 0),
              ElementsAre(Number{below}, Number{2, -1}, Number{2}));
  EXPECT_THAT(marks.BetweenSums({2}, {2}, 0), ElementsAre(Number{2}));
}

// An assignment to one of two numbers: number `to` becomes `sign` times number `from`, plus some
// value between `low` and `high`. All values are in sixteenths, so that sums are exact.
struct Shift {
  int to = 0;
  int from = 0;
  int sign = 1;
  int low = 0;
  int high = 0;
};
// Several shifts of two numbers. After the shifts a bound is sensed, and each of the two branches
// relies on another bound.
struct Course {
  std::vector<Shift> shifts;
  int asked = 0;
  int bound = 0;
  int relied_on = 0;
  int if_true = 0;
  int if_false = 0;
};

Course RandomCourse(RandomStream& random) {
  Course course;
  const int shifts = 1 + random.Index(3);
  for (int i = 0; i < shifts; ++i) {
    Shift shift{.to = random.Index(2), .from = random.Index(2), .sign = 1 - 2 * random.Index(2)};
    shift.low = random.Index(16) - 8;
    shift.high = shift.low + (random.Index(2) == 0 ? 0 : random.Index(8));
    course.shifts.push_back(shift);
  }
  course.asked = random.Index(2);
  course.bound = random.Index(24) - 8;
  course.relied_on = random.Index(2);
  course.if_true = random.Index(32) - 12;
  course.if_false = random.Index(32) - 12;
  return course;
}

// Oracle: tries all multiples of half of a sixteenth one by one, for numbers and shifts.
bool HoldsOneByOne(const Course& course, std::size_t next, std::array<int, 2> numbers) {
  if (next < course.shifts.size()) {
    const Shift& shift = course.shifts[next];
    for (int by = 2 * shift.low; by <= 2 * shift.high; ++by) {
      std::array<int, 2> then = numbers;
      then[shift.to] = shift.sign * numbers[shift.from] + by;
      if (!HoldsOneByOne(course, next + 1, then)) return false;
    }
    return true;
  }
  const int relied_on = numbers[course.relied_on];
  return numbers[course.asked] > 2 * course.bound ? relied_on > 2 * course.if_true
                                                  : relied_on <= 2 * course.if_false;
}

TreeCheck CheckOf(const Course& course) {
  const auto text = [](int sixteenths) { return fmt::format("{}", sixteenths / 16.0); };
  const char* const names[] = {"f", "g"};
  std::string domain = "domain n predicates: done functions: f: number, g: number\n";
  for (std::size_t i = 0; i < course.shifts.size(); ++i) {
    const Shift& shift = course.shifts[i];
    domain += fmt::format("action shift{} effects: add(Kf, {} = [{}, {}] {} {})\n", i,
                          names[shift.to], text(shift.low), text(shift.high),
                          shift.sign > 0 ? "+" : "-", names[shift.from]);
  }
  domain += fmt::format("action look effects: add(Kw, {} > {})\n", names[course.asked],
                        text(course.bound));
  domain += fmt::format("action above preconds: K({} > {}) effects: add(Kf, done)\n",
                        names[course.relied_on], text(course.if_true));
  domain += fmt::format("action below preconds: K({} <= {}) effects: add(Kf, done)\n",
                        names[course.relied_on], text(course.if_false));
  const GroundTask task = GroundText(
      domain, "problem n domain n init: add(Kf, f = [0, 1]), add(Kf, g = [-0.5, 0]) goal: K(done)");
  const int shifts = static_cast<int>(course.shifts.size());
  PlanTree tree{.nodes = {}, .root = NodeId(0)};
  for (int i = 0; i < shifts; ++i)
    tree.nodes.push_back(ActOf(task, fmt::format("shift{}", i), i + 1));
  tree.nodes.push_back(ActOf(task, "look", shifts + 1));
  tree.nodes.push_back(BranchOf(task, TextOf(task, task.formulas.front()), shifts + 2, shifts + 3));
  tree.nodes.push_back(ActOf(task, "above", shifts + 4));
  tree.nodes.push_back(ActOf(task, "below", shifts + 4));
  tree.nodes.push_back({});
  return CheckTree(task, tree);
}

TEST(NumberMarks, TellWhatAllNumbersTell) {
  int held = 0;
  for (int seed = 0; seed < kTasks && !HasFailure(); ++seed) {
    RandomStream random(seed, "courses");
    const Course course = RandomCourse(random);
    bool holds = true;
    for (int f = 0; f <= 32; ++f) {
      for (int g = -16; g <= 0; ++g) holds = holds && HoldsOneByOne(course, 0, {f, g});
    }
    const TreeCheck check = CheckOf(course);
    EXPECT_EQ(check.holds, holds) << "seed " << seed << ": " << check.failure;
    EXPECT_TRUE(check.AreAllWorlds());
    held += holds ? 1 : 0;
  }
  EXPECT_GT(held, kTasks / 20);
  EXPECT_LT(held, kTasks / 2);
}

}  // namespace
}  // namespace assay::contingent::number_marks_test
