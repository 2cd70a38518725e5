#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "planner/base/input_files/quotation.h"
#include "sim/cli/command_line/console.h"
#include "sim/cli/command_line/interruption.h"
#include "sim/cli/command_line/progress.h"
#include "sim/cli/command_line/usage_error.h"
#include "sim/cli/command_line/verb.h"
#include "sim/cli/picture_output/picture_options.h"
#include "sim/cli/shown_executions/request_options.h"
#include "sim/cli/tasks/output_file.h"
#include "sim/film/shoot.h"
#include "sim/scenario/scenario.h"

namespace assay::cli {
namespace film_verb {

namespace fs = std::filesystem;

struct Options {
  ShowRequest request = {.needs_claims = false};
  fs::path film;
  std::string camera = scenario::kWorkCamera;
  PictureQuality quality;
  double pictures_per_second = 10;
  double speed = 2;
};

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

// Returns the actions of an execution that did not follow one plan.
std::optional<std::vector<film::Walked>> WalkedIn(const ShownExecution& shown) {
  if (!shown.way) return std::nullopt;
  std::vector<film::Walked> walked;
  for (const view::WalkedAction& action : shown.way->actions) {
    walked.push_back({action.action, action.end});
  }
  return walked;
}

std::string EndOf(const ShownExecution& shown) {
  return shown.reason.empty() ? "done" : fmt::format("{}: {}", shown.outcome, shown.reason);
}

// Prints why there is nothing to film.
ExitCode Refuse(const ShownExecution& shown) {
  Print(shown.outcome + "\n");
  for (const view::Reasons& reasons : shown.why_not) {
    Print(fmt::format("{}:\n  {}\n", reasons.title, fmt::join(TextsOf(reasons.reasons), "\n  ")));
  }
  return shown.code;
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
  const ShownExecution shown = ExecutionOf(options.request);
  if (!shown.why_not.empty()) return Refuse(shown);
  const scene::Scene scene(shown.problem, shown.scene);
  const ExitCode filmed = Shoot(
      options, {shown.problem, shown.plan, scene, shown.trace, EndOf(shown), WalkedIn(shown)});
  return filmed == ExitCode::kDone ? shown.code : filmed;
}

Execution Declare(CLI::App& command) {
  const auto options = std::make_shared<Options>();
  AddShowOptions(command, options->request);
  command
      .add_option("-o,--output", options->film,
                  "file for the film, which ends with .webp, or with .mp4 if ffmpeg is installed")
      ->required();
  command
      .add_option("--camera", options->camera,
                  "name of the camera; 'work' stands still where it sees the parts and the hand "
                  "all the time")
      ->capture_default_str();
  AddQualityOptions(command, options->quality);
  command.add_option("--rate", options->pictures_per_second, "pictures in a second of the film")
      ->check(CLI::Range(1.0, 50.0))
      ->capture_default_str();
  command.add_option("--speed", options->speed, "simulated seconds in a second of the film")
      ->check(CLI::Range(0.05, 100.0))
      ->capture_default_str();
  return [options] { return Execute(*options); };
}

}  // namespace film_verb

const Verb kFilm = {
    .name = "film",
    .summary = "makes a moving picture of an execution, with the names of the steps and the time",
    .page = "sim/viewing.md",
    .example =
        "assay film scenarios/spar-fig13.yaml -o out/fig13.webp --speed 4\n"
        "  assay film fig15.sqlite 17 -o out/trial-17.webp --camera close",
    .declare = film_verb::Declare,
};

}  // namespace assay::cli
