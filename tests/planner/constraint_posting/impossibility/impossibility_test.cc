#include "planner/constraint_posting/impossibility/impossibility.h"
#include "planner/constraint_posting/impossibility/constraint_text.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>

#include "planner/base/random.h"
#include "planner/constraint_posting/impossibility/impossibility_check.h"
#include "planner/constraint_posting/least_actions.h"
#include "planner/geometry/pose.h"
#include "tests/oracle/exhaustive_assembly.h"
#include "tests/planner/constraint_posting/scenarios.h"
#include "tests/scratch_file.h"

namespace assay::constraint_posting::impossibility_test {
namespace {

namespace fs = std::filesystem;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;

// A folder with the models of the project and a few more parts and workcells, which have few
// placements.
class Models {
 public:
  Models() : folder_(ScratchFile("models")) {
    const fs::path models = fs::path(ASSAY_SOURCE_DIR) / "models";
    fs::create_directories(folder_ / "parts");
    for (const char* name : {"robots", "grippers"}) {
      fs::create_directory_symlink(models / name, folder_ / name);
    }
    for (const auto& part : fs::directory_iterator(models / "parts")) {
      if (part.is_directory()) {
        fs::create_directory_symlink(part, folder_ / "parts" / part.path().filename());
      }
    }
    AddWorkcell("puma762-table", "one-arm",
                "{x: [0.50, 0.70], y: [-0.1, 0.1], step: 0.20, yaws: 2, nearest_to: [0.60, 0]}");
    AddWorkcell("two-pumas", "two-arms",
                "{x: [-0.2, 0.2], y: [0, 0], step: 0.20, yaws: 1, nearest_to: [0, 0]}");
  }
  ~Models() { fs::remove_all(folder_); }
  Models(const Models&) = delete;
  Models& operator=(const Models&) = delete;

  const fs::path& folder() const { return folder_; }

  void Write(const fs::path& file, const std::string& text) const {
    fs::create_directories((folder_ / file).parent_path());
    std::ofstream(folder_ / file) << text;
  }

 private:
  void AddWorkcell(const std::string& from, const std::string& name,
                   const std::string& placements) const {
    std::ifstream file(fs::path(ASSAY_SOURCE_DIR) / "models/workcells" / from / "workcell.yaml");
    std::string text;
    for (std::string line; std::getline(file, line);) {
      if (line.starts_with("placements:")) line = "placements: " + placements;
      if (line.starts_with("  approach_step:")) line = "  approach_step: 45";
      text += line + "\n";
    }
    Write("workcells/" + name + "/workcell.yaml", text);
  }

  fs::path folder_;
};

const Models& TheModels() {
  static const Models models;
  return models;
}

enum class Stud { kYes, kNo };

// Returns a box with a socket for a stud in its lower end and, if asked for, a stud on its upper
// end, in millimetres. Pads can hold a box by its stud.
std::string StackingBox(int x, int y, int z, Stud stud = Stud::kYes) {
  const bool has_stud = stud == Stud::kYes;
  return fmt::format(
      R"(format: assay-part/1
name: box
initial: X
units: {{length: mm, angle: degree}}
density: 700
friction: 0.25
solids:
  body: {{box: [[{}, {}, 0], [{}, {}, {}]]}}
{}pockets:
  socket: {{cut_from: body, box: [[-8, -8, 0], [8, 8, 12]], widen: [x, y]}}
features:
{}  2: {{hole: socket, axis: [0, 0, -1], what: socket}}
  3: {{face: body, normal: [1, 0, 0], what: front}}
stable_poses:
  upright: [0, 0, -1]
)",
      -x / 2, -y / 2, x / 2, y / 2, z,
      has_stud ? fmt::format("  stud: {{box: [[-8, -8, {}], [8, 8, {}]]}}\n", z, z + 10) : "",
      has_stud ? "  1: {shaft: stud, axis: [0, 0, 1], what: stud}\n" : "");
}

std::string Stacked(const std::string& held, const std::string& fixed, int height) {
  return fmt::format(
      "  - assembled: {{held: {}, fixed: {}, features: [[2], [1]], pose: {{columns: [[1, 0, 0], "
      "[0, 1, 0], [0, 0, 1], [0, 0, {}]]}}, mating_vector: [0, 0, -40]}}\n",
      held, fixed, height);
}

domain::Problem Read(const std::string& text) {
  return domain::ReadProblem(Document::Parse(text, "scene.yaml"), TheModels().folder());
}

// Draws a scene with two or three stacking boxes on the table of one or two arms. Some boxes cannot
// be taken, and boxes can be far apart or crowded. There are one to three goals: stacks of up to
// three boxes, and other stable poses.
class RandomScene {
 public:
  explicit RandomScene(std::uint64_t seed) : random_(seed, "scene"), seed_(seed) {}

  domain::Problem Draw() {
    for (int tries = 1;; ++tries) {
      try {
        text_ = Text();
        return Read(text_);
      } catch (const InputError&) {  // parts overlap or are beside the table
        if (tries == kMostTries) throw;
      }
    }
  }
  const std::string& text() const { return text_; }

 private:
  static constexpr int kMostTries = 200;

  std::string Text() {
    const int parts = 2 + random_.Index(2);
    const bool two_arms = random_.Index(3) == 0;
    const std::array leans = {5, 20, 60, 90};
    std::string text = fmt::format(
        "format: assay-scenario/1\nunits: {{length: mm, angle: degree}}\nworkcell: {}\n"
        "rules: {{tool_lean: {}}}\nparts:\n",
        two_arms ? "two-arms" : "one-arm", leans[random_.Index(4)]);
    const bool starts_mated = random_.Index(8) == 0;
    is_crowded_ = random_.Index(3) == 0;
    heights_.clear();
    for (int p = 0; p < parts; ++p) text += Part(p, two_arms, starts_mated && p == 1);
    if (starts_mated) text += "initially:\n" + Stacked("p1", "p0", heights_[0]);
    return text + "goal:\n" + Goals(parts);
  }

  std::string Part(int p, bool two_arms, bool is_mated) {
    const std::array sides = {22, 40, 60, 90, 120};
    const std::array heights = {20, 40, 60};
    const int x = sides[random_.Index(5)];
    const int y = sides[random_.Index(5)];
    heights_.push_back(heights[random_.Index(3)]);
    const std::string model = fmt::format("box-{}-{}", seed_, p);
    TheModels().Write("parts/" + model + "/part.yaml", StackingBox(x, y, heights_.back()));
    if (is_mated) return fmt::format("  p{}: {{model: {}}}\n", p, model);
    const double across = is_crowded_ ? random_.Uniform(-90, 90) + (two_arms ? 0 : 600)
                          : two_arms  ? random_.Uniform(-550, 550)
                                      : random_.Uniform(380, 970);
    const double along = is_crowded_ ? random_.Uniform(-90, 90) : random_.Uniform(-350, 350);
    const std::string pose =
        random_.Index(2) == 0 ? "upright" : fmt::format("XP{}", 1 + random_.Index(4));
    return fmt::format(
        "  p{}: {{model: {}, pose: {{stable: {}, at: [{:.0f}, {:.0f}], yaw: {}}}}}\n", p, model,
        pose, across, along, 45 * random_.Index(8));
  }

  std::string Goals(int parts) {
    std::string goals;
    if (random_.Index(5) > 0) goals += Stacked("p1", "p0", heights_[0]);
    if (parts == 3 && random_.Index(2) == 0) goals += Stacked("p2", "p1", heights_[1]);
    if (goals.empty() || random_.Index(3) == 0) {
      goals += fmt::format("  - located: {{part: p{}, stable: [XP{}]}}\n", random_.Index(parts),
                           1 + random_.Index(4));
    }
    return goals;
  }

  RandomStream random_;
  std::uint64_t seed_;
  std::vector<int> heights_;
  bool is_crowded_ = false;
  std::string text_;
};

int SceneCount() {
  const char* count = std::getenv("ASSAY_IMPOSSIBLE_SCENES");
  return count == nullptr ? 25 : std::atoi(count);
}

using Answer = oracle::ExhaustiveAssembly::Answer;

std::string Name(Answer answer) {
  switch (answer) {
    case Answer::kPlan:
      return "plan";
    case Answer::kNone:
      return "none";
    case Answer::kNoneWithoutCarrying:
      return "none without carrying";
  }
  return "";
}

std::string Name(const plan::PlanResult& result) {
  if (result.outcome == Outcome::kFound) return "planned";
  if (result.outcome == Outcome::kNone) return "proved";
  return result.limits.empty() ? "budget" : "limit";
}

// The planner says "no plan exists" only if trying everything finds no plan, with any arm and in
// any order. If there is no plan, the planner always says so, unless it names a limit of its own
// because of which it cannot know.
TEST(Impossibility, IsProvedExactlyWhereTryingEverythingFindsNothing) {
  PlannerOptions options;
  options.partial_plans = 2'000;
  options.instance_choices = 2'000;
  std::map<std::string, int> counts;
  for (int seed = 1; seed <= SceneCount(); ++seed) {
    RandomScene scene(seed);
    const domain::Problem problem = scene.Draw();
    SCOPED_TRACE(fmt::format("seed {}\n{}", seed, scene.text()));
    const plan::PlanResult result = MakePlan(problem, options);
    const Answer truth = oracle::ExhaustiveAssembly(problem).Run();
    const std::string both = Name(result) + ", oracle " + Name(truth);
    ++counts[both];
    if (result.outcome == Outcome::kNone) {
      EXPECT_NE(truth, Answer::kPlan);
      EXPECT_THAT(result.conflict, Not(IsEmpty()));
      EXPECT_THAT(result.hypotheses, Not(IsEmpty()));
    }
    if (result.outcome == Outcome::kFound) {
      EXPECT_EQ(truth, Answer::kPlan);
    }
    if (truth == Answer::kNone) {
      EXPECT_TRUE(result.outcome == Outcome::kNone || !result.limits.empty()) << both;
    }
    if (std::getenv("ASSAY_IMPOSSIBLE_SCENES") != nullptr) {
      fmt::print("{} {}\n", seed, both);
      std::fflush(stdout);
    }
  }
  for (const auto& [both, count] : counts) fmt::print("{:5} {}\n", count, both);
}

// Returns a problem like those of the random scenes, in which the reason for the impossibility is
// known.
std::string BoxesOnTable(const std::string& parts, const std::string& goals,
                         const std::string& workcell = "one-arm", int lean = 60) {
  return fmt::format(
      "format: assay-scenario/1\nunits: {{length: mm, angle: degree}}\nworkcell: {}\n"
      "rules: {{tool_lean: {}}}\nparts:\n{}goal:\n{}",
      workcell, lean, parts, goals);
}

std::string Box(const std::string& name, int x, int y, int z, const std::string& pose,
                Stud stud = Stud::kYes) {
  const std::string model =
      fmt::format("box-{}-{}-{}{}", x, y, z, stud == Stud::kYes ? "" : "-smooth");
  TheModels().Write("parts/" + model + "/part.yaml", StackingBox(x, y, z, stud));
  return fmt::format("  {}: {{model: {}, pose: {{stable: {}}}}}\n", name, model, pose);
}

// A chain: b on a, and c on b. People can build it, but the planner does not stack more than two
// parts.
TEST(Impossibility, IsNotSaidOfWhatThePlannerDoesNotDo) {
  const plan::PlanResult result =
      MakePlan(Read(BoxesOnTable(Box("a", 60, 60, 50, "upright, at: [600, 0]") +
                                     Box("b", 60, 60, 50, "upright, at: [550, -180]") +
                                     Box("c", 60, 60, 50, "upright, at: [550, 180]"),
                                 Stacked("b", "a", 50) + Stacked("c", "b", 50))),
               {});
  EXPECT_EQ(result.outcome, Outcome::kBudget);
  EXPECT_THAT(result.conflict, IsEmpty());
  EXPECT_THAT(result.limits, ElementsAre(HasSubstr("b is mated into a, c is mated into b")));
}

// A chain in which c cannot be reached. Whatever is done with b, the impossibility is proved.
TEST(Impossibility, IsProvedOfAChainWhereAPartOfItCannotBeTaken) {
  const plan::PlanResult result =
      MakePlan(Read(BoxesOnTable(Box("a", 60, 60, 50, "upright, at: [600, 0]") +
                                     Box("b", 60, 60, 50, "upright, at: [550, -180]") +
                                     Box("c", 120, 120, 50, "upright, at: [550, 180]", Stud::kNo),
                                 Stacked("b", "a", 50) + Stacked("c", "b", 50), "one-arm", 20)),
               {});
  EXPECT_EQ(result.outcome, Outcome::kNone);
  EXPECT_THAT(TextsOf(result.conflict), Contains("c starts upright"));
}

TEST(Impossibility, AnotherArmThatGetsThereIsALimitOfThePlanner) {
  const auto at = [](int x) {
    return Read(BoxesOnTable(Box("a", 60, 60, 50, fmt::format("upright, at: [{}, 0]", x)),
                             "  - located: {part: a, stable: [XP1]}\n", "two-arms", 90));
  };
  const plan::PlanResult near = MakePlan(at(-400), {});
  EXPECT_EQ(near.outcome, Outcome::kFound);
  const plan::PlanResult far = MakePlan(at(560), {});
  EXPECT_EQ(far.outcome, Outcome::kBudget);
  EXPECT_THAT(far.limits, ElementsAre(HasSubstr("robot left")));
}

// The Puma lifts a box that stands this close to its base straight through a singularity of the
// wrist. It reaches every pose on the line, but in no single configuration. An arm that turns its
// wrist on the way does it. Nearer to the base, the box is out of reach in any configuration.
TEST(Impossibility, IsNotSaidWhereTheArmHasToChangeItsConfiguration) {
  const auto result_at = [](int x) {
    return MakePlan(
        Read(BoxesOnTable(Box("a", 60, 60, 50, "upright, at: [650, 0]") +
                              Box("b", 40, 40, 40, fmt::format("upright, at: [{}, -80]", x)),
                          Stacked("b", "a", 50), "one-arm", 5)),
        {});
  };
  EXPECT_EQ(result_at(500).outcome, Outcome::kFound);
  const plan::PlanResult result = result_at(400);
  EXPECT_EQ(result.outcome, Outcome::kBudget);
  EXPECT_THAT(result.conflict, IsEmpty());
  EXPECT_THAT(result.limits, ElementsAre(HasSubstr("arms keep their configuration")));
  EXPECT_EQ(result_at(340).outcome, Outcome::kNone);
}

// Two boxes stand side by side without room for a finger between them. They are so long that they
// can be held only across. Each box keeps the other from being taken first.
TEST(Impossibility, IsProvedOfPartsThatKeepEachOtherFromBeingTaken) {
  const auto result_with = [](int y) {
    return MakePlan(Read(BoxesOnTable(Box("a", 120, 40, 60, "upright, at: [600, 0]", Stud::kNo) +
                                          Box("b", 120, 40, 60,
                                              fmt::format("upright, at: [600, {}]", y), Stud::kNo) +
                                          Box("base", 60, 60, 40, "upright, at: [550, -250]"),
                                      Stacked("a", "base", 40), "one-arm", 5)),
                    {.partial_plans = 500, .instance_choices = 500});
  };
  EXPECT_EQ(result_with(200).outcome, Outcome::kFound);
  const plan::PlanResult result = result_with(41);
  EXPECT_EQ(result.outcome, Outcome::kNone);
  EXPECT_THAT(TextsOf(result.conflict), Contains("a is in the way where it starts"));
  EXPECT_THAT(TextsOf(result.conflict), Contains("b is in the way where it starts"));
}

// The conflict of the relaxed problem is never empty. Without any one of its constraints something
// becomes possible.
TEST(Impossibility, EveryConstraintOfAConflictIsNeeded) {
  int proofs = 0;
  for (int seed = 1; seed <= SceneCount() / 2; ++seed) {
    RandomScene scene(seed);
    const domain::Problem problem = scene.Draw();
    const ImpossibilityAnswer answer = ProveImpossible(problem);
    if (!answer.proof) continue;
    ++proofs;
    const RelaxedProblem relaxed(problem, RelaxedProblem::Grasps::kWithMisses);
    const std::vector<std::string> texts = TextsOf(answer.proof->conflict);
    std::vector<Constraint> conflict;
    for (const Constraint& constraint : relaxed.Constraints()) {
      if (std::ranges::count(texts, Describe(relaxed, constraint)) > 0) {
        conflict.push_back(constraint);
      }
    }
    EXPECT_THAT(conflict, SizeIs(answer.proof->conflict.size()));
    EXPECT_THAT(conflict, Not(IsEmpty()));
    EXPECT_FALSE(relaxed.IsPossibleWith({conflict})) << seed;
    for (const Constraint& constraint : conflict) {
      std::vector<Constraint> fewer = conflict;
      std::erase(fewer, constraint);
      EXPECT_TRUE(relaxed.IsPossibleWith({fewer})) << seed << Describe(relaxed, constraint);
    }
  }
  EXPECT_GT(proofs, 0);
}

// The set of attainable facts is a fixed point. A set is not confirmed if one fact is missing, or
// if the set contains the goal.
TEST(Impossibility, IsNotConfirmedWhereAnActionWasLeftOut) {
  const domain::Problem problem = LoadScenario("impossible");
  const ImpossibilityAnswer answer = ProveImpossible(problem);
  ASSERT_TRUE(answer.proof);
  const Attainable& attainable = answer.proof->attainable;
  EXPECT_TRUE(Confirms(problem, attainable));
  int facts = 0;
  for (std::size_t p = 0; p < attainable.rests.size(); ++p) {
    for (std::size_t position = 0; position < attainable.rests[p].size(); ++position) {
      if (!attainable.rests[p][position]) continue;
      Attainable less = attainable;
      less.rests[p][position] = false;
      EXPECT_FALSE(Confirms(problem, less)) << p << " " << position;
      ++facts;
    }
    for (std::size_t g = 0; g < attainable.held[0][p].size(); ++g) {
      if (!attainable.held[0][p][g]) continue;
      Attainable less = attainable;
      less.held[0][p][g] = false;
      EXPECT_FALSE(Confirms(problem, less)) << p << " " << g;
      ++facts;
    }
  }
  EXPECT_GT(facts, 4);
  Attainable more = attainable;
  more.mated[0] = true;
  EXPECT_FALSE(Confirms(problem, more));
}

TEST(Impossibility, TellsWhatIsMissedByLeast) {
  const plan::PlanResult result = MakePlan(LoadScenario("impossible"), {});
  ASSERT_EQ(result.outcome, Outcome::kNone);
  EXPECT_THAT(TextsOf(result.near_misses), Contains(HasSubstr("more than the limit of 10 deg")));
  EXPECT_THAT(result.hypotheses, Contains(HasSubstr("placements of workcell puma762-table")));
}

// The situation of a reason has the numbers of its sentence: the hand leans as much as the sentence
// says, and the mating vector too. The conflict shows the same situations.
TEST(Impossibility, ShowsWhereAConstraintFails) {
  const domain::Problem problem = LoadScenario("impossible");
  const plan::PlanResult result = MakePlan(problem, {});
  const auto about = [](const std::vector<plan::Reason>& reasons, const std::string& words) {
    const auto found = std::ranges::find_if(
        reasons, [&](const auto& reason) { return reason.text.find(words) != std::string::npos; });
    return found == reasons.end() ? plan::Situation{} : found->situation.value();
  };
  const auto lean = [](const geometry::Vector3& direction) {
    return std::acos(-direction.normalized().z());
  };
  const plan::Situation tool = about(result.near_misses, "the tool would lean");
  ASSERT_TRUE(tool.hand && tool.excess);
  EXPECT_EQ(tool.excess->dimension, domain::Dimension::kAngle);
  EXPECT_NEAR(lean(tool.hand->X_WorldTool.linear().col(2)), tool.excess->value, 1e-9);
  EXPECT_NEAR(tool.excess->limit, 10 * M_PI / 180, 1e-9);
  EXPECT_EQ(about(result.conflict, "leans at most 10 deg").excess->value, tool.excess->value);
  const plan::Situation mating = about(result.near_misses, "the mating vector");
  ASSERT_EQ(mating.parts.size(), 2u);
  const domain::Mating& mated = problem.matings.front();
  EXPECT_EQ(mating.parts[1].part, mated.fixed);
  const geometry::Pose& X_WorldFixed = mating.parts[1].X_WorldPart;
  EXPECT_NEAR(lean(X_WorldFixed.linear() * mated.mating_vector), mating.excess->value, 1e-9);
  EXPECT_TRUE(mating.parts[0].X_WorldPart.isApprox(X_WorldFixed * mated.X_FixedHeld));
  const plan::Situation start = about(result.conflict, "block starts face-down");
  ASSERT_EQ(start.parts.size(), 1u);
  EXPECT_EQ(problem.part(start.parts[0].part).name, "block");
  EXPECT_FALSE(start.hand);
}

// The arm stands so far away that it does not reach a corner of the table. If the same tool pose is
// nearer to the arm by the excess, the arm reaches it.
TEST(Impossibility, ShowsThePoseThatIsNotReached) {
  std::ifstream file(TheModels().folder() / "workcells/one-arm/workcell.yaml");
  std::string text(std::istreambuf_iterator<char>(file), {});
  const std::string base = "[-0.15, 0, 0.70]";
  ASSERT_NE(text.find(base), std::string::npos);
  TheModels().Write("workcells/far-arm/workcell.yaml",
                    text.replace(text.find(base), base.size(), "[-0.75, 0, 0.70]"));
  const domain::Problem problem =
      Read(BoxesOnTable(Box("far", 60, 60, 50, "upright, at: [1000, 580]"),
                        "  - located: {part: far, stable: [XP1]}\n", "far-arm"));
  const plan::PlanResult result = MakePlan(problem, {});
  ASSERT_EQ(result.outcome, Outcome::kNone);
  const auto miss = std::ranges::find_if(result.near_misses, [](const plan::Reason& reason) {
    return reason.text.starts_with("the arm does not reach");
  });
  ASSERT_NE(miss, result.near_misses.end());
  const plan::Situation& situation = miss->situation.value();
  ASSERT_TRUE(situation.excess && situation.hand);
  const geometry::Pose& X_WorldTool = situation.hand->X_WorldTool;
  const auto is_reached = [&](double nearer) {
    const domain::Workcell& workcell = *problem.workcell;
    const geometry::Vector3 from_axis =
        X_WorldTool.translation() - workcell.X_WorldBase().translation();
    const geometry::Vector3 shift =
        -nearer * geometry::Vector3(from_axis.x(), from_axis.y(), 0).normalized();
    const auto solutions = workcell.arm().Inverse(
        workcell.FlangeFor(geometry::Translation(shift) * X_WorldTool), workcell.home());
    return std::ranges::any_of(solutions, [&](const auto& solution) {
      return workcell.arm().NearestInRange(solution.q, workcell.home()).has_value();
    });
  };
  const double excess = situation.excess->value - situation.excess->limit;
  EXPECT_GT(excess, 0);
  EXPECT_FALSE(is_reached(0));
  EXPECT_FALSE(is_reached(excess - 0.002));
  EXPECT_TRUE(is_reached(excess + 1e-6));
}

// A plate of 120 mm by 20 mm can be held only by two sides that are too far apart, or by faces 20
// mm high. Pads of 16 mm that are turned by 45 degrees need 16 sqrt(2) mm. They stick out of the
// faces, and hold the plate.
TEST(Impossibility, IsNotSaidWhereTurnedPadsStickOut) {
  const plan::PlanResult result =
      MakePlan(Read(BoxesOnTable(Box("plate", 120, 90, 20, "upright, at: [600, 0]"),
                                 "  - located: {part: plate, stable: [XP1]}\n", "one-arm", 60)),
               {});
  EXPECT_NE(result.outcome, Outcome::kNone);
}

}  // namespace
}  // namespace assay::constraint_posting::impossibility_test
