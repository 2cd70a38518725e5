#include "sim/check/trial_verdicts/extreme_poses.h"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "planner/domain/problem/problem_file.h"
#include "planner/geometry/pose.h"
#include "sim/check/measurements/observed_error.h"

namespace assay::check::extreme_poses_test {
namespace {

using geometry::Pose;
using geometry::RotationX;
using geometry::RotationZ;
using geometry::Translation;
using geometry::Vector3;

constexpr double kRight = std::numbers::pi / 2;

const domain::PartId kPart(0);

execution::Snapshot SnapshotWith(const Pose& believed_part,
                                 const Pose& believed_tool = Pose::Identity()) {
  // The true poses do not matter.
  const Pose elsewhere = Translation(7, 7, 7);
  execution::Snapshot snapshot;
  snapshot.tool = {elsewhere, believed_tool};
  snapshot.parts = {{elsewhere, believed_part}};
  return snapshot;
}

// Returns the error set of a part with these ranges. All other components are 0.
plan::ErrorSet SetWith(
    std::initializer_list<std::pair<Interval plan::ErrorSet::*, Interval>> ranges,
    bool in_hand = false) {
  plan::ErrorSet set;
  set.part = kPart;
  set.in_hand = in_hand;
  for (const auto& [component, range] : ranges) set.*component = range;
  return set;
}

plan::Action PickupWith(const Pose& X_PartTool) {
  plan::Action pickup{.kind = &domain::kPickup};
  pickup.hold.X_PartTool = X_PartTool;
  return pickup;
}

void ExpectPoses(const std::vector<Pose>& poses, const std::vector<Pose>& expected) {
  ASSERT_EQ(poses.size(), expected.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    EXPECT_TRUE(poses[i].isApprox(expected[i], 1e-12)) << i << "\n" << poses[i].matrix();
  }
}

TEST(ExtremePoses, AreShiftedInTheAxesOfTheWorld) {
  const Pose believed = Translation(1, 2, 3) * RotationZ(kRight);
  ExpectPoses(
      ExtremePoses(plan::Action{.kind = &domain::kSense},
                   SetWith({{&plan::ErrorSet::x, {-0.01, 0.03}}}), SnapshotWith(believed)),
      {Translation(0.99, 2, 3) * RotationZ(kRight), Translation(1.03, 2, 3) * RotationZ(kRight)});
}

TEST(ExtremePoses, AreTurnedAboutThePartsOwnOrigin) {
  const Pose believed = Translation(1, 2, 3) * RotationX(kRight);
  ExpectPoses(
      ExtremePoses(plan::Action{.kind = &domain::kSense},
                   SetWith({{&plan::ErrorSet::theta, {-kRight, 0.1}}}), SnapshotWith(believed)),
      {Translation(1, 2, 3) * RotationZ(-kRight) * RotationX(kRight),
       Translation(1, 2, 3) * RotationZ(0.1) * RotationX(kRight)});
}

TEST(ExtremePoses, LeaveTheOtherComponentsAtTheirMiddle) {
  ExpectPoses(
      ExtremePoses(plan::Action{.kind = &domain::kSense},
                   SetWith({{&plan::ErrorSet::x, {0, 0.02}}, {&plan::ErrorSet::z, {0.1, 0.3}}}),
                   SnapshotWith(Pose::Identity())),
      {Translation(0, 0, 0.2), Translation(0.02, 0, 0.2), Translation(0.01, 0, 0.1),
       Translation(0.01, 0, 0.3)});
}

TEST(ExtremePoses, AreThoseThatCanBeSeen) {
  const execution::Snapshot snapshot = SnapshotWith(Pose::Identity());
  const plan::ErrorSet small =
      SetWith({{&plan::ErrorSet::x, {-0.0001, 0.0001}}, {&plan::ErrorSet::theta, {-0.001, 0.001}}});
  EXPECT_TRUE(ExtremePoses(plan::Action{.kind = &domain::kSense}, small, snapshot).empty());
  EXPECT_EQ(
      ExtremePoses(plan::Action{.kind = &domain::kSense}, small, snapshot, {.length = 0.00019})
          .size(),
      2);
  EXPECT_EQ(ExtremePoses(plan::Action{.kind = &domain::kSense}, small, snapshot, {.angle = 0.0019})
                .size(),
            2);
}

TEST(ExtremePoses, HaveNoEndsWhereThereIsNoBound) {
  const double infinity = std::numeric_limits<double>::infinity();
  ExpectPoses(ExtremePoses(plan::Action{.kind = &domain::kSense},
                           SetWith({{&plan::ErrorSet::x, {-infinity, infinity}},
                                    {&plan::ErrorSet::y, {-0.01, 0.01}}}),
                           SnapshotWith(Pose::Identity())),
              {Translation(0, -0.01, 0), Translation(0, 0.01, 0)});
}

// The grasped point is 0.1 m from the part's origin along the part's x, which is the tool's x. A
// turn by a right angle about the point brings the origin from the point's -x side to its -y side.
TEST(ExtremePoses, InTheHandAreTurnedAboutTheGraspedPoint) {
  const plan::Action pickup = PickupWith(Translation(0.1, 0, 0));
  const Pose tool = Translation(1, 0, 0.5);
  const plan::ErrorSet set = SetWith({{&plan::ErrorSet::theta, {0, kRight}}}, true);
  const std::vector<Pose> poses =
      ExtremePoses(pickup, set, SnapshotWith(Translation(9, 9, 9), tool));
  // The other components are at the middle of their ranges, which is 0. The low end of theta is 0.
  ExpectPoses(poses, {Translation(0.9, 0, 0.5), Translation(1, -0.1, 0.5) * RotationZ(kRight)});
}

TEST(ExtremePoses, InTheHandAreShiftedAlongTheAxesOfTheTool) {
  const plan::Action pickup = PickupWith(Pose::Identity());
  const Pose tool = RotationX(kRight);  // its y is the world's z
  const plan::ErrorSet set = SetWith({{&plan::ErrorSet::y, {-0.02, 0.04}}}, true);
  ExpectPoses(ExtremePoses(pickup, set, SnapshotWith(Pose::Identity(), tool)),
              {Translation(0, 0, -0.02) * tool, Translation(0, 0, 0.04) * tool});
}

// The error that is observed at an extreme pose is at that end of the error set.
TEST(ExtremePoses, AreWhereTheErrorsAreObservedAtTheirEnds) {
  const domain::Problem problem = domain::ReadProblem(
      Document::Load(ASSAY_SOURCE_DIR "/scenarios/spar-fig15.yaml"), ASSAY_SOURCE_DIR "/models");
  const Pose planned = Translation(0.5, 0.1, 0) * RotationZ(0.7);
  plan::Action putdown{.kind = &domain::kPutdown};
  putdown.hold.X_PartTool = Translation(0.02, 0.01, 0.03) * RotationX(2);
  putdown.place.X_WorldPart = planned;
  execution::Snapshot snapshot = SnapshotWith(Translation(0.001, 0, 0) * planned * RotationZ(0.2),
                                              Translation(0.3, 0.2, 0.1) * RotationX(3));
  for (const bool in_hand : {false, true}) {
    plan::ErrorSet set = SetWith({{&plan::ErrorSet::x, {-0.01, 0.02}},
                                  {&plan::ErrorSet::y, {-0.03, 0.04}},
                                  {&plan::ErrorSet::z, {-0.01, 0}},
                                  {&plan::ErrorSet::theta, {-0.1, 0.3}}},
                                 in_hand);
    if (in_hand) {
      set.tip = {-0.2, 0.1};
      set.twist = {0, 0.1};
    }
    const std::vector<Pose> poses = ExtremePoses(putdown, set, snapshot);
    ASSERT_EQ(poses.size(), in_hand ? 12 : 8);
    for (std::size_t i = 0; i < poses.size(); ++i) {
      snapshot.parts.front().truth = poses[i];
      const std::vector<ObservedError> observed = ObservedErrors(problem, putdown, set, snapshot);
      for (std::size_t k = 0; k < poses.size() / 2; ++k) {
        const auto& [low, high] = observed[k].predicted;
        const double end = i % 2 == 0 ? low : high;
        EXPECT_NEAR(observed[k].observed, k == i / 2 ? end : (low + high) / 2, 1e-12)
            << observed[k].name << " at pose " << i;
      }
    }
  }
}

}  // namespace
}  // namespace assay::check::extreme_poses_test
