#pragma once

#include "planner/base/input_files/document.h"
#include "planner/domain/problem/problem_file.h"
#include "planner/plan/data/plan.h"
#include "tests/planner/plan/actions.h"

namespace assay::noise {

// Returns the problem of Spar's figure 15: the block lies on its back and the peg on its side.
inline domain::Problem Figure15() {
  return domain::ReadProblem(Document::Load(ASSAY_SOURCE_DIR "/scenarios/spar-fig15.yaml"),
                             ASSAY_SOURCE_DIR "/models");
}

inline constexpr domain::PartId kBlock = domain::PartId(0);
inline constexpr domain::PartId kPeg = domain::PartId(1);

// Returns a plan with one step of each kind. In the order of execution, the camera looks at the
// peg, and the hand squeezes it, takes it, puts it down, takes it again and puts it into the block.
// The steps are inserted in the opposite order.
inline plan::Plan OneOfEachStep(const domain::Problem& problem) {
  const plan::Hold hold{"some", Pose::Identity(), 0.0762};
  const plan::Place place{"initial", problem.part(kPeg).X_WorldPart};
  return {.problem = problem.name,
          .steps = {{"action_1", plan::Assemble(domain::MatingId(0), hold, place), 1, 6},
                    {"action_2", plan::Pickup(kPeg, hold, place), 2, 5},
                    {"action_3", plan::Putdown(kPeg, hold, place), 3, 4},
                    {"action_4", plan::Pickup(kPeg, hold, place), 4, 3},
                    {"action_5", plan::Squeeze(kPeg, hold, place), 5, 2},
                    {"action_6", plan::Sense(kPeg, "overhead-camera", place), 6, 1}}};
}

}  // namespace assay::noise
