#include "planner/finemotion/strategy_checks/exact_replay.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <numbers>
#include <string>

#include "bench/workloads/pegs.h"
#include "planner/finemotion/strategy_search/mating.h"
#include "tests/planner/domain/scenario.h"

namespace assay::finemotion::exact_replay_test {
namespace {

using workloads::BoxShape;

constexpr double kDegree = std::numbers::pi / 180;

// Returns a cube with an edge of 2 cm and its origin in the middle of its bottom. It is over a wide
// floor or beside a wall.
Passage CubeAnd(Polyhedron stationary) {
  Passage passage;
  passage.moving = BoxShape({-0.01, -0.01, 0}, {0.01, 0.01, 0.02});
  passage.stationary = std::move(stationary);
  return passage;
}
Passage CubeOverFloor() { return CubeAnd(BoxShape({-1, -1, -1}, {1, 1, 0})); }

Pose Tilted(const Vector3& at, const Vector3& turn) {
  PoseChange z;
  z << at, turn;
  return Displaced(Pose::Identity(), z);
}

PoseChange Way(const Vector3& d, const Vector3& w = Vector3::Zero()) {
  PoseChange z;
  z << d, w;
  return z;
}

TEST(ExactPart, TheLowestCornerComesFirstWhereItsHeightIsZero) {
  const Passage passage = CubeOverFloor();
  const Pose X = Tilted({0, 0, 0.01}, {0.2, 0.1, 0.05});
  std::size_t lowest = 0;
  for (std::size_t i = 0; i < passage.moving.vertices.size(); ++i) {
    const auto height = [&](std::size_t k) { return (X * passage.moving.vertices[k].p).z(); };
    if (height(i) < height(lowest)) lowest = i;
  }
  ExactPart part(passage, X, 0.02);
  const auto made = part.Move({Way({0, 0, -0.02}), {}, {}}, 1, X.translation());
  ASSERT_TRUE(made);
  EXPECT_EQ(made->kind, ContactKind::kVertexFace);
  EXPECT_EQ(made->moving, static_cast<int>(lowest));
  EXPECT_NEAR((part.X() * passage.moving.vertices[lowest].p).z(), 0, 1e-9);
  EXPECT_NEAR(part.X().translation().head<2>().norm(), 0, 1e-9);
}

TEST(ExactPart, NothingIsMadeOnAWayThatEndsShortOfIt) {
  const Passage passage = CubeOverFloor();
  const Pose X = Tilted({0, 0, 0.01}, {0.2, 0.1, 0.05});
  ExactPart part(passage, X, 0.02);
  EXPECT_EQ(part.Move({Way({0, 0, -0.004}), {}, {}}, 1, X.translation()), std::nullopt);
  EXPECT_NEAR(part.X().translation().z(), 0.006, 1e-12);
}

// A turn about a point that is not the origin of the part displaces the origin on an arc.
TEST(ExactPart, TurnsAboutWhereTheTipIsBelievedToBe) {
  const Passage passage = CubeOverFloor();
  ExactPart part(passage, Tilted({0.1, 0, 0.1}, Vector3::Zero()), 0.02);
  const Vector3 believed(0, 0, 0.1);
  EXPECT_EQ(part.Move({Way(Vector3::Zero(), {0, 0, 0.5}), {}, {}}, 1, believed), std::nullopt);
  EXPECT_NEAR(
      (part.X().translation() - Vector3(0.1 * std::cos(0.5), 0.1 * std::sin(0.5), 0.1)).norm(), 0,
      1e-9);
}

// A corner that is kept on the floor stays there when the part is turned about its origin.
TEST(ExactPart, KeptContactsStayClosed) {
  const Passage passage = CubeOverFloor();
  const Pose X = Tilted({0, 0, 0.01}, {0.2, 0.1, 0});
  ExactPart part(passage, X, 0.02);
  const auto made = part.Move({Way({0, 0, -0.02}), {}, {}}, 1, X.translation());
  ASSERT_TRUE(made);
  const Vector3 tip = part.X().translation();
  EXPECT_EQ(part.Move({Way({0.002, 0, 0}, {0.04, 0.02, 0}), {*made}, {}}, 1, tip), std::nullopt);
  const Vector3& corner = passage.moving.vertices[static_cast<std::size_t>(made->moving)].p;
  EXPECT_NEAR((part.X() * corner).z(), 0, 1e-9);
  EXPECT_TRUE(part.Touches(*made, 0));
}

TEST(ExactPart, TheEdgeOfATableIsMetWhereTheEdgesCross) {
  const Passage passage = CubeAnd(BoxShape({-1, -1, -1}, {0, 1, 0}));
  // A slanting lower edge is over the rim, and its corners are beside the rim.
  const Pose X = Tilted({0.002, 0, 0.01}, {0, -0.4, 0.3});
  ExactPart part(passage, X, 0.02);
  const auto made = part.Move({Way({0, 0, -0.03}), {}, {}}, 1, X.translation());
  ASSERT_TRUE(made);
  EXPECT_TRUE(part.Touches(*made, 1e-6));
}

TEST(TrialErrors, AreInTheBoxWithItsCornersAndTheMiddlesOfItsFaces) {
  PoseChange half;
  half << 1, 2, 3, 4, 5, 6;
  RandomStream random(1, "trial errors");
  const std::vector<PoseChange> errors = TrialErrors(half, 20, random);
  EXPECT_EQ(errors.size(), 1U + 64 + 12 + 40);
  int corners = 0;
  int middles = 0;
  for (const PoseChange& error : errors) {
    EXPECT_LE(error.cwiseAbs().cwiseQuotient(half).maxCoeff(), 1);
    corners += error.cwiseAbs() == half ? 1 : 0;
    middles += (error.array() == 0).count() == 5 ? 1 : 0;
  }
  EXPECT_GE(corners, 64);
  EXPECT_EQ(middles, 12);
}

// A tilted cube that goes down onto a floor until its lowest corner meets it.
struct GoingDown {
  Passage passage = CubeOverFloor();
  Pose start = Tilted({0, 0, 0.01}, {0.02, 0.04, 0});
  Command command{Way({0, 0, -0.015}), {}, {}};
  Pose end;

  GoingDown() {
    ExactPart part(passage, start, 0.02);
    command.until = part.Move(command, 1, start.translation());
    end = part.X();
  }
};

// If the cube is tilted the other way, it meets the floor with another corner.
TEST(ReplayWithErrors, TellsTheFirstErrorThatGoesOtherwise) {
  const auto [passage, start, command, end] = GoingDown();
  ASSERT_TRUE(command.until);
  const std::vector<CertainMotion> motions = {{command, end, {}}};
  const ExactReplay replay{passage, start, motions};
  PoseChange half = PoseChange::Zero();
  half.tail<3>() << 0.01, 0.02, 0.01;
  const ExactReplays less = ReplayWithErrors(replay, half, 5, 1);
  EXPECT_FALSE(less.deviation);
  EXPECT_EQ(less.tried, 1 + 64 + 12 + 10);
  const ExactReplays more = ReplayWithErrors(replay, 4 * half, 5, 1);
  ASSERT_TRUE(more.deviation);
  EXPECT_LT(more.tried, less.tried);
  EXPECT_EQ(more.deviation->motion, 0U);
  EXPECT_FALSE(more.deviation->unwanted.is_loss);
  EXPECT_NE(more.deviation->unwanted.contact, *command.until);
  EXPECT_TRUE(more.deviation->error[3] < -0.02 || more.deviation->error[4] < -0.04)
      << more.deviation->error.transpose();
}

// If the cube goes up, it never meets the floor.
TEST(ReplayWithErrors, TellsOfAContactThatDoesNotCome) {
  auto [passage, start, command, end] = GoingDown();
  ASSERT_TRUE(command.until);
  command.displacement = Way({0, 0, 0.015});
  const std::vector<CertainMotion> motions = {{command, end, {}}};
  const auto missed = ReplayWithErrors({passage, start, motions}, PoseChange::Zero(), 0, 1);
  ASSERT_TRUE(missed.deviation);
  EXPECT_TRUE(missed.deviation->unwanted.is_loss);
  EXPECT_EQ(missed.deviation->unwanted.contact, *command.until);
}

// --- The errors that strategies absorb, in exact geometry. The search has not tried these errors,
// and they are as large as the strategy says they may be.

// Returns the number of replays of each kind. The variable ASSAY_REPLAYS sets another number.
int Drawn() {
  const char* const asked = std::getenv("ASSAY_REPLAYS");
  return asked != nullptr ? std::atoi(asked) : 100;
}

struct Asked {
  const char* scenario;
  double clearance;     // metres on each side
  double displacement;  // metres
  double rotation;      // radians
};

class AbsorbedErrors : public testing::TestWithParam<Asked> {};

TEST_P(AbsorbedErrors, LeadThroughThePlannedContactsInExactGeometry) {
  const Asked& asked = GetParam();
  const domain::Problem problem =
      domain::ReadProblem(Document::Load(domain::ScenarioPath(asked.scenario)),
                          domain::ModelsFolder(), {.clearance = asked.clearance});
  const MatingGeometry geometry = GeometryOf(problem, problem.matings.front());
  FineMotionErrors errors;
  errors.pose << Vector3::Constant(asked.displacement), Vector3::Constant(asked.rotation);
  const StrategyOptions options;
  const FineMotionPlan plan = SearchStrategy(geometry.passage, errors, options);
  ASSERT_TRUE(plan.found());
  EXPECT_GT(plan.exact_replays, 100);
  RandomStream random(73, "replays at the limit");
  const ExactReplay replay{.passage = geometry.passage,
                           .X_StationaryStart = plan.X_StationaryStart,
                           .motions = plan.motions,
                           .radius = options.radius,
                           .velocity_error = errors.velocity};
  int wrong = 0;
  const auto trials = TrialErrors(plan.absorbed * errors.pose, Drawn(), random);
  for (const PoseChange& error : trials) wrong += DeviationOf(replay, error, random) ? 1 : 0;
  RecordProperty("absorbed", std::to_string(plan.absorbed));
  EXPECT_EQ(wrong, 0) << "of " << trials.size() << " with " << plan.absorbed << " times the errors";
}

INSTANTIATE_TEST_SUITE_P(Matings, AbsorbedErrors,
                         testing::Values(Asked{"mate-square", 0.5e-3, 2e-3, kDegree},
                                         Asked{"mate-square", 0.25e-3, 2e-3, kDegree},
                                         Asked{"mate-square", 0.2e-3, 2e-3, kDegree},
                                         Asked{"mate-keyed", 0.5e-3, 2.5e-3, 1.25 * kDegree},
                                         Asked{"mate-octagonal", 0.5e-3, 1.5e-3, 0.75 * kDegree},
                                         Asked{"mate-stepped", 0.5e-3, 0.5e-3, 0.25 * kDegree},
                                         Asked{"mate-t-slot", 0.5e-3, 0.45e-3, 0.2 * kDegree}),
                         [](const auto& test) {
                           std::string name = test.param.scenario;
                           std::ranges::replace(name, '-', '_');
                           return name + "_" +
                                  std::to_string(static_cast<int>(1e6 * test.param.clearance));
                         });

}  // namespace
}  // namespace assay::finemotion::exact_replay_test
