#include "sim/exec/travel.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/exec/straight_line.h"
#include "tests/sim/exec/figure15.h"

namespace assay::exec {
namespace {

using Moves = std::vector<JointTrajectory>;

class Travel : public testing::Test {
 protected:
  Travel() : problem_(Figure15()), world_(problem_) {}

  TravelRequest To(const Pose& X_WorldTool) const {
    return {.from = problem_.workcell->home(),
            .opening = 0.1,
            .X_WorldTool = X_WorldTool,
            .corners = {}};
  }
  // The tool straight down at some place.
  static Pose Down(double x, double y, double z) {
    return geometry::PoseFromColumns({-1, 0, 0}, {0, 1, 0}, {0, 0, -1}, {x, y, z});
  }

  domain::Problem problem_;
  WorldModel world_;
};

TEST_F(Travel, EndsAtTheDestination) {
  const Pose destination = Down(0.7, 0.3, 0.4);
  const TravelResult result = PlanTravel(problem_, world_, To(destination));
  ASSERT_TRUE(std::holds_alternative<Moves>(result)) << std::get<std::string>(result);
  const JointTrajectory& last = std::get<Moves>(result).back();
  const JointVector q = last.At(last.duration()).q;
  EXPECT_TRUE(ToolAt(*problem_.workcell, q).isApprox(destination, 1e-9));
  EXPECT_TRUE(problem_.workcell->arm().InRange(q));
}

// Of all joint values over the destination, none is nearer in time.
TEST_F(Travel, ChoosesTheNearestConfiguration) {
  const Pose destination = Down(0.7, 0.3, 0.4);
  const auto moves = std::get<Moves>(PlanTravel(problem_, world_, To(destination)));
  const domain::Workcell& workcell = *problem_.workcell;
  ASSERT_EQ(moves.size(), 1u);
  for (const auto& s : workcell.arm().Inverse(workcell.FlangeFor(destination))) {
    for (const JointVector& q : workcell.arm().Representatives(s.q)) {
      const JointTrajectory other =
          motion::SynchronizedMove(workcell.home(), q, motion::RatesOf(workcell));
      EXPECT_LE(moves[0].duration(), other.duration() + 1e-9);
    }
  }
}

// The lines that follow count: of configurations that reach the destination, one that goes on.
TEST_F(Travel, CanGoOnFromTheDestination) {
  TravelRequest request = To(Down(0.7, 0.3, 0.4));
  request.corners = {{0.7, 0.3, 0.1}, {0.75, 0.3, 0.1}};
  const auto moves = std::get<Moves>(PlanTravel(problem_, world_, request));
  JointVector q = moves.back().At(moves.back().duration()).q;
  for (const Vector3& corner : request.corners) {
    const LineResult line = FollowLine(*problem_.workcell, q, corner);
    ASSERT_TRUE(line.path);
    q = line.path->q.back();
  }
}

TEST_F(Travel, SaysWhereTheArmDoesNotReach) {
  const TravelResult result = PlanTravel(problem_, world_, To(Down(2, 0.3, 0.4)));
  ASSERT_TRUE(std::holds_alternative<std::string>(result));
  EXPECT_THAT(std::get<std::string>(result), testing::HasSubstr("(2000.0, 300.0, 400.0) mm"));
}

TEST_F(Travel, DoesNotGoThroughParts) {
  const PartId block = PartNamed(problem_, "block");
  const Vector3 center =
      problem_.part(block).X_WorldPart * problem_.part(block).model->mass().center;
  const TravelResult result =
      PlanTravel(problem_, world_, To(Down(center.x(), center.y(), center.z())));
  ASSERT_TRUE(std::holds_alternative<std::string>(result));
  EXPECT_THAT(std::get<std::string>(result), testing::HasSubstr("within 10 mm"));
}

// A held part counts: what the hand passes over, the part that hangs from it may not.
TEST_F(Travel, TakesTheHeldPartIntoAccount) {
  const PartId peg = PartNamed(problem_, "peg");
  const Pose low = Down(0.7, 0.35, 0.04);
  EXPECT_TRUE(std::holds_alternative<Moves>(PlanTravel(problem_, world_, To(low))));
  world_.Take(peg, {"hanging", geometry::Translation(0, 0, -0.2), 0.0762});
  EXPECT_TRUE(std::holds_alternative<std::string>(PlanTravel(problem_, world_, To(low))));
}

}  // namespace
}  // namespace assay::exec
