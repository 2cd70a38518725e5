#include "sim/execution/trial/finding.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "planner/domain/matings/mating_success.h"
#include "planner/domain/problem/problem_file.h"
#include "planner/geometry/pose.h"

namespace assay::execution::finding_test {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

// Each predicate is tested on both sides of its limit. The mating is Spar's: the axis of hole and
// shaft is x of the block, and the mating vector is along -x.
class MatingPredicates : public testing::Test {
 protected:
  MatingPredicates()
      : problem_(domain::ReadProblem(Document::Load(ASSAY_SOURCE_DIR "/scenarios/spar-fig15.yaml"),
                                     ASSAY_SOURCE_DIR "/models")),
        mating_(problem_.matings.front()) {}

  // Returns the mated pose displaced in the frame of the block, in metres.
  Pose Displaced(double x, double y, double z) const {
    return geometry::Translation(x, y, z) * mating_.X_FixedHeld;
  }
  // Returns the mated pose turned about the peg's own origin.
  Pose Turned(const Pose& turn) const { return mating_.X_FixedHeld * turn; }

  domain::Problem problem_;
  domain::Mating mating_;
  Limits limits_;
};

TEST_F(MatingPredicates, AllHoldAtTheMatedPose) {
  const Pose& X = mating_.X_FixedHeld;
  EXPECT_NEAR(SeatedDepth(problem_, mating_, X).value, 0, 1e-12);
  EXPECT_NEAR(LateralError(problem_, mating_, X).value, 0, 1e-12);
  EXPECT_NEAR(AxisAngle(problem_, mating_, X).value, 0, 1e-9);
  EXPECT_NEAR(AlignmentError(problem_, mating_, 1, X).value, 0, 1e-9);
}

TEST_F(MatingPredicates, SeatedDepthIsAlongTheMatingVector) {
  for (const double sign : {-1.0, 1.0}) {
    const Finding in = SeatedDepth(problem_, mating_, Displaced(sign * 0.00099, 0.1, 0.1));
    EXPECT_NEAR(in.value, 0.00099, 1e-12);
    EXPECT_TRUE(in.holds);
    EXPECT_FALSE(SeatedDepth(problem_, mating_, Displaced(sign * 0.00101, 0, 0)).holds);
  }
}

TEST_F(MatingPredicates, LateralErrorIsAcrossEachSideOfTheHole) {
  const double limit = problem_.clearance + domain::kLateralSlack;
  for (const double e : {-limit, limit}) {
    const double in = 0.99 * e, out = 1.01 * e;
    EXPECT_TRUE(LateralError(problem_, mating_, Displaced(0.1, in, in)).holds);
    EXPECT_FALSE(LateralError(problem_, mating_, Displaced(0, out, 0)).holds);
    EXPECT_FALSE(LateralError(problem_, mating_, Displaced(0, 0, out)).holds);
  }
}

// The lateral error is measured at the tip of the shaft, and a tilt moves the tip.
TEST_F(MatingPredicates, LateralErrorSeesTheTipOfATiltedShaft) {
  const Finding finding = LateralError(problem_, mating_, Turned(geometry::RotationZ(1 * kDegree)));
  EXPECT_NEAR(finding.value, 2.75 * 0.0254 * std::sin(1 * kDegree), 1e-9);
}

TEST_F(MatingPredicates, AxisAngleCountsTiltAndNotTurning) {
  const auto angle = [&](const Pose& turn) { return AxisAngle(problem_, mating_, Turned(turn)); };
  for (const double sign : {-1.0, 1.0}) {
    EXPECT_TRUE(angle(geometry::RotationY(sign * 1.49 * kDegree)).holds);
    EXPECT_FALSE(angle(geometry::RotationY(sign * 1.51 * kDegree)).holds);
    EXPECT_TRUE(angle(geometry::RotationZ(sign * 1.49 * kDegree)).holds);
    EXPECT_FALSE(angle(geometry::RotationZ(sign * 1.51 * kDegree)).holds);
  }
  EXPECT_NEAR(angle(geometry::RotationX(1)).value, 0, 1e-9);
}

// Half a turn about the axis seats the peg, but then the small holes are on opposite sides.
TEST_F(MatingPredicates, AlignmentErrorSeesAPegPutInTheWrongWayRound) {
  const Finding turned =
      AlignmentError(problem_, mating_, 1, Turned(geometry::RotationX(180 * kDegree)));
  EXPECT_NEAR(turned.value, 2 * 1.125 * 0.0254, 1e-9);
  EXPECT_FALSE(turned.holds);
}

TEST_F(MatingPredicates, AlignmentErrorHasItsLimit) {
  const double limit = 3 * problem_.clearance + domain::kLateralSlack;
  const auto across = [&](double y) {
    return AlignmentError(problem_, mating_, 1, Displaced(0.05, y, 0));
  };
  EXPECT_TRUE(across(0.99 * limit).holds);
  EXPECT_FALSE(across(1.01 * limit).holds);
}

TEST_F(MatingPredicates, NotANumberDoesNotHold) {
  const Pose nowhere = Displaced(std::nan(""), std::nan(""), std::nan(""));
  EXPECT_FALSE(SeatedDepth(problem_, mating_, nowhere).holds);
  EXPECT_FALSE(AlignmentError(problem_, mating_, 1, nowhere).holds);
}

TEST_F(MatingPredicates, ReleasedNeedsAnOpenGripperThatTouchesNothing) {
  const domain::Part& peg = problem_.part(mating_.held);
  const auto released = [&](double opening, bool touching) {
    return Released(peg, {.opening = opening, .held_width = 0.05, .touching = touching}, limits_)
        .holds;
  };
  EXPECT_TRUE(released(0.0511, false));
  EXPECT_FALSE(released(0.0509, false));
  EXPECT_FALSE(released(0.0511, true));
}

TEST_F(MatingPredicates, AtRestLimitsBothSpeeds) {
  const domain::Part& peg = problem_.part(mating_.held);
  const auto at_rest = [&](double linear, double angular) {
    const std::vector<Finding> findings = AtRest(peg, {linear, angular}, limits_);
    return findings[0].holds && findings[1].holds;
  };
  EXPECT_TRUE(at_rest(0.00099, 0.0199));
  EXPECT_FALSE(at_rest(0.00101, 0));
  EXPECT_FALSE(at_rest(0, 0.0201));
}

class LocatedPredicate : public MatingPredicates {
 protected:
  bool Holds(const Pose& X_WorldPart) const {
    const std::vector<Finding> findings =
        Located(block(), {domain::StablePoseId(0), domain::StablePoseId(1)}, X_WorldPart, limits_);
    return findings[0].holds && findings[1].holds;
  }
  const domain::Part& block() const { return problem_.part(mating_.fixed); }
  const Pose& X_TableBlock(std::size_t i) const {
    return block().model->stable_poses()[i].X_TablePart;
  }
};

TEST_F(LocatedPredicate, HoldsAnywhereOnTheTableInEachOfThePoses) {
  const Pose moved = geometry::Translation(0.3, -0.2, 0) * geometry::RotationZ(1);
  EXPECT_TRUE(Holds(moved * X_TableBlock(0)));
  EXPECT_TRUE(Holds(moved * X_TableBlock(1)));
  EXPECT_FALSE(Holds(moved * X_TableBlock(2)));
}

TEST_F(LocatedPredicate, HasLimitsOfTiltAndHeight) {
  const Pose& rests = X_TableBlock(0);
  const auto tilted = [&](double degrees) {
    Pose pose = rests;
    pose.linear() = geometry::RotationX(degrees * kDegree).linear() * rests.linear();
    return pose;
  };
  EXPECT_TRUE(Holds(tilted(0.99)));
  EXPECT_FALSE(Holds(tilted(1.01)));
  EXPECT_TRUE(Holds(geometry::Translation(0, 0, 0.00099) * rests));
  EXPECT_FALSE(Holds(geometry::Translation(0, 0, 0.00101) * rests));
  EXPECT_FALSE(Holds(geometry::Translation(0, 0, -0.00101) * rests));
}

}  // namespace
}  // namespace assay::execution::finding_test
