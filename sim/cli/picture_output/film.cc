#include "sim/cli/picture_output/film.h"

#include <fmt/format.h>
#include <mujoco/mujoco.h>

#include <CLI/CLI.hpp>
#include <cctype>
#include <charconv>
#include <cmath>
#include <optional>
#include <set>

#include "planner/plan/data/tool_route.h"
#include "sim/cli/command_line/usage_error.h"
#include "sim/cli/picture_output/ghosts.h"
#include "sim/cli/tasks/output_file.h"
#include "sim/render/picture.h"
#include "sim/render/work_view.h"
#include "sim/scenario/scenario.h"

namespace assay::cli {
namespace {

constexpr const char* kContactSheet = "contact-sheet.png";
constexpr int kMostPixels = 4096;  // in each direction

std::optional<int> ReadPixels(std::string_view text) {
  int pixels = 0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, pixels);
  if (error != std::errc() || rest != end || pixels < 1 || pixels > kMostPixels) return {};
  return pixels;
}

std::optional<PictureSize> ReadSize(std::string_view text) {
  const std::size_t x = text.find('x');
  if (x == std::string_view::npos) return {};
  const std::optional<int> width = ReadPixels(text.substr(0, x));
  const std::optional<int> height = ReadPixels(text.substr(x + 1));
  if (!width || !height) return {};
  return PictureSize{*width, *height};
}

std::string ExplainSize(const std::string& text) {
  if (ReadSize(text)) return "";
  return fmt::format("'{}' is no size; allowed: WIDTHxHEIGHT, each 1 to {}", text, kMostPixels);
}

mujoco::CameraId FindCamera(const mujoco::Model& model, const std::string& name) {
  const mujoco::CameraId camera = model.FindCamera(name);
  if (!camera.IsNone()) return camera;
  std::vector<std::string> names = {scenario::kWorkCamera};
  for (int i = 0; i < model.get()->ncam; ++i) names.push_back(model.Name(mujoco::CameraId(i)));
  throw UsageError(
      fmt::format("there is no camera '{}'; allowed: {}", name, fmt::join(names, ", ")));
}

PictureSize SizeOf(const PictureOptions& options) {
  const std::optional<PictureSize> size = ReadSize(options.size);
  if (!size) throw UsageError(ExplainSize(options.size));
  return *size;
}

// Returns the parts that the plan's actions are about, or all parts if there is no plan.
std::vector<domain::PartId> WorkedParts(const domain::Problem& problem, const plan::Plan& plan) {
  std::set<domain::PartId> parts;
  for (const plan::PlannedStep& step : plan.steps) {
    for (const domain::PartId part : PartsOf(problem, step.action)) parts.insert(part);
  }
  for (std::size_t i = 0; i < problem.parts.size() && plan.steps.empty(); ++i) {
    parts.insert(domain::PartId(i));
  }
  return {parts.begin(), parts.end()};
}

// Returns "judge-can1-can2" for "judge(can1, can2)".
std::string FileName(const std::string& action) {
  std::string name;
  for (const char c : action) {
    if (c == '(' || c == ',') name += '-';
    if (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_') name += c;
  }
  if (name.ends_with('-')) name.pop_back();  // for an action without arguments
  return name;
}

}  // namespace

void AddPictureOptions(CLI::App& command, PictureOptions& options, const std::string& with) {
  command.add_option("--camera", options.cameras,
                     "cameras; the scenario's if left out; 'work' follows the hand and the parts");
  command.add_option("--size", options.size, "size of each picture in pixels")
      ->type_name("WIDTHxHEIGHT")
      ->check(CLI::Validator(ExplainSize, "", "size"))
      ->capture_default_str();
  command
      .add_option("--samples", options.samples,
                  "samples along each side of a pixel: 1 is quick, with jagged edges")
      ->check(CLI::Range(1, render::kMostSamples))
      ->capture_default_str();
  command.add_flag("--no-ghosts", options.hides_ghosts,
                   "leave out the ghosts: parts at the extremes of their predicted error sets");
  if (with.empty()) return;
  for (const char* name : {"--camera", "--size", "--samples", "--no-ghosts"}) {
    command.get_option(name)->needs(command.get_option(with));
  }
}

Film::Film(const FilmSubject& subject, const std::vector<std::string>& cameras_of_scenario,
           const PictureOptions& options)
    : problem_(subject.problem),
      plan_(subject.plan),
      scene_(subject.scene),
      hides_ghosts_(options.hides_ghosts),
      size_(SizeOf(options)),
      renderer_(scene_.model(), size_.width, size_.height, {.samples = options.samples}),
      cameras_(options.cameras.empty() ? cameras_of_scenario : options.cameras),
      worked_(WorkedParts(problem_, plan_)) {
  for (const std::string& camera : cameras_) {
    if (camera != scenario::kWorkCamera) FindCamera(scene_.model(), camera);
  }
}

render::Image Film::Shot(const std::string& camera, const mujoco::Data& data,
                         std::span<const render::Ghost> ghosts) {
  if (camera != scenario::kWorkCamera) {
    return renderer_.Render(data, FindCamera(data.model(), camera), ghosts);
  }
  return renderer_.Render(data, render::WorkView(problem_, scene_, worked_, data, size_.aspect()),
                          ghosts);
}

void Film::Take(const std::string& name, const std::string& caption, const mujoco::Data& data,
                std::span<const render::Ghost> ghosts) {
  for (const std::string& camera : cameras_) {
    const bool first = camera == cameras_.front();
    const std::string suffix = first ? "" : "-" + camera;
    pictures_.push_back(
        {fmt::format("{:02}-{}{}.png", ended_, name, suffix), Shot(camera, data, ghosts)});
    if (first) sheet_.push_back({caption, pictures_.back().image});
  }
  close_ups_ = 0;
}

void Film::SeeStart(const mujoco::Data& data) { Take("start", "start", data, {}); }

void Film::TakeStepEnd(const std::string& action, const mujoco::Data& data) {
  ++ended_;
  Take(FileName(action), fmt::format("{} {}", ended_, action), data, {});
}

void Film::TakeCloseUp(const plan::PlannedStep& step, const Snapshot& moment,
                       const render::FreeCamera& camera, const mujoco::Data& data) {
  const int number = ended_ + 1;
  pictures_.push_back(
      {fmt::format("{:02}-{}-{}-{}.png", number, step.name, ++close_ups_, moment.name),
       renderer_.Render(data, camera)});
  sheet_.push_back({fmt::format("{} {}", number, moment.caption), pictures_.back().image});
}

void Film::TakeGrasp(const plan::PlannedStep& step, const mujoco::Data& data) {
  const domain::PartId part = plan::PlacedPart(problem_, step.action);
  const render::FreeCamera camera = render::CloseUp(render::GraspOf(problem_, scene_, part, data),
                                                    render::Sight(data), size_.aspect());
  const std::string caption = fmt::format("pads closed on {}", problem_.part(part).name);
  TakeCloseUp(step, {"closed", caption}, camera, data);
}

void Film::TakeMating(const std::optional<Snapshot>& moment, const mujoco::Data& data) {
  if (moment) TakeCloseUp(plan_.step(mating_step_), *moment, mating_->camera(), data);
}

void Film::SeeTimestep(const mujoco::Data& data) {
  if (mating_) TakeMating(mating_->Look(data), data);
}

void Film::SeeMilestone(const execution::Milestone& milestone, const mujoco::Data& data) {
  const plan::PlannedStep& step = plan_.step(milestone.step);
  const bool acted = milestone.stage == execution::Stage::kActed;
  if (const domain::MatingId mating = step.action.mating; !mating.IsNone()) {
    if (acted) TakeMating(mating_->LookAtRest(data), data);
    if (milestone.stage != execution::Stage::kPoised) return;
    mating_.emplace(problem_, scene_, problem_.mating(mating), data, size_.aspect());
    mating_step_ = milestone.step;
    return;
  }
  if (acted && step.action.kind->ClosesPads()) TakeGrasp(step, data);
}

void Film::SeeStepEnd(const execution::StepEnd& end, const mujoco::Data& data) {
  // After a recovery the part rests in another place than before.
  if (mating_) TakeMating(mating_->LookAtRest(data), data);
  mating_.reset();
  ++ended_;
  std::vector<render::Ghost> ghosts;
  if (!hides_ghosts_) ghosts = GhostsAfter(problem_, plan_.step(end.step), end.moment);
  has_ghosts_ = has_ghosts_ || !ghosts.empty();
  Take(end.name, fmt::format("{} {}", ended_, end.action), data, ghosts);
}

void Film::Write(const std::filesystem::path& folder) const {
  if (sheet_.empty()) return;  // if interrupted before the start
  for (const Picture& picture : pictures_) {
    WriteFile(folder / picture.file, render::EncodedPng(picture.image));
  }
  const int columns = static_cast<int>(std::ceil(std::sqrt(static_cast<double>(sheet_.size()))));
  std::vector<render::LegendEntry> legend;
  if (has_ghosts_) legend.push_back({render::kPredicted, "ghosts: predicted error set"});
  WriteFile(folder / kContactSheet,
            render::EncodedPng(render::ContactSheet(sheet_, columns, legend)));
}

std::vector<std::string> Film::FileNames() const {
  std::vector<std::string> names;
  for (const Picture& picture : pictures_) names.push_back(picture.file);
  names.push_back(kContactSheet);
  return names;
}

}  // namespace assay::cli
