#include "sim/check/measurements/measurement.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "planner/base/random.h"
#include "planner/geometry/box.h"
#include "planner/geometry/pose.h"
#include "planner/plan/certificates/condition_table.h"
#include "tests/oracle/convex_solid.h"
#include "tests/sim/check/certified.h"

namespace assay::check::measurement_test {
namespace {

using geometry::Box;
using geometry::Pose;
using geometry::Vector3;
using oracle::ConvexSolid;

constexpr double kGrid = 0.006;     // metres between the oracle's sample points
constexpr double kOverlap = -1e-3;  // the observation for bodies that overlap

const Certified& Known() {
  static const Certified certified = CertifiedPlan("uncertain-known");
  return certified;
}

const domain::Part& PartNamed(const std::string& name) {
  return *std::ranges::find(Known().problem.parts, name, &domain::Part::name);
}

// Returns points on the faces of solids. Neighbours are at most kGrid apart.
std::vector<Vector3> PointsOf(const std::vector<ConvexSolid>& solids) {
  std::vector<Vector3> points;
  const auto add_triangle = [&](const Vector3& a, const Vector3& b, const Vector3& c) {
    const double longest = std::max({(b - a).norm(), (c - a).norm(), (c - b).norm()});
    const int n = static_cast<int>(std::ceil(longest / kGrid));
    for (int i = 0; i <= n; ++i) {
      for (int j = 0; i + j <= n; ++j) points.push_back(a + i * (b - a) / n + j * (c - a) / n);
    }
  };
  for (const ConvexSolid& solid : solids) {
    for (const geometry::Facet& facet : solid.hull.facets) {
      const auto at = [&](std::size_t i) { return solid.hull.vertices[facet.loop[i]]; };
      for (std::size_t i = 2; i < facet.loop.size(); ++i) add_triangle(at(0), at(i - 1), at(i));
    }
  }
  return points;
}

// Returns the oracle's distance of two bodies by sampling. It is never less than the true distance,
// and exceeds it by little because the samples are dense.
double Sampled(const std::vector<ConvexSolid>& a, const Pose& X_WorldA,
               const std::vector<ConvexSolid>& b, const Pose& X_WorldB) {
  const Pose X_BA = X_WorldB.inverse() * X_WorldA;
  double nearest = std::numeric_limits<double>::infinity();
  for (const Vector3& p : PointsOf(a)) {
    for (const ConvexSolid& solid : b)
      nearest = std::min(nearest, oracle::PointSolidDistance(X_BA * p, solid.hull));
  }
  return nearest;
}

void ExpectMeasured(double sampled, double observed) {
  if (observed == kOverlap) {
    EXPECT_LT(sampled, kGrid);
  } else {
    EXPECT_GE(sampled, observed - 1e-9);
    EXPECT_LE(sampled, observed + kGrid);
  }
}

double Observed(const std::vector<MeasuredMargin>& measured, const std::string& subject) {
  const auto found = std::ranges::find(measured, subject, &MeasuredMargin::subject);
  EXPECT_NE(found, measured.end()) << subject;
  return found == measured.end() ? 0 : found->observed;
}

std::vector<MeasuredMargin> Measured(plan::Condition condition, const plan::PlannedStep& step,
                                     const StepEvents& events) {
  return MeasurementOf(condition, KnownMeasurements())
      .measure(MeasuredStep(Known().problem, step, events));
}

const plan::PlannedStep& StepOf(const domain::ActionKind& kind) {
  return Known().plan.step(FirstStep(kind, Known().plan));
}

execution::Snapshot SnapshotWith(const Pose& X_WorldTool, double opening) {
  execution::Snapshot snapshot;
  snapshot.tool = {X_WorldTool, X_WorldTool};
  snapshot.opening = opening;
  for (const domain::Part& part : Known().problem.parts) {
    snapshot.parts.push_back({part.X_WorldPart, part.X_WorldPart});
    snapshot.table_heights.push_back(0);
  }
  return snapshot;
}

std::size_t IndexOf(const domain::Part& part) {
  return static_cast<std::size_t>(&part - Known().problem.parts.data());
}

Pose Somewhere(double reach, RandomStream& random) {
  const auto any = [&] { return random.Uniform(-reach, reach); };
  return geometry::Translation(any(), any(), any()) * geometry::RotationZ(random.Uniform(-3, 3));
}

// The closed hand is beside the block, which is put at random places about it.
TEST(Measurement, HandClearIsTheHandsDistanceFromAnotherPart) {
  const plan::PlannedStep& pickup = StepOf(domain::kPickup);
  const plan::Hold& hold = pickup.action.hold;
  const domain::Part& peg = PartNamed("peg");
  const domain::Part& block = PartNamed("block");
  const kinematics::Gripper& gripper = Known().problem.workcell->gripper();
  std::vector<Box> hand = gripper.HandBoxes();
  std::ranges::copy(gripper.FingerBoxes(hold.width), std::back_inserter(hand));
  const std::vector<ConvexSolid> block_solids = oracle::SolidsOf(*block.model);
  RandomStream random(5, "hand clear");
  int overlaps = 0;
  for (int i = 0; i < 40; ++i) {
    execution::Snapshot acted = SnapshotWith(peg.X_WorldPart * hold.X_PartTool, hold.width);
    Pose& X_WorldBlock = acted.parts[IndexOf(block)].truth;
    X_WorldBlock = acted.tool.truth * Somewhere(0.18, random);
    StepEvents events;
    events.step = FirstStep(domain::kPickup, Known().plan);
    events.acted = &acted;
    const double observed = Observed(Measured(plan::condition::kHandClear, pickup, events),
                                     "the hand stays clear of block");
    ExpectMeasured(Sampled(block_solids, X_WorldBlock, oracle::SolidsOf(hand), acted.tool.truth),
                   observed);
    overlaps += observed == kOverlap;
  }
  EXPECT_GT(overlaps, 2);
  EXPECT_LT(overlaps, 38);
}

// Pads that touch the faces of the part are clear of it. A hand that is too low is not.
TEST(Measurement, HandClearLeavesOutWhatThePadsTouch) {
  const plan::PlannedStep& pickup = StepOf(domain::kPickup);
  const plan::Hold& hold = pickup.action.hold;
  const domain::Part& peg = PartNamed("peg");
  const auto observed = [&](double ahead) {
    const execution::Snapshot acted = SnapshotWith(
        peg.X_WorldPart * hold.X_PartTool * geometry::Translation(0, 0, ahead), hold.width);
    StepEvents events;
    events.step = FirstStep(domain::kPickup, Known().plan);
    events.acted = &acted;
    return Observed(Measured(plan::condition::kHandClear, pickup, events),
                    "the hand stays clear of peg");
  };
  EXPECT_GT(observed(0), 0);
  EXPECT_NEAR(observed(-0.01) - observed(0), 0.01, 1e-6);  // distance of the palm above the part
  EXPECT_EQ(observed(0.2), kOverlap);
}

// The held part moves along the mating vector beside the block. As planned, it comes near the rim
// only. If it is displaced sideways or too far in, it meets the block.
TEST(Measurement, PassingClearIsTheWayToTheMouth) {
  const plan::PlannedStep& step = StepOf(domain::kAssemble);
  const plan::Action& assemble = step.action;
  const domain::Mating& mating = Known().problem.mating(assemble.mating);
  const domain::Part& peg = PartNamed("peg");
  const domain::Part& block = PartNamed("block");
  const Vector3 vector = block.X_WorldPart.linear() * mating.mating_vector;
  const Vector3 aside = vector.unitOrthogonal();
  const Pose X_WorldSeat = block.X_WorldPart * mating.X_FixedHeld;
  const auto observed = [&](const Vector3& off, const char* passed = "block") {
    const Pose X_WorldPeg = geometry::Translation(off - vector) * X_WorldSeat;
    execution::Snapshot poised =
        SnapshotWith(X_WorldPeg * assemble.hold.X_PartTool, assemble.hold.width);
    poised.parts[IndexOf(peg)] = {X_WorldPeg, X_WorldPeg};
    StepEvents events;
    events.step = FirstStep(domain::kAssemble, Known().plan);
    events.poised = &poised;
    return Observed(Measured(plan::condition::kPassingClear, step, events),
                    fmt::format("peg passes {} on its way in", passed));
  };
  const double planned = observed(Vector3::Zero());
  EXPECT_GT(planned, 0);
  EXPECT_LT(planned, 2e-3);  // it stops a millimetre before the mouth, which is as wide as the play
  EXPECT_NEAR(observed(-0.01 * vector.normalized()), planned + 0.01, 1e-3);
  EXPECT_NEAR(observed(1.0 * aside), 1.0, 0.2);
  EXPECT_EQ(observed(0.01 * aside + 0.01 * vector.normalized()), kOverlap);
  double lowest = 1;
  for (const Vector3& corner : peg.model->corners())
    lowest = std::min(lowest, (X_WorldSeat * corner).z());
  EXPECT_NEAR(observed(Vector3::Zero(), "the table"), lowest, 1e-9);
  EXPECT_NEAR(observed(-0.5 * Vector3::UnitZ(), "the table"), lowest - 0.5, 1e-9);
}

// Each kind says once how it is measured, or that nothing measures it.
TEST(Measurement, EveryKindHasOne) {
  std::vector<plan::Condition> measured;
  for (const Measurement& measurement : KnownMeasurements()) {
    measured.push_back(measurement.condition);
  }
  std::vector<plan::Condition> known;
  for (const plan::ConditionKind* kind : plan::KnownConditions()) known.emplace_back(*kind);
  EXPECT_THAT(measured, testing::UnorderedElementsAreArray(known));
}

}  // namespace
}  // namespace assay::check::measurement_test
