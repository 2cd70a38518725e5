#include "planner/finemotion/motions/motion_checker.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "bench/workloads/pegs.h"

namespace assay::finemotion::motion_checker_test {
namespace {

using workloads::BoxShape;

// A peg comes down by a centimetre without a contact, or onto its corner 0.
constexpr double kDown = 0.01;
constexpr ContactKey kCorner{ContactKind::kVertexFace, 0, 5};

const Polyhedron& Peg() {
  static const Polyhedron peg = BoxShape({-0.019, -0.019, 0}, {0.019, 0.019, 0.07});
  return peg;
}

CertainMotion ComeDown(const Polyhedron& stationary, const BelievedPose& believed,
                       const std::optional<ContactKey>& until) {
  PoseChange down = PoseChange::Zero();
  down.z() = -kDown;
  const MotionChecker checker(Peg(), ContactFinder(Peg(), stationary), {.velocity_error = 0});
  return checker.Check(believed, {down, {}, until}, Margins::kAll);
}

BelievedPose Erring(const Pose& X, int coordinate, double error) {
  BelievedPose believed{X, PoseChanges::Zero(kPoseDimensions, 1)};
  believed.errors(coordinate, 0) = error;
  return believed;
}

double ScaleOf(const CertainMotion& motion, const ContactKey& key) {
  const auto& unwanted = motion.check.unwanted;
  const auto found = std::ranges::find(unwanted, key, &Unwanted::contact);
  return found == unwanted.end() ? kBeyondLadder : found->scale;
}

double LeastOnLadder(const auto& happens) {
  const auto found = std::ranges::find_if(kLadder, happens);
  return found == std::end(kLadder) ? kBeyondLadder : *found;
}

// The distance of the wall is the displacement of the peg by an enlarged error, however large it
// is.
TEST(MotionChecker, AWallIsMetAtTheEnlargementThatReachesIt) {
  for (const double away : {0.001, 0.006, 0.013, 0.022, 0.039, 0.041}) {
    const Polyhedron wall = BoxShape({0.019 + away, -1, -1}, {2, 1, 1});
    const CertainMotion motion = ComeDown(wall, Erring(Pose::Identity(), 0, 0.01), {});
    const double scale = LeastOnLadder([&](double step) { return step * 0.01 >= away; });
    EXPECT_EQ(motion.check.certain, scale > 1) << away;
    const double told =
        motion.check.unwanted.empty() ? kBeyondLadder : motion.check.unwanted.front().scale;
    EXPECT_EQ(told, scale) << away;
  }
}

// The peg is tilted so that the height of a side corner corresponds to this turn back. The tilt
// allows errors to make edges of top and floor parallel.
TEST(MotionChecker, TheNextCornerComesFirstAtTheTurnThatLowersIt) {
  const Polyhedron floor = BoxShape({-1, -1, -1}, {1, 1, 0});
  for (const double turn : {0.11, 0.09, 0.07, 0.055, 0.04, 0.028, 0.024}) {
    PoseChange tilt = PoseChange::Zero();
    tilt.tail<3>() << 0.3, -0.1, 0;
    Pose X = Displaced(Pose::Identity(), tilt);
    X.pretranslate(Vector3(0, 0, kDown - (X * Peg().vertices[0].p).z()));
    const Vector3 side = X.linear().col(0);
    const double scale =
        LeastOnLadder([&](double step) { return step * turn * side.x() >= side.z(); });
    const CertainMotion motion = ComeDown(floor, Erring(X, 4, turn), kCorner);
    EXPECT_EQ(ScaleOf(motion, {ContactKind::kVertexFace, 1, 5}), scale) << turn;
  }
}

TEST(MotionChecker, MarginsAreToldByRisingScaleWithTheirContacts) {
  const Polyhedron wall = BoxShape({0.023, -1, -1}, {2, 1, 1});
  const CertainMotion motion = ComeDown(wall, Erring(Pose::Identity(), 0, 0.003), {});
  EXPECT_TRUE(motion.check.certain);
  ASSERT_FALSE(motion.check.unwanted.empty());
  EXPECT_TRUE(std::ranges::is_sorted(motion.check.unwanted, {}, &Unwanted::scale));
  for (const Unwanted& unwanted : motion.check.unwanted)
    EXPECT_NE(Find(motion.contacts, unwanted.contact), nullptr);
}

}  // namespace
}  // namespace assay::finemotion::motion_checker_test
