#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sim/render/insertion.h"

namespace assay::cli {

// An event during a step that is worth a picture.
struct Snapshot {
  std::string name;     // "enters"; for file names
  std::string caption;  // "peg into block: enters, 2.5 of 25.4 mm"
};

// Selects the events of a mating that are worth a picture: the shaft is as far before the mouth as
// the mouth is wide, the shaft enters, it is half inserted, and it comes to rest. One camera shows
// all these events. An object of this class is made while the held part is before the hole.
class MatingMoments {
 public:
  // The arguments must outlive the object. In `data` the held part must be before the hole.
  MatingMoments(const domain::Problem& problem, const scene::Scene& scene,
                const domain::Mating& mating, const mujoco::Data& data, double aspect);

  const render::FreeCamera& camera() const { return camera_; }

  // Returns the event that has just happened, if any. Each event is returned once. If several
  // events have happened at once, the last one is returned.
  std::optional<Snapshot> Look(const mujoco::Data& data);
  // Returns the event at rest: "seated", or "stopped" if the part is farther than a twentieth of
  // its depth from the seat. Returns nothing if that event was returned before.
  std::optional<Snapshot> LookAtRest(const mujoco::Data& data);

 private:
  Snapshot At(const std::string& name, double inserted) const;

  std::string parts_;  // "peg into block", "sleeve onto post"
  render::Insertion insertion_;
  render::FreeCamera camera_;
  std::vector<std::pair<std::string, double>> ahead_;  // events to come by their depths, metres
  std::optional<double> rest_;                         // depth where the part was last seen at rest
};

}  // namespace assay::cli
