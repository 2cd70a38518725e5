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
  std::vector<std::string> cameras = {};  // empty: the scenario's
  std::string size = "960x720";           // pixels, WIDTHxHEIGHT
};

// Adds --camera and --size.
void AddPictureOptions(CLI::App& command, PictureOptions& options);

// Pictures of one trial: its start and the end point of each step.
class Film {
 public:
  // Throws EnvironmentError if there is no renderer, UsageError if there is no such camera.
  Film(const scene::Scene& scene, const std::vector<std::string>& cameras_of_scenario,
       const PictureOptions& options);

  void TakeStart(const mujoco::Data& data);
  void TakeStepEnd(const exec::StepEnd& end, const mujoco::Data& data);

  // One file for each picture, "02-action_3.png" by the first camera, "02-action_3-close.png" by
  // the others, and contact-sheet.png with those of the first.
  void Write(const std::filesystem::path& folder) const;
  std::vector<std::string> FileNames() const;

 private:
  struct Picture {
    std::string file;
    render::Image image;
  };
  void Take(const std::string& name, const std::string& caption, const mujoco::Data& data);

  render::Renderer renderer_;
  std::vector<std::string> cameras_;
  std::vector<Picture> pictures_;
  std::vector<render::CaptionedImage> sheet_;
};

}  // namespace assay::cli
