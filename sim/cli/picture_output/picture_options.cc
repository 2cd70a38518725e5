#include "sim/cli/picture_output/picture_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <mujoco/mujoco.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <optional>
#include <string_view>

#include "sim/cli/command_line/usage_error.h"
#include "sim/render/renderer.h"
#include "sim/scenario/scenario.h"

namespace assay::cli {
namespace {

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

}  // namespace

void AddQualityOptions(CLI::App& command, PictureQuality& quality) {
  command.add_option("--size", quality.size, "size of each picture in pixels")
      ->type_name("WIDTHxHEIGHT")
      ->check(CLI::Validator(ExplainSize, "", "size"))
      ->capture_default_str();
  command
      .add_option("--samples", quality.samples,
                  "samples along each side of a pixel: 1 is quick, with jagged edges")
      ->check(CLI::Range(1, render::kMostSamples))
      ->capture_default_str();
}

void AddPictureOptions(CLI::App& command, PictureOptions& options, const std::string& with) {
  command.add_option(
      "--camera", options.cameras,
      "names of cameras; those of the scenario if left out; 'work' follows the hand and the parts");
  AddQualityOptions(command, options.quality);
  command.add_flag("--no-ghosts", options.hides_ghosts,
                   "leave out the ghosts: parts at the extremes of their predicted error sets");
  if (with.empty()) return;
  for (const char* name : {"--camera", "--size", "--samples", "--no-ghosts"}) {
    command.get_option(name)->needs(command.get_option(with));
  }
}

PictureSize SizeOf(const PictureQuality& quality) {
  const std::optional<PictureSize> size = ReadSize(quality.size);
  if (!size) throw UsageError(ExplainSize(quality.size));
  return *size;
}

mujoco::CameraId FindCamera(const mujoco::Model& model, const std::string& name) {
  const mujoco::CameraId camera = model.FindCamera(name);
  if (!camera.IsNone()) return camera;
  std::vector<std::string> names = {scenario::kWorkCamera};
  for (int i = 0; i < model.get()->ncam; ++i) names.push_back(model.Name(mujoco::CameraId(i)));
  throw UsageError(
      fmt::format("there is no camera '{}'; allowed: {}", name, fmt::join(names, ", ")));
}

}  // namespace assay::cli
