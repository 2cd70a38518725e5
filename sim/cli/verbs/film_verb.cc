#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "planner/base/input_files/input_file.h"
#include "planner/base/input_files/quotation.h"
#include "sim/cli/command_line/console.h"
#include "sim/cli/command_line/interruption.h"
#include "sim/cli/command_line/progress.h"
#include "sim/cli/command_line/usage_error.h"
#include "sim/cli/command_line/verb.h"
#include "sim/cli/options/models_folder.h"
#include "sim/cli/page_output/noiseless_trial.h"
#include "sim/cli/page_output/plan_of_request.h"
#include "sim/cli/picture_output/picture_options.h"
#include "sim/cli/plan_output/plan_text.h"
#include "sim/cli/tasks/output_file.h"
#include "sim/cli/tasks/planned_problem.h"
#include "sim/cli/tasks/recorded_execution.h"
#include "sim/execution/interpretation/knowledge_scenario.h"
#include "sim/film/shoot.h"
#include "sim/scenario/scenario.h"

namespace assay::cli {
namespace film_verb {

namespace fs = std::filesystem;

struct Options {
  fs::path input;
  fs::path film;
  fs::path plan;  // of a trace; empty: plan.json beside it
  domain::ModelPath models;
  std::string camera = scenario::kWorkCamera;
  PictureQuality quality;
  double pictures_per_second = 10;
  double speed = 2;
};

constexpr std::size_t kMostTraceBytes = std::size_t{1} << 30;

bool IsTrace(std::string_view text) { return text.starts_with(R"({"format":"assay-trace/)"); }

film::Settings SettingsOf(const Options& options, const mujoco::Model& model) {
  const PictureSize size = SizeOf(options.quality);
  const bool is_work = options.camera == scenario::kWorkCamera;
  return {.camera = is_work ? mujoco::CameraId() : FindCamera(model, options.camera),
          .width = size.width,
          .height = size.height,
          .samples = options.quality.samples,
          .pictures_per_second = options.pictures_per_second,
          .speed = options.speed};
}

// Returns the number of pictures in the file, which are fewer than the film has if the program was
// interrupted.
int Shoot(film::Film& film, const film::Format& format) {
  Progress progress("filming");
  progress.Tell({0, film.size(), "pictures"});
  const std::unique_ptr<film::MovingPicture> file = film::Begin(format);
  return film::Shoot(film, *file, [&](int drawn) {
    progress.Tell({drawn, film.size(), "pictures"});
    return !Interruption::Requested();
  });
}

ExitCode Shoot(const Options& options, const film::Subject& subject) {
  const film::Settings settings = SettingsOf(options, subject.scene.model());
  film::Film film(subject, settings);
  const Interruption interruption;
  int shot = 0;
  WriteFileBy(options.film, [&](const fs::path& file) {
    shot = Shoot(film, {file, settings.width, settings.height, settings.pictures_per_second});
  });
  std::error_code ignored;
  Print(fmt::format(
      "{}{}: {} pictures in {} kB\n", Interruption::Text(shot, film.size(), "pictures were drawn"),
      options.film.string(), shot, (fs::file_size(options.film, ignored) + 500) / 1000));
  return Interruption::CodeOr(ExitCode::kDone);
}

ExitCode FilmTrace(const Options& options, std::string_view text) {
  const PlannedProblem planned =
      PlanOf({.input = options.input, .plan = options.plan, .models = options.models});
  const execution::Trace trace = ReadTraceOf(planned, text, options.input);
  const scene::Scene scene(planned.problem, planned.simulation.scene);
  return Shoot(options, {planned.problem, planned.result.plan, scene, trace});
}

// Executes the plan once without noise.
ExitCode FilmPlan(const Options& options) {
  const Document document = Document::Load(options.input);
  if (!IsPlanFile(document) && execution::NeedsATree(document)) {
    throw UsageError(fmt::format("film: the plan for {} is a tree; allowed: plans without branches",
                                 Quote(options.input.string())));
  }
  const PlannedProblem planned = ReadOrMakePlan(document, options.models);
  if (planned.result.outcome != Outcome::kFound) {
    Print(Text(planned.problem, planned.result));
    return ExitCodeOf(planned.result.outcome);
  }
  const plan::Plan& plan = planned.result.plan;
  const scene::Scene scene(planned.problem, planned.simulation.scene);
  const check::Trial trial = NoiselessTrial(planned.problem, plan, scene);
  const ExitCode filmed = Shoot(options, {planned.problem, plan, scene, trial.trace});
  const bool done = trial.trace.end().outcome == execution::TrialOutcome::kSucceeded;
  return filmed == ExitCode::kDone && !done ? ExitCode::kFailed : filmed;
}

void RequireFilm(const Options& options) {
  if (!film::IsMovingPicture(options.film)) {
    throw UsageError(
        fmt::format("film: {} is no name of a film; allowed: names that end with "
                    ".webp or .mp4",
                    Quote(options.film.string())));
  }
  if (SizeOf(options.quality).height < film::kLeastHeight) {
    throw UsageError(
        fmt::format("film: --size: allowed: a height of {} or more", film::kLeastHeight));
  }
  RequireWritable(options.film);
}

ExitCode Execute(const Options& options) {
  RequireFilm(options);
  const std::string text =
      ReadInput(options.input, "a scenario file, plan file or trace", kMostTraceBytes);
  return IsTrace(text) ? FilmTrace(options, text) : FilmPlan(options);
}

Execution Declare(CLI::App& command) {
  const auto options = std::make_shared<Options>();
  command
      .add_option("input", options->input,
                  "scenario file or plan file, which is executed once without noise; or a trace")
      ->required();
  command.add_option("-o,--output", options->film, "film to write: .webp, or .mp4 with ffmpeg")
      ->required();
  command.add_option("--plan", options->plan,
                     "plan file of a trace; plan.json beside the trace if left out");
  command
      .add_option("--camera", options->camera,
                  "camera; 'work' stands where it sees the parts and the hand all the time")
      ->capture_default_str();
  AddQualityOptions(command, options->quality);
  command.add_option("--rate", options->pictures_per_second, "pictures in a second of the film")
      ->check(CLI::Range(1.0, 50.0))
      ->capture_default_str();
  command.add_option("--speed", options->speed, "simulated seconds in a second of the film")
      ->check(CLI::Range(0.05, 100.0))
      ->capture_default_str();
  AddModelsOption(command, options->models);
  return [options] { return Execute(*options); };
}

}  // namespace film_verb

const Verb kFilm = {
    .name = "film",
    .summary = "makes a moving picture of an execution, with the steps' names and the time",
    .page = "sim/viewing.md",
    .example =
        "assay film scenarios/spar-fig13.yaml -o out/fig13.webp --speed 4\n"
        "  assay film out/fig13/trace.jsonl -o out/fig13.webp --camera close",
    .declare = film_verb::Declare,
};

}  // namespace assay::cli
