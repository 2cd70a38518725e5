#include "sim/exec/action_commands.h"

namespace assay::exec {

std::vector<Command> CommandsFor(const domain::Problem& problem, const plan::Sense& sense) {
  return {MoveAtSafeHeight{HomeTool(*problem.workcell)}, Look{sense.part, sense.sensor}};
}

}  // namespace assay::exec
