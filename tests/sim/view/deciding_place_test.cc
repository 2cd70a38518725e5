#include "sim/view/deciding_place.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "planner/domain/parts/part_model.h"
#include "planner/geometry/box.h"
#include "planner/geometry/collision.h"
#include "planner/geometry/hull.h"
#include "planner/plan/certificates/condition_table.h"
#include "tests/sim/view/viewed_execution.h"

namespace assay::view::deciding_place_test {
namespace {

namespace condition = plan::condition;
using execution::Snapshot;
using geometry::Pose;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

const ViewedExecution& Seen() { return Figure15(); }
const domain::Problem& Workcell() { return Seen().scenario.problem; }

domain::PartId PartNamed(const std::string& name) {
  const auto found = std::ranges::find(Workcell().parts, name, &domain::Part::name);
  return domain::PartId(static_cast<int>(found - Workcell().parts.begin()));
}

// The last step of figure 15 puts the peg into the block.
plan::StepId Assembly() { return Seen().plan.ExecutionOrder().back(); }

std::optional<DecidingPlace> PlaceIn(const execution::Trace& trace,
                                     const plan::CertifiedPrecondition& claim,
                                     plan::StepId step = Assembly()) {
  const std::vector<check::Claim> none;
  return PlaceOf(claim, step, {Workcell(), Seen().plan, trace, none, "test"});
}

DecidingPlace PlaceOfClaim(plan::Condition kind) {
  const auto& claims = Seen().plan.step(Assembly()).certificate.preconditions;
  const auto claim = std::ranges::find(claims, kind, &plan::CertifiedPrecondition::condition);
  EXPECT_NE(claim, claims.end()) << kind.name();
  return PlaceIn(Seen().trace, *claim).value();
}

const Snapshot& At(double time) {
  for (const execution::Sample* sample : Seen().trace.All<execution::Sample>()) {
    if (sample->snapshot.time == time) return sample->snapshot;
  }
  throw std::runtime_error("no sample has this time");
}

std::vector<geometry::ConvexHull> PiecesAt(const std::string& part, const Snapshot& at) {
  return geometry::Transformed(Workcell().part(PartNamed(part)).model->pieces(),
                               at.parts[PartNamed(part).index()].truth);
}

// Returns the metres by which the lowest point of the peg is below the block's top.
double DepthOfPeg(const Snapshot& at) {
  double top = 0;
  for (const geometry::Vector3& v : geometry::VerticesOf(PiecesAt("block", at))) {
    top = std::max(top, v.z());
  }
  return top - geometry::LowestPoint(PiecesAt("peg", at));
}

double SeatedDepth() { return DepthOfPeg(Seen().trace.end().snapshot); }

TEST(DecidingPlace, EntryIsDecidedWithTheTipInTheMouth) {
  const DecidingPlace place = PlaceOfClaim(condition::kEntry);
  EXPECT_NEAR(DepthOfPeg(At(place.time)), 0, 2e-3) << "the tip moves 2 mm at most between samples";
}

TEST(DecidingPlace, SlideInIsDecidedHalfwayDown) {
  const DecidingPlace place = PlaceOfClaim(condition::kSlideIn);
  EXPECT_GT(SeatedDepth(), 0.02);
  EXPECT_NEAR(DepthOfPeg(At(place.time)), SeatedDepth() / 2, 2e-3);
}

// The outline of the square hole has four lines at the mouth, four at the seat, and four walls. The
// tip of the seated peg is within it.
TEST(DecidingPlace, TheHoleIsOutlined) {
  const DecidingPlace place = PlaceOfClaim(condition::kEntry);
  EXPECT_THAT(place.lines, SizeIs(12));
  geometry::Vector3 middle = geometry::Vector3::Zero();
  for (const Segment& line : place.lines) middle += (line.first + line.second) / 24;
  const Snapshot& end = Seen().trace.end().snapshot;
  const double tip = geometry::LowestPoint(PiecesAt("peg", end));
  EXPECT_NEAR(middle.z(), tip + SeatedDepth() / 2, 1e-3);
  for (const geometry::ConvexHull& piece : PiecesAt("block", end)) {
    EXPECT_FALSE(geometry::Contains(piece, middle, -1e-3)) << "the middle of the hole is empty";
  }
}

// The oracle measures the distance of the whole hand from the block at every sample of the step.
TEST(DecidingPlace, TheHandIsShownWhereItIsNearest) {
  const DecidingPlace place =
      PlaceIn(Seen().trace, {condition::kHandClear, "the hand stays clear of block"}).value();
  const kinematics::Gripper& gripper = Workcell().workcell->gripper();
  double least = std::numeric_limits<double>::infinity();
  double from = 0;
  for (const execution::StepEnd* end : Seen().trace.All<execution::StepEnd>()) {
    if (end->step != Assembly()) from = end->snapshot.time;
  }
  double to = from;
  for (const execution::Milestone* milestone : Seen().trace.All<execution::Milestone>()) {
    if (milestone->stage == execution::Stage::kReached) to = milestone->snapshot.time;
  }
  for (const execution::Sample* sample : Seen().trace.All<execution::Sample>()) {
    const Snapshot& at = sample->snapshot;
    if (at.time < from || at.time > to) continue;
    std::vector<geometry::Box> hand = gripper.HandBoxes();
    for (const geometry::Box& box : gripper.FingerBoxes(at.opening)) hand.push_back(box);
    least = std::min(least, geometry::Distance(geometry::CollisionShape(hand), at.tool.truth,
                                               geometry::CollisionShape(PiecesAt("block", at)),
                                               Pose::Identity()));
  }
  ASSERT_THAT(place.lines, SizeIs(1));
  const auto& [on_hand, on_block] = place.lines[0];
  EXPECT_NEAR((on_hand - on_block).norm(), least, 2e-5);
  EXPECT_GT(least, 1e-4);
  EXPECT_THAT(place.bodies, SizeIs(1));
}

// The fingers must stay above the block, so the least distance between fingers and block is shown.
TEST(DecidingPlace, AFingertipIsShownWithItsLineToThePartBelow) {
  const DecidingPlace place = PlaceOfClaim(condition::kFingertip);
  EXPECT_THAT(place.bodies, ElementsAre(testing::StartsWith("gripper/finger_")));
  ASSERT_THAT(place.lines, SizeIs(1));
  const auto& [tip, below] = place.lines[0];
  EXPECT_GT(tip.z(), below.z());
  EXPECT_LT((tip - below).head<2>().norm(), 1e-4) << "the gap is vertical";
  EXPECT_LT((tip - below).norm(), 0.01);
}

TEST(DecidingPlace, FingersAreShownWithTheLineBetweenTheirPads) {
  for (const plan::StepId step : Seen().plan.ExecutionOrder()) {
    for (const auto& claim : Seen().plan.step(step).certificate.preconditions) {
      if (claim.condition != condition::kBetweenFingers) continue;
      const auto place = PlaceIn(Seen().trace, claim, step);
      ASSERT_TRUE(place);
      EXPECT_THAT(place->bodies, ElementsAre("gripper/finger_left", "gripper/finger_right"));
      ASSERT_THAT(place->lines, SizeIs(1));
      const auto& [left, right] = place->lines[0];
      EXPECT_NEAR((left - right).norm(), At(place->time).opening, 1e-12);
      return;
    }
  }
  FAIL() << "no step takes a part between the fingers";
}

TEST(DecidingPlace, AStandingPartIsShownWhereTheStepActs) {
  const DecidingPlace place = PlaceOfClaim(condition::kStanding);
  EXPECT_THAT(place.bodies, ElementsAre("part/peg"));
  EXPECT_THAT(place.lines, IsEmpty());
  EXPECT_NEAR(DepthOfPeg(At(place.time)), SeatedDepth(), 1e-3);
}

TEST(DecidingPlace, AStepThatWasNotReachedHasNone) {
  execution::Trace trace = Seen().trace;
  std::erase_if(trace.events, [](const execution::TraceEvent& event) {
    const auto* milestone = std::get_if<execution::Milestone>(&event);
    return milestone != nullptr && milestone->step == Assembly();
  });
  const auto& claims = Seen().plan.step(Assembly()).certificate.preconditions;
  EXPECT_EQ(PlaceIn(trace, claims.front()), std::nullopt);
}

}  // namespace
}  // namespace assay::view::deciding_place_test
