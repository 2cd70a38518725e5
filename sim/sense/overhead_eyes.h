#pragma once

#include <vector>

#include "sim/render/renderer.h"
#include "sim/scene/scene.h"
#include "sim/sense/fitting/placement_search.h"
#include "sim/sense/view.h"

namespace assay::sense {

using domain::PartId;

// A picture that an eye took, and its view.
struct Sight {
  View view;
  render::Image image;
};

// The eyes of the workcell's "overhead-camera" above the table's corners (the scene's cameras
// "overhead-eye-1" to "overhead-eye-4"). They turn towards a part's believed pose and zoom until
// their pictures show the part wherever it is in the search window. The eyes must be used by the
// thread that made them, because their renderer belongs to that thread.
class OverheadEyes {
 public:
  // Throws EnvironmentError if nothing renders on this machine. Scene and problem must outlive it.
  OverheadEyes(const scene::Scene& scene, const domain::Problem& problem,
               const SearchWindow& window);

  // Returns the sight of each eye at a part's believed pose.
  std::vector<Sight> LookAt(const mujoco::Data& data, PartId part, const Pose& believed);

 private:
  const domain::Problem& problem_;
  SearchWindow window_;
  std::vector<Vector3> eyes_;
  render::Renderer renderer_;
};

}  // namespace assay::sense
