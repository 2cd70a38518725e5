#include "sim/exec/action_commands.h"

namespace assay::exec {

StepCommands CommandsFor(const domain::Problem& problem, const WorldModel&,
                         const plan::Sense& sense) {
  return {.approach = {MoveAtSafeHeight{HomeTool(*problem.workcell)}},
          .act = {Look{sense.part, sense.sensor}}};
}

}  // namespace assay::exec
