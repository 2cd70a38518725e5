#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "planner/domain/problem.h"
#include "planner/plan/plan.h"
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
  int samples = 2;                        // along each side of a pixel
  bool hides_ghosts = false;              // of the predicted error sets
};

// Adds --camera, --size, --samples and --no-ghosts. `with`: an option of the command without which
// there are no pictures; empty: there always are.
void AddPictureOptions(CLI::App& command, PictureOptions& options, const std::string& with = "");

// What is executed, and where.
struct FilmSubject {
  const domain::Problem& problem;
  const plan::Plan& plan;
  const scene::Scene& scene;
};

// Pictures of one trial: its start and the end point of each step, there with the error sets that
// the step's certificate predicts, as ghosts.
class Film {
 public:
  // Throws EnvironmentError if there is no renderer, UsageError if there is no such camera. Problem
  // and plan must outlive the film.
  Film(const FilmSubject& subject, const std::vector<std::string>& cameras_of_scenario,
       const PictureOptions& options);

  void TakeStart(const mujoco::Data& data);
  void TakeStepEnd(const exec::StepEnd& end, const mujoco::Data& data);
  // The end of a step that no plan knows: "grasp(can1)".
  void TakeStepEnd(const std::string& action, const mujoco::Data& data);

  // One file for each picture, "02-action_3.png" by the first camera, "02-action_3-close.png" by
  // the others, and contact-sheet.png with those of the first.
  void Write(const std::filesystem::path& folder) const;
  std::vector<std::string> FileNames() const;

 private:
  struct Picture {
    std::string file;
    render::Image image;
  };
  void Take(const std::string& name, const std::string& caption, const mujoco::Data& data,
            std::span<const render::Ghost> ghosts);

  const domain::Problem& problem_;
  const plan::Plan& plan_;
  const bool hides_ghosts_;
  bool has_ghosts_ = false;
  render::Renderer renderer_;
  std::vector<std::string> cameras_;
  std::vector<Picture> pictures_;
  std::vector<render::CaptionedImage> sheet_;
};

}  // namespace assay::cli
