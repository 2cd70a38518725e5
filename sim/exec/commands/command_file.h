#pragma once

#include <string>
#include <vector>

#include "sim/exec/commands/action_commands.h"

namespace assay::exec {

// A plan as the robot is told to execute it, in the order of execution (Spar, "Experimental
// Results": each step becomes a function call, the calls are collected in a command file), if
// sensing tells nothing new and nothing goes wrong.
struct CommandFile {
  std::vector<StepCommands> steps;
  Command home;  // at the end
};

CommandFile CommandFileOf(const domain::Problem& problem, const plan::Plan& plan);

// One line for each step and, indented, for each command.
std::string Text(const domain::Problem& problem, const plan::Plan& plan, const CommandFile& file);

// "pickup(block, BG3)".
std::string Text(const domain::Problem& problem, const plan::Action& action);

}  // namespace assay::exec
