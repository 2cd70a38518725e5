#include "planner/domain/problem/possible_starts.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planner/base/random.h"
#include "planner/domain/parts/part_model.h"
#include "planner/geometry/hull.h"
#include "planner/geometry/pose.h"
#include "planner/geometry/solids/separation.h"
#include "tests/planner/domain/scenario.h"

namespace assay::domain::possible_starts_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Pair;

constexpr double kBrick = 50.8;  // mm, width of a brick that stands upright

// Returns two bricks that stand upright beside each other, with a gap along x.
std::string TwoBricks(double gap, const std::string& error, const std::string& error_of_other) {
  return fmt::format(R"(
format: assay-scenario/1
units: {{length: mm, angle: degree}}
workcell: puma762-table
parts:
  one: {{model: brick, pose: {{stable: upright, at: [600, 50]}}, error: {}}}
  two: {{model: brick, pose: {{stable: upright, at: [{}, 50]}}, error: {}}}
goal:
  - located: {{part: one, stable: [upright]}}
)",
                     error, 600 + kBrick + gap, error_of_other);
}

// A mated pair of bricks, one on top of the other, and the error of each.
std::string OneOnTheOther(const std::string& upper, const std::string& lower) {
  return fmt::format(R"(
format: assay-scenario/1
units: {{length: inch, angle: degree}}
workcell: puma762-table
parts:
  lower: {{model: brick, pose: {{stable: upright, at: [24, 2], yaw: 30}}, error: {}}}
  upper: {{model: brick, error: {}}}
  other: {{model: brick, pose: {{stable: upright, at: [24, -8]}}}}
initially:
  - assembled: {{held: upper, fixed: lower, features: [[6], [5]],
                pose: {{columns: [[1, 0, 0], [0, 1, 0], [0, 0, 1], [0, 0, 4]]}},
                mating_vector: [0, 0, -1]}}
goal:
  - located: {{part: other, stable: [upright]}}
)",
                     lower, upper);
}

// A peg in a block that lies on its back, and the error of each. The clearance is 1 mm.
std::string PegInBlock(const std::string& peg, const std::string& block) {
  return fmt::format(R"(
format: assay-scenario/1
units: {{length: mm, angle: degree}}
workcell: puma762-table
clearance: 1
parts:
  block: {{model: block, pose: {{stable: on-back, at: [600, 50], yaw: 30}}, error: {}}}
  peg: {{model: peg, error: {}}}
  other: {{model: brick, pose: {{stable: upright, at: [600, -300]}}}}
initially:
  - assembled: {{held: peg, fixed: block, features: [[7, 8], [7, 8]],
                pose: {{columns: [[-1, 0, 0], [0, 1, 0], [0, 0, -1], [76.2, 0, 82.55]]}},
                mating_vector: [-101.6, 0, 0]}}
goal:
  - located: {{part: other, stable: [upright]}}
)",
                     block, peg);
}

std::string MessageOf(const std::string& text) {
  try {
    ParseScenario(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

std::vector<PartPair> PairsOf(const std::string& text) {
  return PairsThatMayOverlap(ParseScenario(text));
}

TEST(PossibleStarts, PairsAreNamedIfTheirErrorsCloseTheGap) {
  const auto both = ElementsAre(Pair(PartId(0), PartId(1)));
  EXPECT_THAT(PairsOf(TwoBricks(0.5, "{x: 3, y: 3}", "{x: 3, y: 3}")), both);
  EXPECT_THAT(PairsOf(TwoBricks(0.5, "{x: 0.6}", "{}")), both);
  EXPECT_THAT(PairsOf(TwoBricks(0.5, "{x: [-3, 0.4]}", "{}")), IsEmpty());
  EXPECT_THAT(PairsOf(TwoBricks(0.5, "{y: 30}", "{y: 30}")), IsEmpty());
  EXPECT_THAT(PairsOf(TwoBricks(5.9, "{x: 3}", "{x: 3}")), both);
  EXPECT_THAT(PairsOf(TwoBricks(6.1, "{x: 3}", "{x: 3}")), IsEmpty());
  EXPECT_THAT(PairsOf(TwoBricks(0, "{}", "{}")), IsEmpty());
  // A brick that is turned by 45 degrees about its middle is wider by 21 mm.
  EXPECT_THAT(PairsOf(TwoBricks(9, "{theta: 45}", "{}")), both);
  EXPECT_THAT(PairsOf(TwoBricks(12, "{theta: 45}", "{}")), IsEmpty());
}

// Without errors of height, a part stays above what it stands on.
TEST(PossibleStarts, PartsOnEachOtherNeverOverlap) {
  EXPECT_THAT(PairsOf(OneOnTheOther("{x: 0.5, y: 0.5, theta: 5}", "{x: 0.5}")), IsEmpty());
}

// The seat of a peg touches the block's, but the walls of the hole leave room for small errors.
TEST(PossibleStarts, APegInAHoleOverlapsItsWallsOnly) {
  EXPECT_THAT(PairsOf(PegInBlock("{}", "{}")), IsEmpty());
  EXPECT_THAT(PairsOf(PegInBlock("{x: 0.05, y: 0.05, theta: 0.02}", "{z: 0.5}")), IsEmpty());
  EXPECT_THAT(PairsOf(PegInBlock("{x: 0.2, y: 0.2}", "{x: 0.2, y: 0.2, theta: 0.1}")), IsEmpty());
  const auto both = ElementsAre(Pair(PartId(0), PartId(1)));
  EXPECT_THAT(PairsOf(PegInBlock("{x: 3}", "{}")), both);
  EXPECT_THAT(PairsOf(PegInBlock("{}", "{y: 3}")), both);
  EXPECT_THAT(PairsOf(PegInBlock("{theta: 10}", "{}")), both);
}

bool BoxesOverlap(const Part& a, const Pose& X_WorldA, const Part& b, const Pose& X_WorldB) {
  for (const geometry::ConvexHull& of_a : Transformed(a.model->pieces(), X_WorldA)) {
    for (const geometry::ConvexHull& of_b : Transformed(b.model->pieces(), X_WorldB)) {
      if (geometry::Separation(of_a, of_b) < -1e-7) return true;
    }
  }
  return false;
}

Pose DrawnPose(const Part& part, RandomStream& random) {
  // Ends of the ranges are likely, since parts overlap there first.
  const auto draw = [&](const Interval& range) {
    const int which = random.Index(3);
    return which == 0 ? range.low : which == 1 ? range.high : random.Uniform(range.low, range.high);
  };
  Pose drawn = geometry::RotationZ(draw(part.error.theta)) * part.X_WorldPart;
  const double x = draw(part.error.x);
  drawn.translation() = part.X_WorldPart.translation() + Vector3(x, draw(part.error.y), 0);
  return drawn;
}

// The oracle draws errors and tests the boxes along all separating axes. What it finds must be
// named, and nothing may be named that is farther apart than all errors reach.
TEST(PossibleStarts, NoPairThatOverlapsSomewhereIsMissed) {
  RandomStream random(7, "pairs");
  int found = 0, free = 0;
  for (int i = 0; i < 60; ++i) {
    const auto error = [&] {
      return fmt::format("{{x: {:.2f}, y: {:.2f}, theta: {:.2f}}}", random.Uniform(0, 4),
                         random.Uniform(0, 4), random.Uniform(0, 6));
    };
    const std::string first = error();
    const Problem problem = ParseScenario(TwoBricks(random.Uniform(0.1, 12), first, error()));
    const Part& one = problem.parts[0];
    const Part& two = problem.parts[1];
    bool overlaps = false;
    for (int draw = 0; draw < 2000 && !overlaps; ++draw) {
      const Pose X_WorldOne = DrawnPose(one, random);
      overlaps = BoxesOverlap(one, X_WorldOne, two, DrawnPose(two, random));
    }
    const bool is_named = !PairsThatMayOverlap(problem).empty();
    EXPECT_LE(overlaps, is_named) << i;
    ++(overlaps ? found : free);
    // The draws come within a millimetre of the worst errors.
    if (!overlaps && is_named) {
      const PossibleStarts starts(problem);
      EXPECT_LT(starts.Between({PartId(0), one.X_WorldPart}, {PartId(1), two.X_WorldPart}), 0.015);
    }
  }
  EXPECT_GT(found, 10);
  EXPECT_GT(free, 10);
}

TEST(PossibleStarts, NoWallThatAPegOverlapsIsMissed) {
  RandomStream random(11, "pegs");
  int found = 0, free = 0;
  for (int i = 0; i < 40; ++i) {
    const auto error = [&] {
      return fmt::format("{{x: {:.2f}, y: {:.2f}, theta: {:.2f}}}", random.Uniform(0, 0.7),
                         random.Uniform(0, 0.7), random.Uniform(0, 0.5));
    };
    const std::string peg = error();
    const Problem problem = ParseScenario(PegInBlock(peg, error()));
    const PossibleStarts starts(problem);
    bool overlaps = false;
    for (int draw = 0; draw < 500 && !overlaps; ++draw) {
      const Pose X_WorldBlock = DrawnPose(problem.parts[0], random);
      overlaps = starts.Overlap({PartId(0), X_WorldBlock},
                                {PartId(1), DrawnPose(problem.parts[1], random)});
    }
    EXPECT_LE(overlaps, !PairsThatMayOverlap(problem).empty()) << i;
    ++(overlaps ? found : free);
  }
  EXPECT_GT(found, 5);
  EXPECT_GT(free, 5);
}

TEST(PossibleStarts, PosesOverlapBeyondContactOnly) {
  const Problem problem = ParseScenario(TwoBricks(0, "{}", "{}"));
  const PossibleStarts starts(problem);
  const PlacedPart one = {PartId(0), problem.parts[0].X_WorldPart};
  const auto at = [&](double nearer) {
    return PlacedPart{PartId(1),
                      geometry::Translation(-nearer, 0, 0) * problem.parts[1].X_WorldPart};
  };
  EXPECT_FALSE(starts.Overlap(one, at(0)));
  EXPECT_TRUE(starts.Overlap(one, at(2 * PossibleStarts::kGreatestOverlap)));
  EXPECT_FALSE(starts.FirstOverlap(std::vector{one.X_WorldPart, at(-1e-6).X_WorldPart}));
  EXPECT_EQ(starts.FirstOverlap(std::vector{one.X_WorldPart, at(1e-3).X_WorldPart}),
            PartPair(PartId(0), PartId(1)));
}

// If parts overlap at the start, the engine throws them apart, even if the overlap is smaller than
// the allowance of the geometric tests.
TEST(PossibleStarts, BelievedPosesThatOverlapAreRefused) {
  const std::string allowance = "rules: {contact_allowance: 0.2}\n";
  EXPECT_EQ(MessageOf(TwoBricks(-0.005, "{}", "{}") + allowance), "no error");
  EXPECT_THAT(MessageOf(TwoBricks(-0.1, "{}", "{}") + allowance),
              HasSubstr("part 'two' overlaps part 'one' at the start"));
  EXPECT_THAT(MessageOf(TwoBricks(-3, "{}", "{}") + "rules: {contact_allowance: 4}\n"),
              HasSubstr("4 mm is out of range; allowed: 0 mm to 0.2 mm"));
}

TEST(PossibleStarts, AnAssembledPartHasTheHeightErrorOfItsCarrier) {
  const Problem problem = ParseScenario(OneOnTheOther("{x: 0.01}", "{x: 0.01, z: [-0.02, 0.03]}"));
  const PartId upper = PartNamed(problem, "upper");
  EXPECT_EQ(CarrierAtStart(problem, upper), PartNamed(problem, "lower"));
  EXPECT_EQ(CarrierAtStart(problem, PartNamed(problem, "other")), PartNamed(problem, "other"));
  EXPECT_EQ(problem.part(upper).error.z, problem.part(PartNamed(problem, "lower")).error.z);
  EXPECT_LT(problem.part(upper).error.z.low, 0);
  EXPECT_THAT(MessageOf(OneOnTheOther("{z: 0.01}", "{}")),
              HasSubstr("part 'upper' is assembled at the start, so that its height has the error "
                        "of part 'lower'"));
}

// The tables under two parts have heights of their own, and would lift one part off the other.
TEST(PossibleStarts, PartsThatStandOnEachOtherHaveNoHeightErrors) {
  const auto stacked = [](const std::string& error, const std::string& error_of_upper) {
    return fmt::format(R"(
format: assay-scenario/1
units: {{length: inch, angle: degree}}
workcell: puma762-table
parts:
  lower: {{model: brick, pose: {{stable: upright, at: [24, 2]}}, error: {}}}
  upper: {{model: brick, error: {},
          pose: {{columns: [[1, 0, 0], [0, 1, 0], [0, 0, 1], [24, 2, 6]]}}}}
goal:
  - located: {{part: lower, stable: [upright]}}
)",
                       error, error_of_upper);
  };
  EXPECT_EQ(MessageOf(stacked("{x: 0.1}", "{theta: 1}")), "no error");
  EXPECT_THAT(
      MessageOf(stacked("{z: 0.1}", "{}")),
      HasSubstr("part 'upper' stands on part 'lower', and part 'lower' has a height error"));
  EXPECT_THAT(MessageOf(stacked("{}", "{z: 0.1}")),
              HasSubstr("and part 'upper' has a height error"));
}

}  // namespace
}  // namespace assay::domain::possible_starts_test
