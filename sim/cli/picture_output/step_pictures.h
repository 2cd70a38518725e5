#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "planner/domain/problem/problem.h"
#include "planner/plan/data/plan.h"
#include "sim/cli/picture_output/mating_moments.h"
#include "sim/cli/picture_output/picture_options.h"
#include "sim/execution/walk/executor.h"
#include "sim/render/image.h"
#include "sim/render/renderer.h"
#include "sim/scene/scene.h"

namespace assay::cli {

// The plan that is executed, and its scene.
struct PicturedPlan {
  const domain::Problem& problem;
  const plan::Plan& plan;
  const scene::Scene& scene;
};

// Takes the pictures of one trial: its start and the end of each step. The picture of a step's end
// shows the error sets that the step's certificate predicts, as ghosts. Close-ups show what the
// hand does on the way: pads that have closed on a part, and matings (MatingMoments).
class StepPictures : public execution::Observer {
 public:
  // Throws EnvironmentError if there is no renderer, and UsageError if there is no such camera. The
  // objects that `subject` refers to must outlive the pictures.
  StepPictures(const PicturedPlan& subject, const std::vector<std::string>& cameras_of_scenario,
               const PictureOptions& options);

  // Takes a picture of the end of an action that is not in the plan: "grasp(can1)".
  void TakeStepEnd(const std::string& action, const mujoco::Data& data);

  void SeeStart(const mujoco::Data& data) override;
  void SeeTimestep(const mujoco::Data& data) override;
  void SeeMilestone(const execution::Milestone& milestone, const mujoco::Data& data) override;
  void SeeStepEnd(const execution::StepEnd& end, const mujoco::Data& data) override;

  // Writes one file for each picture. The second step's close-ups are "02-action_3-1-before.png"
  // and so on. Its end is "02-action_3.png" by the first camera and "02-action_3-top.png" by
  // others. contact-sheet.png shows the close-ups and the first camera's pictures.
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
  void TakeCloseUp(const plan::PlannedStep& step, const Snapshot& snapshot,
                   const render::FreeCamera& camera, const mujoco::Data& data);
  void TakeGrasp(const plan::PlannedStep& step, const mujoco::Data& data);
  void TakeMating(const std::optional<Snapshot>& snapshot, const mujoco::Data& data);

  const domain::Problem& problem_;
  const plan::Plan& plan_;
  const scene::Scene& scene_;
  const bool hides_ghosts_;
  const PictureSize size_;
  bool has_ghosts_ = false;
  render::Renderer renderer_;
  std::vector<std::string> cameras_;
  std::vector<domain::PartId> worked_;   // parts shown by the camera that follows the work
  int ended_ = 0;                        // number of steps that have ended
  int close_ups_ = 0;                    // number of close-ups in the present step
  std::optional<MatingMoments> mating_;  // the mating in progress
  plan::StepId mating_step_;
  std::vector<Picture> pictures_;
  std::vector<render::CaptionedImage> sheet_;
};

}  // namespace assay::cli
