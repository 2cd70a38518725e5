#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sim/render/insertion.h"

namespace assay::cli {

// A moment on the way of a step that is worth a picture.
struct Moment {
  std::string name;     // "enters", for files
  std::string caption;  // "peg into block: enters, 2.5 of 25.4 mm"
};

// Which moments of a mating are worth a picture, from when the held part is before the hole: as far
// before the mouth as this is wide, as it enters, half way in, and where it comes to rest. All by
// one camera.
class MatingFilm {
 public:
  // What is referred to must outlive this; `data`: the held part is before the hole.
  MatingFilm(const domain::Problem& problem, const scene::Scene& scene,
             const domain::Mating& mating, const mujoco::Data& data, double aspect);

  const render::FreeCamera& camera() const { return camera_; }

  // The moment that has come, if one has. Each comes once; of several that have come at once, the
  // last.
  std::optional<Moment> Look(const mujoco::Data& data);
  // Where it came to rest: "seated", or "stopped" if farther than a twentieth of its depth from
  // the seat. None if that moment was there already.
  std::optional<Moment> LookAtRest(const mujoco::Data& data);

 private:
  Moment At(const std::string& name, double inserted) const;

  std::string parts_;  // "peg into block", "sleeve onto post"
  render::Insertion insertion_;
  render::FreeCamera camera_;
  std::vector<std::pair<std::string, double>> ahead_;  // moments by their depths, metres
  std::optional<double> rest_;                         // the depth where it was last seen at rest
};

}  // namespace assay::cli
