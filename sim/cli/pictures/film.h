#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "planner/domain/problem/problem.h"
#include "planner/plan/data/plan.h"
#include "sim/cli/pictures/mating_film.h"
#include "sim/exec/execution/executor.h"
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

// Pixels.
struct PictureSize {
  int width = 0;
  int height = 0;

  double aspect() const { return static_cast<double>(width) / height; }
};

// Pictures of one trial: its start and the end of each step, there with the error sets that the
// step's certificate predicts, as ghosts; and on the way close-ups of what the hand does: pads that
// have closed on a part, and matings (MatingFilm).
class Film : public exec::Observer {
 public:
  // Throws EnvironmentError if there is no renderer, UsageError if there is no such camera. What
  // the subject refers to must outlive the film.
  Film(const FilmSubject& subject, const std::vector<std::string>& cameras_of_scenario,
       const PictureOptions& options);

  void TakeStart(const mujoco::Data& data);
  // The end of a step that no plan knows: "grasp(can1)".
  void TakeStepEnd(const std::string& action, const mujoco::Data& data);

  void SeeTimestep(const mujoco::Data& data) override;
  void SeeMilestone(const exec::Milestone& milestone, const mujoco::Data& data) override;
  void SeeStepEnd(const exec::StepEnd& end, const mujoco::Data& data) override;

  // One file for each picture: of the second step's close-ups "02-action_3-1-before.png" and so on,
  // of its end "02-action_3.png" by the first camera, "02-action_3-top.png" by others; and
  // contact-sheet.png with the close-ups and what the first camera took.
  void Write(const std::filesystem::path& folder) const;
  std::vector<std::string> FileNames() const;

 private:
  struct Picture {
    std::string file;
    render::Image image;
  };
  render::Image Shot(const std::string& camera, const mujoco::Data& data,
                     std::span<const render::Ghost> ghosts);
  void Take(const std::string& name, const std::string& caption, const mujoco::Data& data,
            std::span<const render::Ghost> ghosts);
  void TakeCloseUp(const plan::PlannedStep& step, const Moment& moment,
                   const render::FreeCamera& camera, const mujoco::Data& data);
  void TakeGrasp(const plan::PlannedStep& step, const mujoco::Data& data);
  void TakeMating(const std::optional<Moment>& moment, const mujoco::Data& data);

  const domain::Problem& problem_;
  const plan::Plan& plan_;
  const scene::Scene& scene_;
  const bool hides_ghosts_;
  const PictureSize size_;
  bool has_ghosts_ = false;
  render::Renderer renderer_;
  std::vector<std::string> cameras_;
  std::vector<domain::PartId> worked_;  // parts that the camera shows that follows the work
  int ended_ = 0;                       // steps
  int close_ups_ = 0;                   // of the present step
  std::optional<MatingFilm> mating_;    // on its way
  plan::StepId mating_step_;
  std::vector<Picture> pictures_;
  std::vector<render::CaptionedImage> sheet_;
};

}  // namespace assay::cli
