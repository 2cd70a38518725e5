#include "sim/film/film.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "planner/assembly/certified_plan.h"
#include "planner/base/input_files/input_error.h"
#include "sim/execution/robots/execution.h"
#include "sim/execution/walk/executor.h"
#include "sim/film/ffmpeg.h"
#include "sim/film/shoot.h"
#include "sim/render/picture.h"
#include "sim/scenario/scenario.h"
#include "tests/scratch_file.h"

namespace assay::film::film_test {
namespace {

using testing::ElementsAre;
using testing::StartsWith;

// A pickup and an assembly.
struct TwoSteps {
  scenario::Scenario scenario = scenario::Load(ASSAY_SOURCE_DIR "/scenarios/uncertain-known.yaml");
  plan::Plan plan = assembly::MakeCertifiedPlan(scenario.problem, {}, {}).plan;
  scene::Scene scene{scenario.problem, scenario.simulation.scene};
};

constexpr double kFirstEnd = 3, kSecondEnd = 7, kEnd = 8;  // seconds

// A trace that no engine made, since executions take seconds: the first part rises by 10 cm.
struct MadeUp : TwoSteps {
  execution::Trace trace = [this] {
    mujoco::Data data = scene.Start();
    execution::Snapshot now = execution::Execution(scenario.problem, scene, data, {}).Now();
    execution::Trace made{.problem = scenario.problem.name, .parts = {}, .events = {}};
    constexpr double kInterval = 0.02;
    for (int i = 0; i * kInterval < kEnd; ++i) {
      now.time = i * kInterval;
      made.events.emplace_back(execution::Sample{now});
      now.parts.front().truth.translation().z() += 0.1 * kInterval / kEnd;
    }
    const std::vector<plan::StepId> order = plan.ExecutionOrder();
    for (const auto& [step, end] :
         {std::pair(order[0], kFirstEnd), std::pair(order[1], kSecondEnd)}) {
      now.time = end;
      made.events.emplace_back(
          execution::StepEnd{.step = step,
                             .name = plan.step(step).name,
                             .action = plan::ShortText(scenario.problem, plan.step(step).action),
                             .snapshot = now});
    }
    now.time = kEnd;
    made.events.emplace_back(execution::ExecutionEnd{.snapshot = now});
    return made;
  }();

  Subject subject() const { return {scenario.problem, plan, scene, trace, "done"}; }
};

const MadeUp& Rising() {
  static const MadeUp made;
  return made;
}

Settings Small() {
  return {.width = 160, .height = 120, .samples = 1, .pictures_per_second = 2, .speed = 4};
}

std::vector<std::string> TextsOf(const std::vector<Caption>& captions) {
  std::vector<std::string> texts;
  for (const Caption& caption : captions) texts.push_back(caption.text);
  return texts;
}

std::string BytesOf(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(Captions, NameTheStepsInTheOrderOfExecutionAndTheEnd) {
  const std::vector<Caption> captions = CaptionsOf(Rising().subject());
  EXPECT_THAT(TextsOf(captions),
              ElementsAre(StartsWith("1 pickup(peg"), StartsWith("2 assemble(peg, block"), "done"));
  EXPECT_EQ(captions[0].from, 0);
  EXPECT_EQ(captions[1].from, kFirstEnd);
  EXPECT_EQ(captions[2].from, kSecondEnd);
}

TEST(Captions, EndWithTheExecutionIfAStepDidNotEnd) {
  execution::Trace trace = Rising().trace;
  std::erase_if(trace.events, [](const execution::TraceEvent& event) {
    const auto* step_end = std::get_if<execution::StepEnd>(&event);
    return step_end != nullptr && step_end->action.starts_with("assemble");
  });
  const Subject subject{Rising().scenario.problem, Rising().plan, Rising().scene, trace,
                        "collided: the arm touched the block"};
  const std::vector<Caption> captions = CaptionsOf(subject);
  ASSERT_EQ(captions.size(), 3);
  EXPECT_EQ(captions.back().text, subject.end);
  EXPECT_EQ(captions.back().from, kEnd);
}

// A walk through a plan tree names its own actions. The last one here did not end.
TEST(Captions, AreOfTheWalkedActionsIfThereAreAny) {
  Subject subject = Rising().subject();
  subject.walked = {{"look(peg)", 1.5}, {"pickup(peg)", std::nullopt}, {"never begun", 9}};
  subject.end = "stopped: the peg slipped";
  const std::vector<Caption> captions = CaptionsOf(subject);
  EXPECT_THAT(TextsOf(captions),
              ElementsAre("1 look(peg)", "2 pickup(peg)", "stopped: the peg slipped"));
  EXPECT_EQ(captions[1].from, 1.5);
  EXPECT_EQ(captions[2].from, kEnd);
}

// The arm is at home when the plan tree begins with a look.
TEST(Captions, AnActionThatTakesNoTimeSharesTheNextCaption) {
  Subject subject = Rising().subject();
  subject.walked = {{"look(peg)", 0}, {"pickup(peg)", 1.5}};
  const std::vector<Caption> captions = CaptionsOf(subject);
  EXPECT_THAT(TextsOf(captions), ElementsAre("1 look(peg), 2 pickup(peg)", subject.end));
  EXPECT_EQ(captions[0].from, 0);
}

TEST(TextAt, IsThatOfTheLastCaptionWhoseTimeHasCome) {
  const std::vector<Caption> captions = {{0, "a"}, {1.5, "b"}, {4, "c"}};
  EXPECT_EQ(TextAt(captions, 0), "a");
  EXPECT_EQ(TextAt(captions, 1.499), "a");
  EXPECT_EQ(TextAt(captions, 1.5), "b");
  EXPECT_EQ(TextAt(captions, 100), "c");
}

// The film lasts as long as the execution, divided by the speed, and a little longer at its end.
TEST(Film, LastsAsLongAsTheExecutionAtItsSpeedAndIsTheSameEachTime) {
  Film film(Rising().subject(), Small());
  double duration = 0;
  for (int i = 0; i + 1 < film.size(); ++i) duration += film.Duration(i);
  EXPECT_NEAR(duration, kEnd / 4, 0.5);
  EXPECT_GT(film.Duration(film.size() - 1), 1);
  const render::Image first = film.Draw(0);
  EXPECT_EQ(first.width, 160);
  EXPECT_EQ(first.height, 120);
  const render::Image last = film.Draw(film.size() - 1);
  EXPECT_FALSE(first == last);
  EXPECT_TRUE(film.Draw(0) == first);
  EXPECT_TRUE(Film(Rising().subject(), Small()).Draw(0) == first);
}

// What is drawn from a trace is what was drawn while the execution ran.
TEST(Film, ShowsTheEndOfTheExecutionAsTheEngineHadIt) {
  const TwoSteps steps;
  mujoco::Data data = steps.scene.Start();
  const execution::Trace trace =
      execution::Execute(steps.scenario.problem, steps.plan, steps.scene, data, {});
  data.Forward();
  Settings settings = Small();
  settings.camera = steps.scene.model().FindCamera("overview");
  ASSERT_FALSE(settings.camera.IsNone());
  Film film({steps.scenario.problem, steps.plan, steps.scene, trace, "done"}, settings);
  const render::Image drawn = film.Draw(film.size() - 1);
  constexpr int kCaption = 18;
  render::Renderer renderer(steps.scene.model(), 160, 120 - kCaption, {.samples = 1});
  const render::Image live = renderer.Render(data, settings.camera);
  int different = 0;
  for (std::size_t i = 0; i < live.rgb.size(); ++i) {
    different += std::abs(static_cast<int>(live.rgb[i]) - static_cast<int>(drawn.rgb[i])) > 8;
  }
  EXPECT_LT(different, static_cast<int>(live.rgb.size()) / 200);
}

int CountOf(const std::string& chunk, const std::string& bytes) {
  int count = 0;
  for (std::size_t at = bytes.find(chunk); at != std::string::npos; at = bytes.find(chunk, at + 4))
    ++count;
  return count;
}

TEST(Shoot, EncodesEachPictureAndEndsEarlyIfItIsTold) {
  Film film(Rising().subject(), Small());
  const std::filesystem::path file = ScratchFile("film.webp");
  std::vector<int> drawn;
  EXPECT_EQ(Shoot(film, *Begin({file, 160, 120, 2}),
                  [&](int count) { return drawn.push_back(count), true; }),
            film.size());
  EXPECT_EQ(std::ssize(drawn), film.size());
  const int pictures = CountOf("ANMF", BytesOf(file));
  EXPECT_LE(pictures, film.size());  // equal pictures are one
  EXPECT_GT(pictures, film.size() / 2);
  EXPECT_EQ(Shoot(film, *Begin({file, 160, 120, 2}), [](int count) { return count < 3; }), 3);
  EXPECT_EQ(CountOf("ANMF", BytesOf(file)), 3);
}

// A picture of one colour.
render::Image Plain(int grey) {
  return {16, 8,
          std::vector<std::uint8_t>(std::size_t{3} * 16 * 8, static_cast<std::uint8_t>(grey))};
}

// The container (RIFF) holds a chunk for the animation and a chunk for each picture.
TEST(Webp, IsAnAnimationAndTheSameForTheSamePictures) {
  std::string first;
  for (const char* name : {"one.webp", "two.webp"}) {
    const std::unique_ptr<MovingPicture> picture = Begin({ScratchFile(name), 16, 8, 10});
    for (const int grey : {0, 100, 200}) picture->Add(Plain(grey), 0.1);
    picture->Finish();
    const std::string bytes = BytesOf(ScratchFile(name));
    EXPECT_EQ(bytes.substr(0, 4), "RIFF");
    EXPECT_EQ(bytes.substr(8, 4), "WEBP");
    EXPECT_EQ(CountOf("ANIM", bytes), 1);
    EXPECT_EQ(CountOf("ANMF", bytes), 3);
    if (first.empty()) first = bytes;
    EXPECT_EQ(bytes, first);
  }
}

TEST(Webp, SaysThatAFileCannotBeWritten) {
  const std::unique_ptr<MovingPicture> picture = Begin({"/nowhere/film.webp", 1, 1, 10});
  picture->Add({1, 1, {1, 2, 3}}, 0.1);
  EXPECT_THROW(picture->Finish(), EnvironmentError);
}

TEST(Webp, RefusesPicturesOfAnotherSize) {
  const std::unique_ptr<MovingPicture> picture = Begin({ScratchFile("size.webp"), 2, 2, 10});
  EXPECT_THROW(picture->Add({1, 1, {1, 2, 3}}, 0.1), EnvironmentError);
}

// Sets the PATH to one folder for as long as it lives.
class Path {
 public:
  explicit Path(const std::filesystem::path& folder) : old_(std::getenv("PATH")) {
    setenv("PATH", folder.c_str(), 1);
  }
  ~Path() { setenv("PATH", old_.c_str(), 1); }
  Path(const Path&) = delete;
  Path& operator=(const Path&) = delete;

 private:
  std::string old_;
};

// A program in place of ffmpeg. It stores its arguments and its input.
std::filesystem::path FakeFfmpeg(const std::string& last_line) {
  const std::filesystem::path folder = ScratchFile("programs");
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "ffmpeg") << "#!/bin/sh\nfor last; do :; done\n"
                                   << "/bin/cat > \"${last#file:}\"\n"
                                   << last_line << '\n';
  std::filesystem::permissions(folder / "ffmpeg", std::filesystem::perms::owner_all);
  return folder;
}

TEST(Mp4, GivesFfmpegEveryPictureAsLongAsItIsShown) {
  const Path path(FakeFfmpeg("exit 0"));
  EXPECT_FALSE(FindFfmpeg().empty());
  const std::filesystem::path file = ScratchFile("a film.mp4");
  const std::unique_ptr<MovingPicture> picture = Begin({file, 1, 1, 10});
  picture->Add({1, 1, {'a', 'b', 'c'}}, 0.1);
  picture->Add({1, 1, {'d', 'e', 'f'}}, 0.3);
  picture->Finish();
  EXPECT_EQ(BytesOf(file), "abcdefdefdef");
}

TEST(Mp4, SaysThatFfmpegFailed) {
  const Path path(FakeFfmpeg("exit 1"));
  const std::unique_ptr<MovingPicture> picture = Begin({ScratchFile("failed.mp4"), 1, 1, 10});
  picture->Add({1, 1, {'a', 'b', 'c'}}, 0.1);
  EXPECT_THROW(picture->Finish(), EnvironmentError);
}

TEST(Mp4, NamesThePackageWhereFfmpegIsMissing) {
  const Path path("/nowhere");
  EXPECT_TRUE(FindFfmpeg().empty());
  try {
    Begin({ScratchFile("none.mp4"), 1, 1, 10});
    FAIL() << "there is no ffmpeg";
  } catch (const EnvironmentError& error) {
    EXPECT_NE(std::string(error.what()).find("apt-get install ffmpeg"), std::string::npos);
  }
}

TEST(IsMovingPicture, LooksAtTheEnding) {
  EXPECT_TRUE(IsMovingPicture("a.webp"));
  EXPECT_TRUE(IsMovingPicture("a/b.mp4"));
  EXPECT_FALSE(IsMovingPicture("a.gif"));
  EXPECT_FALSE(IsMovingPicture("webp"));
}

}  // namespace
}  // namespace assay::film::film_test
