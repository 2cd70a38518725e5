#pragma once

#include <vector>

#include "sim/render/renderer.h"
#include "sim/scene/scene.h"
#include "sim/sense/placement_search.h"
#include "sim/sense/view.h"

namespace assay::sense {

using domain::PartId;

// What an eye saw.
struct Sight {
  View view;
  render::Image image;
};

// The eyes of the workcell's "overhead-camera", above the table's corners (the scene's cameras
// "overhead-eye-1" and so on). They turn to where a part is believed to be and zoom in on it, so
// that it is in the picture wherever in the search window it is. They belong to the thread that
// made them, as their renderer does.
class OverheadEyes {
 public:
  // Throws EnvironmentError if nothing renders on this machine. Scene and problem must outlive it.
  OverheadEyes(const scene::Scene& scene, const domain::Problem& problem,
               const SearchWindow& window);

  // One sight for each eye.
  std::vector<Sight> LookAt(const mujoco::Data& data, PartId part, const Pose& believed);

 private:
  const domain::Problem& problem_;
  SearchWindow window_;
  std::vector<Vector3> eyes_;
  render::Renderer renderer_;
};

}  // namespace assay::sense
