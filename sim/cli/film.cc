#include "sim/cli/film.h"

#include <fmt/format.h>
#include <mujoco/mujoco.h>

#include <CLI/CLI.hpp>
#include <cctype>
#include <charconv>
#include <cmath>
#include <optional>

#include "sim/cli/ghosts.h"
#include "sim/cli/output_file.h"
#include "sim/cli/usage_error.h"

namespace assay::cli {
namespace {

constexpr const char* kContactSheet = "contact-sheet.png";
constexpr int kMostPixels = 4096;  // each way

struct Size {
  int width = 0;
  int height = 0;
};

std::optional<int> ReadPixels(std::string_view text) {
  int pixels = 0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, pixels);
  if (error != std::errc() || rest != end || pixels < 1 || pixels > kMostPixels) return {};
  return pixels;
}

std::optional<Size> ReadSize(std::string_view text) {
  const std::size_t x = text.find('x');
  if (x == std::string_view::npos) return {};
  const std::optional<int> width = ReadPixels(text.substr(0, x));
  const std::optional<int> height = ReadPixels(text.substr(x + 1));
  if (!width || !height) return {};
  return Size{*width, *height};
}

std::string ExplainSize(const std::string& text) {
  if (ReadSize(text)) return "";
  return fmt::format("'{}' is no size; allowed: WIDTHxHEIGHT, each 1 to {}", text, kMostPixels);
}

mujoco::CameraId FindCamera(const mujoco::Model& model, const std::string& name) {
  const mujoco::CameraId camera = model.FindCamera(name);
  if (!camera.IsNone()) return camera;
  std::vector<std::string> names;
  for (int i = 0; i < model.get()->ncam; ++i) names.push_back(model.Name(mujoco::CameraId(i)));
  throw UsageError(
      fmt::format("there is no camera '{}'; allowed: {}", name, fmt::join(names, ", ")));
}

render::Renderer RendererFor(const mujoco::Model& model, const PictureOptions& options) {
  const std::optional<Size> size = ReadSize(options.size);
  if (!size) throw UsageError(ExplainSize(options.size));
  return render::Renderer(model, size->width, size->height, {.samples = options.samples});
}

// "judge-can1-can2" of "judge(can1, can2)".
std::string FileName(const std::string& action) {
  std::string name;
  for (const char c : action) {
    if (c == '(' || c == ',') name += '-';
    if (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_') name += c;
  }
  if (name.ends_with('-')) name.pop_back();  // of an action without arguments
  return name;
}

}  // namespace

void AddPictureOptions(CLI::App& command, PictureOptions& options, const std::string& with) {
  command.add_option("--camera", options.cameras, "cameras; the scenario's if left out");
  command.add_option("--size", options.size, "size of each picture in pixels")
      ->type_name("WIDTHxHEIGHT")
      ->check(CLI::Validator(ExplainSize, "", "size"))
      ->capture_default_str();
  command
      .add_option("--samples", options.samples,
                  "drawn along each side of a pixel: 1 is quick, with jagged edges")
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
      hides_ghosts_(options.hides_ghosts),
      renderer_(RendererFor(subject.scene.model(), options)),
      cameras_(options.cameras.empty() ? cameras_of_scenario : options.cameras) {
  for (const std::string& camera : cameras_) FindCamera(subject.scene.model(), camera);
}

void Film::Take(const std::string& name, const std::string& caption, const mujoco::Data& data,
                std::span<const render::Ghost> ghosts) {
  const std::size_t number = sheet_.size();
  for (const std::string& camera : cameras_) {
    const bool first = camera == cameras_.front();
    const std::string suffix = first ? "" : "-" + camera;
    pictures_.push_back({fmt::format("{:02}-{}{}.png", number, name, suffix),
                         renderer_.Render(data, FindCamera(data.model(), camera), ghosts)});
    if (first) sheet_.push_back({caption, pictures_.back().image});
  }
}

void Film::TakeStart(const mujoco::Data& data) { Take("start", "start", data, {}); }

void Film::TakeStepEnd(const exec::StepEnd& end, const mujoco::Data& data) {
  std::vector<render::Ghost> ghosts;
  if (!hides_ghosts_) ghosts = GhostsAfter(problem_, plan_.step(end.step), end.moment);
  has_ghosts_ = has_ghosts_ || !ghosts.empty();
  Take(end.name, fmt::format("{} {}", sheet_.size(), end.action), data, ghosts);
}

void Film::TakeStepEnd(const std::string& action, const mujoco::Data& data) {
  Take(FileName(action), fmt::format("{} {}", sheet_.size(), action), data, {});
}

void Film::Write(const std::filesystem::path& folder) const {
  if (sheet_.empty()) return;  // interrupted before the start
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
