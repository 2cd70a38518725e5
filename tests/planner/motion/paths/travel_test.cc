#include "planner/motion/paths/travel.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "planner/domain/problem/problem_file.h"
#include "planner/geometry/pose.h"
#include "planner/geometry/solids/mass_properties.h"
#include "planner/motion/collision/collision_scene.h"
#include "planner/motion/paths/joint_trajectory.h"
#include "planner/motion/paths/straight_line.h"

namespace assay::motion::travel_test {
namespace {

const PartId kBlock(0);
const PartId kPeg(1);

// Figure 15 of Spar, with the block on its back and the peg on its side.
class Travel : public testing::Test {
 protected:
  Travel()
      : problem_(domain::ReadProblem(Document::Load(ASSAY_SOURCE_DIR "/scenarios/spar-fig15.yaml"),
                                     ASSAY_SOURCE_DIR "/models")) {
    for (const PartId part : {kBlock, kPeg}) {
      at_the_start_.parts.push_back({part, problem_.part(part).X_WorldPart});
    }
  }

  TravelRequest To(const Pose& X_WorldTool) const {
    return {.from = problem_.workcell->home(), .X_WorldTool = X_WorldTool, .corners = {}};
  }
  // Returns a pose of the tool that points straight down.
  static Pose Down(double x, double y, double z) {
    return geometry::PoseFromColumns({-1, 0, 0}, {0, 1, 0}, {0, 0, -1}, {x, y, z});
  }

  domain::Problem problem_;
  Surroundings at_the_start_ = {.opening = 0.1};
};

TEST_F(Travel, EndsAtTheDestination) {
  const Pose destination = Down(0.7, 0.3, 0.4);
  const TravelResult result = PlanTravel(problem_, at_the_start_, To(destination));
  ASSERT_TRUE(std::holds_alternative<JointPath>(result)) << std::get<std::string>(result);
  const JointVector& q = std::get<JointPath>(result).back();
  EXPECT_TRUE(ToolAt(*problem_.workcell, q).isApprox(destination, 1e-9));
  EXPECT_TRUE(problem_.workcell->arm().InRange(q));
}

// No joint values over the destination are reached earlier than the chosen ones.
TEST_F(Travel, ChoosesTheNearestConfiguration) {
  const Pose destination = Down(0.7, 0.3, 0.4);
  const auto path = std::get<JointPath>(PlanTravel(problem_, at_the_start_, To(destination)));
  const domain::Workcell& workcell = *problem_.workcell;
  ASSERT_EQ(path.size(), 2u);
  const JointRates rates = RatesOf(workcell);
  for (const auto& s : workcell.arm().Inverse(workcell.FlangeFor(destination))) {
    for (const JointVector& q : workcell.arm().Representatives(s.q)) {
      EXPECT_LE(MoveDuration(workcell.home(), path[1], rates),
                MoveDuration(workcell.home(), q, rates) + 1e-9);
    }
  }
}

// The travel chooses a configuration from which the arm can follow the lines after the destination.
TEST_F(Travel, CanGoOnFromTheDestination) {
  TravelRequest request = To(Down(0.7, 0.3, 0.4));
  request.corners = {{0.7, 0.3, 0.1}, {0.75, 0.3, 0.1}};
  const auto path = std::get<JointPath>(PlanTravel(problem_, at_the_start_, request));
  JointVector q = path.back();
  for (const Vector3& corner : request.corners) {
    const LineResult line = FollowLine(*problem_.workcell, q, corner);
    ASSERT_TRUE(line.path);
    q = line.path->q.back();
  }
}

TEST_F(Travel, SaysWhereTheArmDoesNotReach) {
  const TravelResult result = PlanTravel(problem_, at_the_start_, To(Down(2, 0.3, 0.4)));
  ASSERT_TRUE(std::holds_alternative<std::string>(result));
  EXPECT_THAT(std::get<std::string>(result), testing::HasSubstr("(2000.0, 300.0, 400.0) mm"));
}

TEST_F(Travel, DoesNotGoThroughParts) {
  const Vector3 center =
      problem_.part(kBlock).X_WorldPart * problem_.part(kBlock).model->mass().center;
  const TravelResult result =
      PlanTravel(problem_, at_the_start_, To(Down(center.x(), center.y(), center.z())));
  ASSERT_TRUE(std::holds_alternative<std::string>(result));
  EXPECT_THAT(std::get<std::string>(result), testing::HasSubstr("within 10 mm"));
}

// A held part is checked, too: it hangs so low that it hits what the hand would pass over.
TEST_F(Travel, TakesTheHeldPartIntoAccount) {
  const Pose low = Down(0.7, 0.35, 0.04);
  EXPECT_TRUE(std::holds_alternative<JointPath>(PlanTravel(problem_, at_the_start_, To(low))));
  Surroundings holding = at_the_start_;
  holding.parts.pop_back();
  holding.held = HeldPart{kPeg, geometry::Translation(0, 0, -0.2)};
  EXPECT_TRUE(std::holds_alternative<std::string>(PlanTravel(problem_, holding, To(low))));
}

// Two arms face each other. The right arm stands with its hand low over the middle of the table.
class TravelBesideAnArm : public testing::Test {
 protected:
  static constexpr domain::RobotId kRight = domain::RobotId(1);

  JointPath PlanFrom(const Pose& from, const Pose& to) const {
    const TravelResult result = PlanTravel(problem_, around_, Request(from, to));
    if (const auto* why = std::get_if<std::string>(&result)) ADD_FAILURE() << *why;
    return std::get<JointPath>(result);
  }
  TravelRequest Request(const Pose& from, const Pose& to) const {
    return {.from = Posture(problem_, from), .X_WorldTool = to, .corners = {}};
  }
  static JointVector Posture(const domain::Problem& problem, const Pose& X_WorldTool) {
    return PosturesAt(*problem.workcell, X_WorldTool, problem.workcell->home()).front();
  }
  static Pose Down(double x, double y, double z) {
    return geometry::PoseFromColumns({-1, 0, 0}, {0, 1, 0}, {0, 0, -1}, {x, y, z});
  }
  // Computes the distance naively, at postures along the path that are a hundredth of a radian
  // apart.
  double NearestToTheOther(const JointPath& path) const {
    const CollisionScene scene(problem_, around_);
    double nearest = 1;
    for (std::size_t i = 0; i + 1 < path.size(); ++i) {
      const JointVector way = path[i + 1] - path[i];
      const int steps = static_cast<int>(std::ceil(way.cwiseAbs().maxCoeff() / 0.01));
      for (int k = 0; k <= steps; ++k) {
        const LinkPoses X_BaseLink = scene.arm().LinkPoses(path[i] + k * way / steps);
        for (const BodyPair& pair : scene.pairs()) {
          if (!scene.IsOfAnotherRobot(pair.first)) continue;
          nearest = std::min(nearest, scene.Separation(pair, X_BaseLink, nearest));
        }
      }
    }
    return nearest;
  }

  const domain::Problem problem_ = domain::ReadProblem(
      Document::Parse("format: assay-scenario/1\nworkcell: two-pumas\nparts:\n"
                      "  bottle: {model: bottle, pose: {stable: upright, at: [-0.4, 0.1]}}\n"
                      "goal: [{located: {part: bottle, stable: [upright]}}]\n",
                      "bottle.yaml"),
      ASSAY_SOURCE_DIR "/models");
  const JointVector right_ = Posture(WorkedBy(problem_, kRight), Down(-0.05, 0, 0.3));
  const Surroundings around_ = {.opening = 0.1, .robots = {{kRight, right_, 0.1}}};
};

// If the other arm is at its home the hand goes straight over. Otherwise it goes around that arm.
TEST_F(TravelBesideAnArm, GoesAroundIt) {
  const Pose from = Down(-0.15, -0.35, 0.4);
  const Pose to = Down(-0.15, 0.35, 0.4);
  const TravelResult alone = PlanTravel(problem_, {.opening = 0.1}, Request(from, to));
  ASSERT_TRUE(std::holds_alternative<JointPath>(alone));
  EXPECT_LT(NearestToTheOther(std::get<JointPath>(alone)), kTravelGap);
  EXPECT_GE(NearestToTheOther(PlanFrom(from, to)), kTravelGap);
}

TEST_F(TravelBesideAnArm, NamesThePairThatIsInTheWay) {
  const TravelResult result =
      PlanTravel(problem_, around_, Request(Down(-0.4, -0.35, 0.4), Down(-0.05, 0, 0.35)));
  ASSERT_TRUE(std::holds_alternative<std::string>(result));
  EXPECT_THAT(std::get<std::string>(result),
              testing::ContainsRegex("the .* and the .* of right are nearer than 10.0 mm"));
}

// Only the lines after the travel lead near the other arm.
TEST_F(TravelBesideAnArm, LooksAtTheLinesThatFollow) {
  TravelRequest request = Request(Down(-0.4, -0.35, 0.4), Down(-0.35, 0, 0.3));
  EXPECT_TRUE(std::holds_alternative<JointPath>(PlanTravel(problem_, around_, request)));
  request.corners = {{-0.1, 0, 0.3}};
  ASSERT_TRUE(std::holds_alternative<std::string>(PlanTravel(problem_, around_, request)));
}

TEST_F(TravelBesideAnArm, GoesHomeAroundIt) {
  const TravelResult result =
      PlanWayHome(problem_, around_, Posture(problem_, Down(-0.15, 0.35, 0.4)));
  ASSERT_TRUE(std::holds_alternative<JointPath>(result)) << std::get<std::string>(result);
  const auto& path = std::get<JointPath>(result);
  EXPECT_TRUE(path.back() == problem_.workcell->home());
  EXPECT_GE(NearestToTheOther(path), kTravelGap);
}

TEST_F(TravelBesideAnArm, SaysWhyThereIsNoWayHome) {
  const TravelResult result =
      PlanWayHome(problem_, around_, Posture(problem_, Down(-0.05, 0, 0.35)));
  ASSERT_TRUE(std::holds_alternative<std::string>(result));
  EXPECT_THAT(std::get<std::string>(result),
              testing::ContainsRegex("no way home: .* of right are nearer than 10.0 mm"));
}

}  // namespace
}  // namespace assay::motion::travel_test
