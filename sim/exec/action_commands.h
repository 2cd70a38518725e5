#pragma once

#include <vector>

#include "sim/exec/command.h"

namespace assay::exec {

// The commands of each kind of action: move above, straight line down, act, and up again (Spar,
// figure 18). Straight lines down and up are vertical; the last piece to a part and the first away
// from it are along the tool's axis, as long as the workcell's approach distance.
std::vector<Command> CommandsFor(const domain::Problem& problem, const plan::Pickup& pickup);
std::vector<Command> CommandsFor(const domain::Problem& problem, const plan::Putdown& putdown);
std::vector<Command> CommandsFor(const domain::Problem& problem, const plan::Assemble& assemble);
// The arm first goes to its home, so that it hangs over no part that does not lie there.
std::vector<Command> CommandsFor(const domain::Problem& problem, const plan::Sense& sense);
// Closes on the part as a pickup does, and lets it go where it is.
std::vector<Command> CommandsFor(const domain::Problem& problem, const plan::Squeeze& squeeze);

// A part that is put down or mated is let go this high, in metres, above where it will be: the
// hand, which gives way under the weight of what it holds, must not press it into anything.
inline constexpr double kReleaseHeight = 0.0001;

// Where the tool is while the arm is at home.
Pose HomeTool(const domain::Workcell& workcell);
// The tool drawn back along its axis by the workcell's approach distance.
Pose Retreated(const domain::Workcell& workcell, const Pose& X_WorldTool);
// The tool straight above, at safe height or where it is if that is higher.
Pose AtSafeHeight(const domain::Workcell& workcell, const Pose& X_WorldTool);

}  // namespace assay::exec
