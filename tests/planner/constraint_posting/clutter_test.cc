#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>
#include <span>
#include <sstream>
#include <utility>

#include "planner/base/random.h"
#include "planner/constraint_posting/resolvers/sensing_resolver.h"
#include "planner/constraint_posting/uncertainty_phase/uncertainty_phase.h"
#include "planner/domain/resting/resting.h"
#include "planner/geometry/pose.h"
#include "planner/plan/checker/checker.h"
#include "tests/planner/constraint_posting/scenarios.h"
#include "tests/planner/plan/actions.h"
#include "tests/scratch_file.h"

namespace assay::constraint_posting::clutter_test {
namespace {

using domain::GraspId;
using domain::MatingId;
using domain::PartId;
using domain::PlacedPart;
using domain::Problem;
using geometry::Pose;
using plan::Action;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using uncertainty::Propagation;
using uncertainty::UncertainWorld;

// Returns a copy of the project's models with a workcell `three-places`, which allows an exhaustive
// search. Parts can be put down at three places without a turn, and the tool comes straight down.
std::string ModelsWithThreePlaces() {
  const std::filesystem::path models = std::string(ASSAY_SOURCE_DIR) + "/models";
  const std::filesystem::path scratch = ScratchFile("clutter-models");
  const std::filesystem::path workcell = scratch / "workcells" / "three-places";
  if (std::filesystem::exists(workcell)) return scratch;
  std::filesystem::create_directories(workcell);
  for (const char* folder : {"parts", "robots", "grippers"}) {
    std::filesystem::create_directory_symlink(models / folder, scratch / folder);
  }
  std::ifstream stock(models / "workcells" / "puma762-table" / "workcell.yaml");
  std::ofstream few(workcell / "workcell.yaml");
  for (std::string line; std::getline(stock, line);) {
    const bool places = line.starts_with("placements:");
    few << (places ? "placements: {x: [0.45, 0.45], y: [-0.30, 0.30], step: 0.30, yaws: 1,"
                     " nearest_to: [0.45, 0.00]}"
                   : line)
        << "\n";
  }
  return scratch;
}

// A scene with a peg on its shaft that must be put into a block, and with bricks beside the peg.
struct Scene {
  double peg_error = 0;  // mm, error in x and y
  struct Brick {
    double x = 0;  // mm
    double y = 0;
    double error = 0;  // mm, error in x and y
  };
  std::vector<Brick> bricks = {};

  std::string Text() const {
    std::string text = fmt::format(
        "format: assay-scenario/1\nunits: {{length: mm, angle: degree}}\nworkcell: three-places\n"
        "rules: {{tool_lean: 10, approach_step: 90}}\nclearance: 2\n"
        "gripper: {{error: {{x: 0.02, y: 0.02, z: 0.02, theta: 0.01}}}}\n"
        "sensing: []\nresolvers: [sensing]\nparts:\n"
        "  block: {{model: block, pose: {{stable: on-back, at: [720, 250]}},\n"
        "    error: {{x: 0.05, y: 0.05, z: 0.02, theta: 0.02}}}}\n"
        "  peg: {{model: peg, pose: {{stable: shaft-down, at: [620, -40]}},\n"
        "    error: {{x: {0:.3f}, y: {0:.3f}, z: 0.02, theta: 0.02}}}}\n",
        peg_error);
    for (std::size_t i = 0; i < bricks.size(); ++i) {
      text += fmt::format(
          "  brick{}: {{model: brick, pose: {{stable: upright, at: [{:.2f}, {:.2f}]}},\n"
          "    error: {{x: {:.3f}, y: {:.3f}, z: 0.02, theta: 0.05}}}}\n",
          i + 1, bricks[i].x, bricks[i].y, bricks[i].error, bricks[i].error);
    }
    return text +
           "goal:\n"
           "  - assembled: {held: peg, fixed: block, features: [[7, 8], [7, 8]],\n"
           "      pose: {columns: [[-1, 0, 0], [0, 1, 0], [0, 0, -1], [76.2, 0, 82.55]]},\n"
           "      mating_vector: [-101.6, 0, 0]}\n";
  }

  Problem Read() const {
    return domain::ReadProblem(Document::Parse(Text(), "clutter.yaml"), ModelsWithThreePlaces());
  }
};

// Draws a scene with bricks so near the peg that the fingers have a few millimetres between brick
// and peg. One brick can stand at the corner between two others, where it is in the way when they
// are moved.
Scene RandomScene(RandomStream& random, int most) {
  std::vector<std::pair<int, int>> sides = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}};
  Scene scene = {.peg_error = random.Uniform(0.05, 1.5)};
  const int count = 1 + random.Index(most);
  for (int i = 0; i < count; ++i) {
    const auto side = sides.begin() + random.Index(static_cast<int>(sides.size()));
    scene.bricks.push_back(
        {.x = 620 + side->first * random.Uniform(89.5, 98) + random.Uniform(-2, 2),
         .y = -40 + side->second * random.Uniform(89.5, 98),
         .error = random.Uniform(0.5, 7)});
    sides.erase(side);
  }
  return scene;
}

// The knowledge of a cluttered scene after some bricks were moved.
struct Snapshot {
  UncertainWorld world;
  std::vector<Pose> poses;  // by part
  std::vector<bool> moved;  // by part
};

// Finds the least number of moved bricks that suffices for a proof. It tries all sequences that
// move each brick at most once, with every grasp and to every place.
class Exhaustive {
 public:
  explicit Exhaustive(const Problem& problem) : problem_(problem) {}

  // Returns none if not even moving all bricks suffices.
  std::optional<int> LeastMoved() {
    std::vector<Snapshot> snapshots = {Beginning()};
    for (int moved = 0; !snapshots.empty(); ++moved) {
      if (std::ranges::any_of(snapshots,
                              [&](const Snapshot& snapshot) { return IsEnough(snapshot); })) {
        return moved;
      }
      snapshots = AfterOneMore(snapshots);
    }
    return std::nullopt;
  }

 private:
  Snapshot Beginning() const {
    Snapshot snapshot = {.world = UncertainWorld(problem_, Propagation::kSound),
                         .poses = {},
                         .moved = std::vector<bool>(problem_.parts.size(), false)};
    for (const domain::Part& part : problem_.parts) snapshot.poses.push_back(part.X_WorldPart);
    return snapshot;
  }

  // Snapshots with the same bricks at the same places and the same errors count as one.
  std::vector<Snapshot> AfterOneMore(const std::vector<Snapshot>& snapshots) const {
    std::map<std::string, Snapshot> after;
    for (const Snapshot& snapshot : snapshots) {
      for (std::size_t p = 0; p < problem_.parts.size(); ++p) {
        if (problem_.parts[p].name.starts_with("brick") && !snapshot.moved[p]) {
          Move(snapshot, PartId(p), after);
        }
      }
    }
    std::vector<Snapshot> distinct;
    for (auto& [key, snapshot] : after) distinct.push_back(std::move(snapshot));
    return distinct;
  }

  void Move(const Snapshot& snapshot, PartId part, std::map<std::string, Snapshot>& after) const {
    ForEachGrasp(part, [&](const plan::Hold& hold, GraspId grasp) {
      Snapshot taken = snapshot;
      if (!Takes(taken, part, hold, grasp)) return;
      const auto& stable = problem_.part(part).model->stable_poses();
      for (const domain::StablePose& pose : stable) {
        for (const domain::Placement& place : problem_.workcell->placements()) {
          const Pose X_WorldPart = place.X_WorldTable() * pose.X_TablePart;
          Snapshot next = taken;
          if (!PutsDown(next, part, hold, grasp, {pose.label, X_WorldPart})) continue;
          next.poses[p(part)] = X_WorldPart;
          next.moved[p(part)] = true;
          after.try_emplace(KeyOf(next), next);
        }
      }
    });
  }

  bool IsEnough(const Snapshot& snapshot) const {
    const domain::Mating& mating = problem_.matings.front();
    bool enough = false;
    ForEachGrasp(mating.held, [&](const plan::Hold& hold, GraspId grasp) {
      Snapshot taken = snapshot;
      enough = enough || (Takes(taken, mating.held, hold, grasp) && Mates(taken, hold, grasp));
    });
    return enough;
  }

  template <class Visit>
  void ForEachGrasp(PartId part, const Visit& visit) const {
    const auto& grasps = *problem_.part(part).grasps;
    for (std::size_t g = 0; g < grasps.size(); ++g) {
      visit(plan::Hold{grasps[g].label, grasps[g].X_PartTool, grasps[g].width}, GraspId(g));
    }
  }

  bool Takes(Snapshot& snapshot, PartId part, const plan::Hold& hold, GraspId grasp) const {
    const Pose& X_WorldPart = snapshot.poses[p(part)];
    return IsReachableAt(problem_, part, grasp, X_WorldPart) &&
           HandIsFree(snapshot, hold, X_WorldPart, {part}) &&
           IsProved(snapshot, plan::Pickup(part, hold, {"initial", X_WorldPart}));
  }

  bool PutsDown(Snapshot& snapshot, PartId part, const plan::Hold& hold, GraspId grasp,
                const plan::Place& to) const {
    return OnTable(problem_, part, to.X_WorldPart) &&
           IsReachableAt(problem_, part, grasp, to.X_WorldPart) &&
           Crowding(problem_, part, to.X_WorldPart, Others(snapshot, {part})).IsNone() &&
           HandIsFree(snapshot, hold, to.X_WorldPart, {part}) &&
           IsProved(snapshot, plan::Putdown(part, hold, to));
  }

  bool Mates(Snapshot& snapshot, const plan::Hold& hold, GraspId grasp) const {
    const domain::Mating& mating = problem_.matings.front();
    const Pose& X_WorldFixed = snapshot.poses[p(mating.fixed)];
    if (!IsMateReachableAt(problem_, MatingId(0), grasp, X_WorldFixed)) return false;
    const std::vector<PlacedPart> others = Others(snapshot, {mating.held, mating.fixed});
    for (const double back : {0.0, 1.0}) {
      const Pose X_WorldHeld =
          X_WorldFixed * geometry::Translation(-back * mating.mating_vector) * mating.X_FixedHeld;
      if (!Obstacle(problem_, {mating.held, X_WorldHeld}, others).IsNone() ||
          !HandIsFree(snapshot, hold, X_WorldHeld, {mating.held, mating.fixed})) {
        return false;
      }
    }
    return IsProved(snapshot, plan::Assemble(MatingId(0), hold, {"initial", X_WorldFixed}));
  }

  bool HandIsFree(const Snapshot& snapshot, const plan::Hold& hold, const Pose& X_WorldPart,
                  const std::vector<PartId>& handled) const {
    const std::vector<PlacedPart> others = Others(snapshot, handled);
    const Pose X_WorldTool = X_WorldPart * hold.X_PartTool;
    const double open = problem_.workcell->gripper().max_opening();
    const Pose back =
        X_WorldTool * geometry::Translation(0, 0, -problem_.workcell->rules().approach_distance);
    return Obstacle(problem_, X_WorldTool, hold.width, others).IsNone() &&
           Obstacle(problem_, X_WorldTool, open, others).IsNone() &&
           Obstacle(problem_, back, open, others).IsNone();
  }

  std::vector<PlacedPart> Others(const Snapshot& snapshot,
                                 const std::vector<PartId>& handled) const {
    std::vector<PlacedPart> others;
    for (std::size_t i = 0; i < snapshot.poses.size(); ++i) {
      if (std::ranges::count(handled, PartId(i)) == 0)
        others.push_back({PartId(i), snapshot.poses[i]});
    }
    return others;
  }

  static bool IsProved(Snapshot& snapshot, const Action& action) {
    return DecideStep(snapshot.world, action, {}, uncertainty::Wanted::kFirstUnproved).empty();
  }

  static std::string KeyOf(const Snapshot& snapshot) {
    std::string key;
    for (std::size_t i = 0; i < snapshot.poses.size(); ++i) {
      const uncertainty::RestingError& error = snapshot.world.resting(PartId(i));
      key += fmt::format("{:.9f} {:.9f} ", snapshot.poses[i].translation().x(),
                         snapshot.poses[i].translation().y());
      for (const auto& e : {error.displacement[0], error.displacement[1], error.theta}) {
        const Interval range = snapshot.world.RangeOf(e);
        key += fmt::format("{:.9f} {:.9f} ", range.low, range.high);
      }
      key += fmt::format("{:.6f};", snapshot.poses[i].linear()(2, 2));
    }
    return key;
  }

  static std::size_t p(PartId part) { return static_cast<std::size_t>(part.index()); }

  const Problem& problem_;
};

int FromEnvironment(const char* name, int otherwise) {
  const char* said = std::getenv(name);
  return said == nullptr ? otherwise : std::atoi(said);
}

// If moving some of the bricks gives a proof, the planner finds one, and it moves as few bricks as
// possible. The variable ASSAY_CLUTTER_SCENES sets the number of scenes. ASSAY_CLUTTER_BRICKS sets
// the greatest number of bricks in each, up to five.
TEST(Clutter, IsMovedWheneverThatGivesAProofAndAsLittleAsCanBe) {
  const int scenes = FromEnvironment("ASSAY_CLUTTER_SCENES", 12);
  const int bricks = FromEnvironment("ASSAY_CLUTTER_BRICKS", 4);
  UncertaintyOptions looks;  // the oracle has no sensor and no squeezes
  looks.resolvers = {std::make_shared<SensingResolver>()};
  std::map<int, int> count;  // number of scenes by the number of bricks to move; -1: no proof
  for (int seed = 1; seed <= scenes; ++seed) {
    RandomStream random(static_cast<std::uint64_t>(seed), "clutter");
    const Scene scene = RandomScene(random, bricks);
    SCOPED_TRACE(fmt::format("seed {}\n{}", seed, scene.Text()));
    const Problem problem = scene.Read();
    const std::optional<int> least = Exhaustive(problem).LeastMoved();
    ++count[least.value_or(-1)];
    const plan::PlanResult result = MakeCertifiedPlan(problem, {}, looks);
    EXPECT_EQ(result.outcome == Outcome::kFound && result.plan.errors == 0, least.has_value());
    if (!least) continue;
    EXPECT_EQ(result.plan.steps.size(), 2u + 2u * static_cast<std::size_t>(*least));
    EXPECT_THAT(plan::Check(problem, result.plan, 100).flaws, IsEmpty());
  }
  for (const auto& [moved, number] : count) {
    std::string name = moved < 0 ? "without_a_proof" : fmt::format("moved_{}", moved);
    RecordProperty(name, number);
  }
  EXPECT_GE(count.size(), 3u) << "the scenes are too much alike";
}

bool IsProved(const plan::PlannedStep& step) {
  return std::ranges::all_of(step.certificate.preconditions,
                             [](const auto& claim) { return claim.holds(); });
}

TEST(Clutter, IsMovedForTheReasonThatTheStepTells) {
  const Problem problem = LoadScenario("uncertain-clutter");
  EXPECT_GT(Augment(problem, FirstInstance(problem), {}).plan.errors, 0);
  const plan::PlanResult result = MakeCertifiedPlan(problem, {}, {});
  EXPECT_EQ(result.plan.errors, 0);
  ASSERT_EQ(result.plan.steps.size(), 6u);
  EXPECT_THAT(plan::Check(problem, result.plan, 100).flaws, IsEmpty());
  int told = 0;
  for (const plan::PlannedStep& step : result.plan.steps) {
    for (const plan::Resolution& resolution : step.certificate.resolutions) {
      ++told;
      EXPECT_EQ(step.action.part, PartNamed(problem, "peg"));
      EXPECT_EQ(resolution.resolver, "moving");
      EXPECT_THAT(resolution.why, HasSubstr("not proved that the hand stays clear of"));
      EXPECT_EQ(resolution.steps.size(), 4u);
      for (const plan::StepId moved : resolution.steps) {
        EXPECT_LT(result.plan.step(moved).executed, step.executed);
      }
    }
  }
  EXPECT_EQ(told, 1);
}

// The first place for the regrasp would be beside the block, where the hand may meet it.
TEST(Clutter, TheRegraspOfFigure16IsNotBesideTheBlock) {
  const plan::PlanResult result = MakeCertifiedPlan(LoadScenario("spar-fig16"), {}, {});
  EXPECT_LE(result.plan.errors, 1);
  EXPECT_EQ(std::ranges::count_if(
                result.plan.steps,
                [](const plan::PlannedStep& step) { return step.action.Is(domain::kPickup); }),
            2);
  for (const plan::PlannedStep& step : result.plan.steps) {
    if (!step.action.Is(domain::kPickup)) continue;
    EXPECT_TRUE(IsProved(step));
  }
}

// Whatever a judge objects to, the resulting plan is one that the judge accepts.

Problem BlockToBeTurned() {
  return ScenarioFrom(R"(format: assay-scenario/1
units: {length: inch, angle: degree}
workcell: puma762-table
parts:
  block: {model: block, pose: {stable: on-end, at: [22, 6]}}
  brick: {model: brick, pose: {stable: upright, at: [22, -8]}}
goal:
  - located: {part: block, stable: [on-back]}
)");
}

TEST(Judge, WhoObjectsToAPlaceGetsAnother) {
  const Problem problem = BlockToBeTurned();
  const auto is_far = [](const Action& action) {
    const auto* putdown = As(domain::kPutdown, action);
    return putdown == nullptr || putdown->place.X_WorldPart.translation().y() < -0.15;
  };
  PlannerOptions options;
  options.judge = [&](std::span<const Action> actions) -> Judgement {
    if (is_far(actions.back())) return {.snapshots = 1};
    return {.objections = {{.action = static_cast<int>(actions.size()) - 1,
                            .parts = {PartId(0)},
                            .place = true}},
            .snapshots = 1};
  };
  const plan::PlanResult result = MakePlan(problem, options);
  ASSERT_EQ(result.outcome, Outcome::kFound);
  EXPECT_EQ(result.plan.steps.size(), 2u);
  for (const Action& action : ActionsOf(result.plan)) EXPECT_TRUE(is_far(action));
}

TEST(Judge, APartThatIsInTheWayIsMovedAndThePlanSaysWhy) {
  const Problem problem = BlockToBeTurned();
  const PartId brick = PartNamed(problem, "brick");
  const auto puts_down_brick = [&](const Action& action) {
    const auto* putdown = As(domain::kPutdown, action);
    return putdown != nullptr && putdown->part == brick;
  };
  PlannerOptions options;
  options.judge = [&](std::span<const Action> actions) -> Judgement {
    const auto* pickup = As(domain::kPickup, actions.back());
    const bool is_free = std::ranges::any_of(actions, puts_down_brick);
    if (pickup == nullptr || pickup->part == brick || is_free) return {.snapshots = 1};
    return {.objections = {{.action = static_cast<int>(actions.size()) - 1,
                            .parts = {pickup->part},
                            .place = true,
                            .in_the_way = {{brick, "the brick is unlucky"}}}},
            .snapshots = 1};
  };
  const plan::PlanResult result = MakePlan(problem, options);
  ASSERT_EQ(result.outcome, Outcome::kFound);
  ASSERT_EQ(result.plan.steps.size(), 4u);
  const std::vector<plan::StepId> order = result.plan.ExecutionOrder();
  EXPECT_TRUE(puts_down_brick(result.plan.step(order[1]).action));
  const auto& resolutions = result.plan.step(order[2]).certificate.resolutions;
  ASSERT_EQ(resolutions.size(), 1u);
  EXPECT_EQ(resolutions.front().why, "the brick is unlucky");
  EXPECT_EQ(resolutions.front().steps, (std::vector{order[0], order[1]}));
}

// An objection that no place and no history can meet does not lead to longer plans. An objection
// that a place or a history can meet leads to longer plans, until the budget is spent.
TEST(Judge, WhoAlwaysObjectsGetsNoPlan) {
  const Problem problem = BlockToBeTurned();
  std::map<bool, std::int64_t> judged;
  for (const bool blames_brick : {false, true}) {
    PlannerOptions options;
    options.snapshots = 600;
    options.judge = [&](std::span<const Action> actions) -> Judgement {
      ++judged[blames_brick];
      Objection objection = {.action = static_cast<int>(actions.size()) - 1};
      if (blames_brick) objection.in_the_way = {{PartId(1), "never"}};
      return {.objections = {objection}, .snapshots = 1};
    };
    const plan::PlanResult result = MakePlan(problem, options);
    EXPECT_EQ(result.outcome, Outcome::kBudget);
    EXPECT_TRUE(result.plan.steps.empty());
    EXPECT_LE(judged[blames_brick], options.snapshots + 1);
  }
  EXPECT_LT(judged[false], judged[true]);
}

}  // namespace
}  // namespace assay::constraint_posting::clutter_test
