#include "planner/motion/collision/pair_errors.h"

#include <gtest/gtest.h>

#include "planner/geometry/pose.h"
#include "planner/motion/paths/straight_line.h"
#include "tests/planner/motion/arm_scene.h"

namespace assay::motion::pair_errors_test {
namespace {

constexpr double kRounding = 1e-6;  // metres
constexpr double kFar = 10;         // metres: distances up to it are computed

const JointVector kSway = (JointVector() << 0.02, 0.02, 0.03, 0.1, 0.1, 0.1).finished();
const plan::ToolErrorBox kTool = {.shift = {0.003, 0.002, 0.001}, .turn = 0.1, .spin = 0.05};

// Returns a scene in which the block may be turned.
CollisionScene WithErrors() {
  Surroundings surroundings = PegInTheHand();
  surroundings.errors.resize(Clutter().parts.size());
  for (auto& error : surroundings.errors) error = {.shift = 0.002, .turn = 0.15};
  surroundings.errors[surroundings.held->part.index()].turn = 0;
  return {Clutter(), surroundings};
}

ErrorVector AnyErrors(const ErrorVector& half, RandomStream& random) {
  ErrorVector errors;
  // Half of the errors are as large as they may be.
  for (int k = 0; k < 9; ++k) errors[k] = half[k] * std::clamp(random.Uniform(-2, 2), -1.0, 1.0);
  return errors;
}

// Returns the pose in the base of a link with errors. It is computed from the definitions: the
// tool's errors are those of plan::ToolErrorBox, without the shift.
Pose LinkWith(const CollisionScene& scene, int link, const ErrorVector& errors,
              const JointVector& q) {
  const domain::Workcell& workcell = scene.workcell();
  Pose X_WorldTool = ToolAt(workcell, q);
  X_WorldTool.linear() = geometry::RotationZ(errors[kToolTurn]).linear() * X_WorldTool.linear() *
                         geometry::RotationZ(errors[kToolSpin]).linear();
  const Pose X_BaseFlange = workcell.FlangeFor(X_WorldTool);
  const LinkPoses X_BaseLink = scene.arm().LinkPoses(q + errors.head<6>());
  return X_BaseFlange * X_BaseLink.back().inverse() * X_BaseLink[static_cast<std::size_t>(link)];
}

bool IsSeenFromTool(const CollisionScene& scene, const BodyPair& pair) {
  return scene.body(pair.first).link == 0 && scene.body(pair.second).link >= 4;
}

// The poses are those of the definitions.
TEST(PairErrors, MoveLinksOfTheWristWithTheTool) {
  const CollisionScene scene = WithErrors();
  RandomStream random(101, "poses");
  int seen = 0;
  for (const BodyPair& pair : scene.pairs()) {
    if (!IsSeenFromTool(scene, pair)) continue;
    ++seen;
    const PairErrors errors(scene, pair, kSway, kTool);
    const JointVector q = RandomPostureAtTheTable(scene, 0, random);
    const ErrorVector any = AnyErrors(errors.greatest(), random);
    const LinkPoses X = errors.PosesWith(any, q, scene.arm().LinkPoses(q));
    const int link = scene.body(pair.second).link;
    EXPECT_TRUE(X[static_cast<std::size_t>(link)].isApprox(LinkWith(scene, link, any, q), 1e-9));
    const Vector3& origin = scene.body(pair.first).origin;
    EXPECT_TRUE((X[0] * origin).isApprox(origin, 1e-9)) << "a part turns about its origin";
    EXPECT_NEAR(Eigen::AngleAxisd(X[0].linear()).angle(), std::abs(any[kPartTurn]), 1e-9);
  }
  EXPECT_GT(seen, 10);
}

// Law: no error within a box moves the bodies farther, or nearer to each other, than is bounded.
TEST(PairErrors, AreBounded) {
  const CollisionScene scene = WithErrors();
  RandomStream random(102, "bounds");
  int tight = 0;
  int count = 0;
  for (int i = 0; i < 20; ++i) {
    const JointVector q = RandomPostureAtTheTable(scene, 0, random);
    const LinkPoses X_BaseLink = scene.arm().LinkPoses(q);
    for (const BodyPair& pair : scene.pairs()) {
      const PairErrors errors(scene, pair, kSway, kTool);
      const ErrorVector half = errors.greatest() * random.Uniform(0, 0.5);
      const ErrorVector middle = AnyErrors(errors.greatest() - half, random);
      const LinkPoses X_Middle = errors.PosesWith(middle, q, X_BaseLink);
      CollisionScene::Slabs slabs;
      const double apart = scene.Separation(pair, X_Middle, kFar, slabs);
      const double displaced = errors.DisplacementIn(half, X_Middle).sum();
      const double kept = errors.DistanceIn(half, X_Middle, slabs, kFar);
      EXPECT_LE(displaced, errors.GreatestDisplacement() + kRounding);
      double nearest = apart;
      for (int k = 0; k < 20; ++k) {
        const LinkPoses X = errors.PosesWith(middle + AnyErrors(half, random), q, X_BaseLink);
        nearest = std::min(nearest, scene.Separation(pair, X, kFar));
      }
      EXPECT_GE(nearest, apart - displaced - kRounding) << scene.Describe(pair);
      EXPECT_GE(nearest, std::min(kept, apart) - kRounding) << scene.Describe(pair);
      ++count;
      tight += kept > nearest - displaced / 2;
    }
  }
  EXPECT_GT(tight, count / 3);
}

// Without errors the distance along the slabs of the nearest points is the distance.
TEST(PairErrors, OfNothingLeaveTheDistance) {
  const CollisionScene scene(Clutter(), PegInTheHand());
  RandomStream random(103, "no errors");
  for (int i = 0; i < 10; ++i) {
    const LinkPoses X_BaseLink =
        scene.arm().LinkPoses(RandomPostureAtTheTable(scene, 0.001, random));
    for (const BodyPair& pair : scene.pairs()) {
      const PairErrors errors(scene, pair, JointVector::Zero(), {});
      EXPECT_EQ(errors.GreatestDisplacement(), 0);
      CollisionScene::Slabs slabs;
      const double apart = scene.Separation(pair, X_BaseLink, 0.2, slabs);
      if (apart >= 0.2) continue;
      EXPECT_NEAR(errors.DistanceIn(ErrorVector::Zero(), X_BaseLink, slabs, kFar), apart, 1e-6);
    }
  }
}

// Law: on a line on which the tool keeps its orientation, the motion bounds what any errors leave
// of a distance.
TEST(PairErrors, AreCarriedAlongAMotion) {
  const CollisionScene scene = WithErrors();
  RandomStream random(104, "motion");
  int lines = 0;
  while (lines < 10) {
    const JointVector from = RandomPostureAtTheTable(scene, 0, random);
    const Vector3 to = ToolAt(scene.workcell(), from).translation() +
                       Vector3(random.Uniform(-0.03, 0.03), random.Uniform(-0.03, 0.03), 0.03);
    const LineResult line = FollowLine(scene.workcell(), from, to, 0.001);
    if (!line.path) continue;
    ++lines;
    const JointVector& q = line.path->q.back();
    JointVector turn = JointVector::Zero();
    for (const JointVector& at : line.path->q) turn = turn.cwiseMax((at - from).cwiseAbs());
    for (const BodyPair& pair : scene.pairs()) {
      const PairErrors errors(scene, pair, kSway, kTool);
      const ErrorVector any = AnyErrors(errors.greatest(), random);
      const LinkPoses X_From = errors.PosesWith(any, from, scene.arm().LinkPoses(from));
      const LinkPoses X_To = errors.PosesWith(any, q, scene.arm().LinkPoses(q));
      EXPECT_LE(std::abs(scene.Separation(pair, X_From, kFar) - scene.Separation(pair, X_To, kFar)),
                errors.GreatestMotion(turn) + kRounding)
          << scene.Describe(pair);
    }
  }
}

}  // namespace
}  // namespace assay::motion::pair_errors_test
