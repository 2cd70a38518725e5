#include "sim/cli/picture_output/ghosts.h"

#include "sim/check/trial_verdicts/extreme_poses.h"

namespace assay::cli {

std::vector<render::Ghost> GhostsAfter(const domain::Problem& problem,
                                       const plan::PlannedStep& step,
                                       const execution::Snapshot& snapshot) {
  std::vector<render::Ghost> ghosts;
  for (const plan::ErrorSet& set : step.certificate.after) {
    for (const geometry::Pose& pose : check::ExtremePoses(step.action, set, snapshot)) {
      ghosts.push_back(render::GhostOf(*problem.part(set.part).model, pose, render::kPredicted));
    }
  }
  return ghosts;
}

}  // namespace assay::cli
