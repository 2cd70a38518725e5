#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sim/exec/trace.h"
#include "sim/render/image.h"
#include "sim/render/renderer.h"
#include "sim/scene/scene.h"

namespace CLI {
class App;
}

namespace assay::cli {

// How pictures are taken.
struct PictureOptions {
  std::string camera = "overview";
  std::string size = "960x720";  // pixels, WIDTHxHEIGHT
};

// Adds --camera and --size.
void AddPictureOptions(CLI::App& command, PictureOptions& options);

// Pictures of one trial: its start and the end point of each step.
class Film {
 public:
  // Throws EnvironmentError if there is no renderer, UsageError if there is no such camera.
  Film(const scene::Scene& scene, const PictureOptions& options);

  void TakeStart(const mujoco::Data& data);
  void TakeStepEnd(const exec::StepEnd& end, const mujoco::Data& data);

  // One file for each picture, "02-action_3.png", and contact-sheet.png.
  void Write(const std::filesystem::path& folder) const;
  int size() const { return static_cast<int>(pictures_.size()); }

 private:
  struct Picture {
    std::string name;
    render::CaptionedImage captioned;
  };
  void Take(std::string name, std::string caption, const mujoco::Data& data);

  render::Renderer renderer_;
  mujoco::CameraId camera_;
  std::vector<Picture> pictures_;
};

}  // namespace assay::cli
