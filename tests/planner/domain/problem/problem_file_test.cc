#include "planner/domain/problem/problem_file.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <numbers>
#include <sstream>

#include "planner/base/random.h"
#include "planner/geometry/hull.h"
#include "planner/geometry/pose.h"
#include "tests/planner/domain/scenario.h"
#include "tests/scratch_file.h"

namespace assay::domain::problem_file_test {
namespace {

using testing::HasSubstr;

constexpr double kInch = 0.0254;
constexpr double kDegree = std::numbers::pi / 180;
constexpr double kTolerance = 1e-12;

std::string ReadText(const std::filesystem::path& file) {
  std::stringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

std::string MessageOf(const std::string& text, const std::string& file) {
  try {
    ReadProblem(Document::Parse(text, file), ModelsFolder());
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

const std::string kBrick = R"(
format: assay-scenario/1
units: {length: inch, angle: degree}
workcell: puma762-table
parts:
  lower: {model: brick, pose: {stable: upright, at: [24, 2], yaw: 30}}
  upper: {model: brick}
  other: {model: brick, pose: {stable: BRP1, at: [24, -8]}}
initially:
  - assembled: {held: upper, fixed: lower, features: [[6], [5]],
                pose: {columns: [[1, 0, 0], [0, 1, 0], [0, 0, 1], [0, 0, 4]]},
                mating_vector: [0, 0, -1]}
goal:
  - located: {part: other, stable: [upright, BRP3]}
)";

TEST(ProblemFile, EveryScenarioLoads) {
  ASSERT_GE(AllScenarios().size(), 9u);
  for (const std::string& name : AllScenarios()) {
    SCOPED_TRACE(name);
    const Problem problem = LoadScenario(name);
    EXPECT_EQ(problem.name, name);
    EXPECT_FALSE(problem.title.empty());
    // A scenario may have only goals of its key `knowledge`.
    EXPECT_EQ(problem.goals.empty(),
              Document::Load(ScenarioPath(name)).root().Find("knowledge").has_value());
    for (const Part& part : problem.parts) {
      EXPECT_FALSE(part.grasps->empty());
      EXPECT_FALSE(part.resting.IsNone());
    }
  }
}

TEST(ProblemFile, ReadsResolvers) {
  using enum ResolverKind;
  const auto resolvers = [](const std::string& key, const Overrides& overrides) {
    return ReadProblem(Document::Parse(kBrick + key, "s.yaml"), ModelsFolder(), overrides)
        .resolvers;
  };
  EXPECT_THAT(resolvers("", {}), testing::ElementsAre(kSensing, kSqueezing, kFineMotion));
  const std::string both = "resolvers: [fine-motion, sensing]\n";
  EXPECT_THAT(resolvers(both, {}), testing::ElementsAre(kSensing, kFineMotion));
  Overrides overrides;
  overrides.resolvers = {kFineMotion};
  EXPECT_THAT(resolvers(both, overrides), testing::ElementsAre(kFineMotion));
  EXPECT_THAT(MessageOf(kBrick + "resolvers: [sensing, fine-moton]\n", "s.yaml"),
              testing::AllOf(HasSubstr("s.yaml:15:22"), HasSubstr("did you mean 'fine-motion'")));
  EXPECT_THAT(MessageOf(kBrick + "resolvers: [sensing, sensing]\n", "s.yaml"),
              HasSubstr("'sensing' is given twice"));
  EXPECT_THAT(MessageOf(kBrick + "resolvers: []\n", "s.yaml"),
              HasSubstr("at least one of sensing, squeezing, fine-motion"));
}

// The numbers are those of Spar, "A Task Planning Example" and Table 2, in metres and radians.
TEST(ProblemFile, ReadsTheNumbersOfThePaper) {
  const Problem problem = LoadScenario("spar-example");
  const PartId peg = PartNamed(problem, "peg");
  const PartId block = PartNamed(problem, "block");
  ASSERT_EQ(problem.matings.size(), 1u);
  const Mating& mating = problem.matings[0];
  EXPECT_EQ(mating.held, peg);
  EXPECT_EQ(mating.fixed, block);
  const std::vector<std::pair<FeatureNumber, FeatureNumber>> features = {
      {FeatureNumber(7), FeatureNumber(7)}, {FeatureNumber(8), FeatureNumber(8)}};
  EXPECT_EQ(mating.features, features);
  EXPECT_TRUE(mating.X_FixedHeld.linear().isApprox(Vector3(-1, 1, -1).asDiagonal().toDenseMatrix(),
                                                   kTolerance));
  EXPECT_TRUE(mating.X_FixedHeld.translation().isApprox(kInch * Vector3(3, 0, 3.25), kTolerance));
  EXPECT_TRUE(mating.mating_vector.isApprox(kInch * Vector3(-4, 0, 0), kTolerance));
  EXPECT_EQ(std::get<MatingId>(problem.goals.at(0)), MatingId(0));
  EXPECT_NEAR(problem.part(block).error.x.low, -0.11 * kInch, kTolerance);
  EXPECT_NEAR(problem.part(block).error.theta.high, 5.5 * kDegree, kTolerance);
  EXPECT_NEAR(problem.gripper_error.y.high, 0.001 * kInch, kTolerance);
  EXPECT_NEAR(problem.gripper_error.theta.high, 0.001 * kDegree, kTolerance);
  EXPECT_EQ(problem.clearance, 0.0005);
  EXPECT_EQ(problem.sensors, std::vector<std::string>{"overhead-camera"});
}

TEST(ProblemFile, PlacesAPartByStablePoseAndYaw) {
  const Problem problem = ParseScenario(kBrick);
  const Part& lower = problem.part(PartNamed(problem, "lower"));
  EXPECT_TRUE(lower.X_WorldPart.translation().isApprox(kInch * Vector3(24, 2, 2), 1e-9));
  EXPECT_EQ(lower.resting, lower.model->FindStablePose("upright"));
  // In the stable pose at yaw 0, the x axis of the part is along that of the table.
  const Vector3 x = lower.X_WorldPart.linear().col(0);
  EXPECT_NEAR(std::atan2(x.y(), x.x()), 30 * kDegree, 1e-9);
  EXPECT_EQ(problem.parts[2].resting, StablePoseId(0)) << "BRP1 is the label of the first";
}

TEST(ProblemFile, DerivesThePoseOfAnAssembledPart) {
  const Problem problem = ParseScenario(kBrick);
  const Part& lower = problem.parts[0];
  const Part& upper = problem.parts[1];
  EXPECT_EQ(problem.assembled, std::vector<MatingId>{MatingId(0)});
  EXPECT_TRUE(upper.resting.IsNone());
  EXPECT_TRUE(upper.X_WorldPart.isApprox(lower.X_WorldPart * geometry::Translation(0, 0, 4 * kInch),
                                         kTolerance));
  EXPECT_EQ(std::get<LocatedGoal>(problem.goals.at(0)).stable_poses.size(), 2u);
}

// The scenario lists a tower from the top down.
TEST(ProblemFile, DerivesPosesAlongAChain) {
  const Problem problem = ParseScenario(R"(
format: assay-scenario/1
workcell: puma762-table
parts:
  top: {model: brick}
  middle: {model: brick}
  bottom: {model: brick, pose: {stable: upright, at: [0.6, 0]}}
initially:
  - assembled: {held: top, fixed: middle, features: [[6], [5]], mating_vector: [0, 0, -0.02],
                pose: {columns: [[1, 0, 0], [0, 1, 0], [0, 0, 1], [0, 0, 0.1016]]}}
  - assembled: {held: middle, fixed: bottom, features: [[6], [5]], mating_vector: [0, 0, -0.02],
                pose: {columns: [[1, 0, 0], [0, 1, 0], [0, 0, 1], [0, 0, 0.1016]]}}
goal:
  - located: {part: bottom, stable: [upright]}
)");
  EXPECT_NEAR(problem.parts[0].X_WorldPart.translation().z(), 5 * 0.0508, kTolerance);
  EXPECT_NEAR(problem.parts[1].X_WorldPart.translation().z(), 3 * 0.0508, kTolerance);
}

TEST(ProblemFile, AGoalThatHoldsAtTheStartIsTheSameMating) {
  std::string text = kBrick;
  const std::size_t begin = text.find("  - assembled");
  const std::size_t end = text.find("goal:");
  text += text.substr(begin, end - begin);
  const Problem problem = ParseScenario(text);
  EXPECT_EQ(problem.matings.size(), 1u);
  EXPECT_EQ(std::get<MatingId>(problem.goals.at(1)), problem.assembled.at(0));
}

TEST(ProblemFile, PartsOfOneModelShareIt) {
  const Problem problem = ParseScenario(kBrick);
  EXPECT_EQ(problem.parts[0].model, problem.parts[2].model);
  EXPECT_EQ(problem.parts[0].grasps, problem.parts[2].grasps);
}

TEST(ProblemFile, ScenarioRulesReplaceThoseOfTheWorkcell) {
  const Problem given = ParseScenario(kBrick);
  const Problem replaced =
      ParseScenario(kBrick + "rules: {tool_lean: 10, part_gap: 1, approach_step: 45}\n");
  EXPECT_NEAR(replaced.workcell->rules().tool_lean, 10 * kDegree, kTolerance);
  EXPECT_NEAR(replaced.workcell->rules().part_gap, kInch, kTolerance);
  EXPECT_EQ(replaced.workcell->rules().safe_height, given.workcell->rules().safe_height);
  EXPECT_LT(replaced.parts[0].grasps->size(), given.parts[0].grasps->size());
}

TEST(ProblemFile, ReadsIntervalsAndLeavesOutWhatIsExact) {
  std::string text = kBrick;
  text.replace(text.find("upper: {model: brick"), 20,
               "upper: {model: brick, error: {x: [-0.1, 0.3], theta: 2}");
  const PoseError error = ParseScenario(text).parts[1].error;
  EXPECT_NEAR(error.x.low, -0.1 * kInch, kTolerance);
  EXPECT_NEAR(error.x.high, 0.3 * kInch, kTolerance);
  EXPECT_EQ(error.y.high, 0);
  EXPECT_NEAR(error.theta.low, -2 * kDegree, kTolerance);
}

// The pose is given as columns. It is upside down and turned by 30 degrees.
TEST(ProblemFile, FindsTheStablePoseOfAnAbsolutePose) {
  std::string text = kBrick;
  const std::string pose = "{stable: BRP1, at: [24, -8]}";
  text.replace(text.find(pose), pose.size(),
               "{columns: [[0.8, 0.6, 0], [0.6, -0.8, 0], [0, 0, -1], [24, -8, 2]]}");
  const Part part = ParseScenario(text).parts[2];
  EXPECT_EQ(part.resting, part.model->FindStablePose("upside-down"));
}

std::string WithBrickAt(const std::string& entries) {
  std::string text = kBrick;
  const std::string pose = "pose: {stable: BRP1, at: [24, -8]}";
  return text.replace(text.find(pose), pose.size(), entries);
}

// A fixture presses only while a part is mated. Until then, and at its force, a leaning part falls.
TEST(ProblemFile, APartThatLeansFallsInItsFixtureToo) {
  const std::string leaning =
      "pose: {columns: [[0.8, 0, -0.6], [0, 1, 0], [0.6, 0, 0.8], [24, -8, 2.2]]}";
  EXPECT_THROW(ParseScenario(WithBrickAt(leaning + ", clamp: 10")), InputError);
  EXPECT_THROW(ParseScenario(WithBrickAt(leaning)), InputError);
}

// A brick that is 2 inches wide stands on another brick. The upper brick falls over if errors move
// its centre more than an inch away from the centre of the lower brick.
TEST(ProblemFile, APartThatStandsOnAnotherOneDoesSoForAllErrors) {
  const auto message_with = [](double error) {
    const std::string tower = fmt::format(
        "  base: {{model: brick, pose: {{stable: upright, at: [20, 12]}}, error: {{x: {0}}}}}\n"
        "  top: {{model: brick, error: {{x: {0}}},\n"
        "          pose: {{columns: [[1, 0, 0], [0, 1, 0], [0, 0, 1], [20, 12, 6]]}}}}\n",
        error);
    std::string text = kBrick;
    return MessageOf(text.insert(text.find("initially:"), tower).substr(1), "s.yaml");
  };
  EXPECT_EQ(message_with(0.49), "no error");
  EXPECT_THAT(message_with(0.51), HasSubstr("part 'top' may fall over"));
}

// A pose that is written with a few digits stands for the nearby pose in which the part rests.
TEST(ProblemFile, APartComesToRest) {
  const Part exact = ParseScenario(kBrick).parts[2];
  const Pose& X = exact.X_WorldPart;
  for (const double lean : {0.0, 0.01, -0.017}) {
    const Pose aside = X * geometry::RotationX(lean);
    std::string columns;
    for (int axis = 0; axis < 3; ++axis) {
      const geometry::Vector3 c = aside.linear().col(axis);
      columns += fmt::format("[{:.9f}, {:.9f}, {:.9f}], ", c.x(), c.y(), c.z());
    }
    const geometry::Vector3 at = aside.translation() / kInch;
    columns += fmt::format("[{:.9f}, {:.9f}, {:.9f}]", at.x(), at.y(), at.z() + 0.03);
    const Part part = ParseScenario(WithBrickAt("pose: {columns: [" + columns + "]}")).parts[2];
    EXPECT_EQ(part.resting, exact.resting);
    EXPECT_TRUE(part.X_WorldPart.isApprox(X, 1e-8)) << lean;
  }
}

TEST(ProblemFile, ReadsTolerancesInTheFilesUnits) {
  EXPECT_EQ(ParseScenario(kBrick).tolerances, Tolerances{});
  EXPECT_EQ(ParseScenario(kBrick + "tolerances: {}\n").tolerances, Tolerances{});
  const Problem problem = ParseScenario(
      kBrick +
      "clearance: 0.02\ntolerances: {clearance: 0.005, friction: 0.05, pad_friction: 0.1}\n");
  EXPECT_NEAR(problem.tolerances.clearance, 0.005 * kInch, kTolerance);
  EXPECT_EQ(problem.tolerances.friction, 0.05);
  EXPECT_EQ(problem.tolerances.pad_friction, 0.1);
  EXPECT_NEAR(problem.clearance, 0.02 * kInch, kTolerance) << "the middle stays";
}

TEST(ProblemFile, ReadsMatingErrorsInTheFilesUnits) {
  const MatingErrors usual = {.displacement = 0.002, .rotation = kDegree};
  EXPECT_EQ(ParseScenario(kBrick).mating_errors, usual);
  const Problem problem =
      ParseScenario(kBrick + "mating_errors: {displacement: 0.02, rotation: 0.5}\n");
  EXPECT_NEAR(problem.mating_errors.displacement, 0.02 * kInch, kTolerance);
  EXPECT_NEAR(problem.mating_errors.rotation, 0.5 * kDegree, kTolerance);
  EXPECT_EQ(ParseScenario(kBrick + "mating_errors: {rotation: 0}\n").mating_errors,
            (MatingErrors{.displacement = usual.displacement, .rotation = 0}));
  EXPECT_EQ(ParseScenario(kBrick + "mating_errors: {velocity: 0.01}\n").mating_errors.velocity,
            0.01)
      << "a share has no unit";
}

// ---- Overrides ----

Problem ParseWith(const std::string& text, const Overrides& overrides) {
  return ReadProblem(Document::Parse(text, "scenario.yaml"), ModelsFolder(), overrides);
}

TEST(Overrides, AClearanceIsAsIfTheFileSaidSo) {
  std::string text = ReadText(ScenarioPath("uncertain-known"));
  const std::size_t said = text.find("clearance: 1\n");
  ASSERT_NE(said, std::string::npos);
  const Problem overridden = ParseWith(text, {.clearance = 0.0007});
  const Problem written = ParseScenario(text.replace(said, 12, "clearance: 0.7"));
  EXPECT_EQ(overridden.clearance, written.clearance);
  ASSERT_EQ(overridden.parts.size(), written.parts.size());
  for (std::size_t p = 0; p < written.parts.size(); ++p) {
    const PartModel& a = *overridden.parts[p].model;
    const PartModel& b = *written.parts[p].model;
    ASSERT_EQ(a.pieces().size(), b.pieces().size());
    for (std::size_t i = 0; i < a.pieces().size(); ++i) {
      EXPECT_EQ(a.pieces()[i].vertices, b.pieces()[i].vertices);
    }
  }
}

std::string OverrideErrorOf(const std::string& text, const Overrides& overrides) {
  try {
    ParseWith(text, overrides);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Overrides, AClearanceIsChecked) {
  EXPECT_THAT(OverrideErrorOf(kBrick, {.clearance = 0.02}),
              HasSubstr("scenario.yaml:2:1: 0.02 m instead of this clearance is out of range; "
                        "allowed: 1e-06 m to 0.01 m"));
  EXPECT_THAT(OverrideErrorOf(kBrick + "clearance: 0.02\n", {.clearance = std::nan("")}),
              HasSubstr("scenario.yaml:15:12: nan m instead of this clearance"));
  const std::string tolerant = kBrick + "tolerances: {clearance: 0.01}\n";
  EXPECT_EQ(OverrideErrorOf(tolerant, {}), "no error");
  EXPECT_THAT(OverrideErrorOf(tolerant, {.clearance = 0.0002}),
              HasSubstr("0.01 inch is no tolerance of the clearance; allowed: 0 inch or more, less "
                        "than 0.00787402 inch"));
}

void ExpectScaled(const PoseError& scaled, const PoseError& error, double scale) {
  for (Interval PoseError::*range :
       {&PoseError::x, &PoseError::y, &PoseError::z, &PoseError::theta}) {
    EXPECT_EQ((scaled.*range).low, scale * (error.*range).low);
    EXPECT_EQ((scaled.*range).high, scale * (error.*range).high);
  }
}

TEST(Overrides, ErrorsOfPartsAndGripperAreScaledAndNothingElse) {
  const std::string text =
      ReadText(ScenarioPath("uncertain-sensing")) + "\ntolerances: {friction: 0.1}\n";
  const Problem said = ParseScenario(text);
  for (const double scale : {0.0, 0.1, 1.0, 2.5}) {
    const Problem problem = ParseWith(text, {.error_scale = scale});
    for (std::size_t p = 0; p < said.parts.size(); ++p) {
      ExpectScaled(problem.parts[p].error, said.parts[p].error, scale);
    }
    ExpectScaled(problem.gripper_error, said.gripper_error, scale);
    EXPECT_EQ(problem.tolerances, said.tolerances);
    EXPECT_EQ(problem.clearance, said.clearance);
    EXPECT_EQ(problem.workcell->uncertainty_operations().sensors[0].x,
              said.workcell->uncertainty_operations().sensors[0].x);
  }
  EXPECT_FALSE(std::signbit(ParseWith(text, {.error_scale = 0}).gripper_error.x.low));
}

TEST(Overrides, AndFilesAreTheOriginOfAProblem) {
  const std::string origin = ParseWith(kBrick, {}).origin;
  EXPECT_FALSE(origin.empty());
  EXPECT_EQ(ParseWith(kBrick, {}).origin, origin);
  EXPECT_NE(ParseWith(kBrick + "# changed\n", {}).origin, origin);
  EXPECT_NE(ParseWith(kBrick, {.clearance = 0.0007}).origin, origin);
  EXPECT_NE(ParseWith(kBrick, {.error_scale = 2}).origin, origin);
  EXPECT_NE(ParseWith(kBrick, {.resolvers = {{ResolverKind::kSensing}}}).origin, origin);
}

TEST(ProblemFile, LeavesTheSimulationKeyAlone) {
  EXPECT_EQ(MessageOf(kBrick + "simulation: {whatever: [1, 2]}\n", "s.yaml"), "no error");
}

TEST(ProblemFile, SaysWhichModelsFolderLacks) {
  try {
    ReadProblem(Document::Parse(kBrick, "s.yaml"), "/nowhere");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("unknown name 'puma762-table'; allowed: nothing"));
  }
}

// The first line of each file is a comment with the message that follows after the name of the
// file.
TEST(ProblemFile, WrongFilesAreRefusedWithPlaceAndRemedy) {
  const std::filesystem::path folder =
      std::filesystem::path(ASSAY_SOURCE_DIR) / "tests/planner/domain/wrong";
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string text = ReadText(entry.path());
    const std::string wanted = text.substr(2, text.find('\n') - 2);
    EXPECT_EQ(MessageOf(text, "wrong.yaml"), "wrong.yaml:" + wanted) << entry.path().filename();
    ++files;
  }
  EXPECT_GE(files, 60);
}

// Returns the text with one random mistake.
std::string Mutated(const std::string& text, RandomStream& random) {
  static const std::vector<std::string> kPieces = {
      "0",   "-1",    "1e9", "1e-9", "1e308", "-0",  ".5",   "360",   "[]",     "{}",
      "~",   "[",     "}",   ":",    "\n",    "  ",  ",",    "model", "on-end", "block",
      "peg", "brick", "BP2", "#",    "'",     "nan", "true", "7",     "pose",   "[0, 0, 1]"};
  std::string mutated = text;
  const int size = static_cast<int>(text.size());
  const int at = random.Index(size);
  const int length = std::min(random.Index(12), size - at);
  switch (random.Index(4)) {
    case 0:
      mutated.erase(at, length);
      break;
    case 1:
      mutated.insert(at, kPieces[random.Index(static_cast<int>(kPieces.size()))]);
      break;
    case 2: {  // Replaces a word or a number by another one.
      const std::size_t begin = mutated.find_first_of("0123456789abcdefghijklmnopqrstuvwxyz", at);
      if (begin == std::string::npos) break;
      const std::size_t end = mutated.find_first_of(" ,:]}\n", begin);
      mutated.replace(begin, end - begin, kPieces[random.Index(static_cast<int>(kPieces.size()))]);
      break;
    }
    case 3:
      mutated.insert(random.Index(size), text.substr(at, length));
      break;
  }
  return mutated;
}

int MutationCount() {
  const char* count = std::getenv("ASSAY_MUTATIONS");
  return count == nullptr ? 1000 : std::atoi(count);
}

constexpr int kQuarters = 4;  // quarters of the mutations run side by side

class Mutations : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Quarters, Mutations, testing::Range(0, kQuarters));

// A mistake in a file gives a problem or an InputError, and nothing else. The variable
// ASSAY_MUTATIONS sets a greater number of mistakes, like 10000. A check that aborts leaves the
// text in the temporary folder.
TEST_P(Mutations, AreSurvived) {
  std::vector<std::string> texts;
  for (const std::string& name : AllScenarios()) {
    const std::string text = ReadText(ScenarioPath(name));
    texts.push_back(text.substr(text.find("format:")));
  }
  texts.push_back(kBrick.substr(1));
  const std::filesystem::path last = ScratchFile(fmt::format("mutation-{}.yaml", GetParam()));
  RandomStream random(20240501, fmt::format("mutations/{}", GetParam()));
  int loaded = 0;
  const int count = MutationCount() / kQuarters;
  for (int trial = 0; trial < count; ++trial) {
    std::string text = texts[trial % texts.size()];
    for (int slips = 1 + random.Index(3); slips > 0; --slips) text = Mutated(text, random);
    std::ofstream(last) << text;
    const std::string message = MessageOf(text, "mutated.yaml");
    loaded += message == "no error" ? 1 : 0;
    const bool tells = message == "no error" || message.find("mutated.yaml:") == 0 ||
                       message.find("part.yaml") != std::string::npos;
    ASSERT_TRUE(tells) << "trial " << trial << ": " << message << "\n" << text;
  }
  EXPECT_GT(loaded, count / 50) << "mutations so coarse that they test the YAML reader alone";
  EXPECT_LT(loaded, count * 9 / 10);
  std::filesystem::remove(last);
}

}  // namespace
}  // namespace assay::domain::problem_file_test
