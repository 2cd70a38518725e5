#pragma once

#include <string>
#include <vector>

#include "sim/execution/commands/action_commands.h"

namespace assay::execution {

// A plan as commands in the order of execution, on the assumption that sensing brings nothing new
// and nothing goes wrong. In Spar's "Experimental Results", each step becomes a function call, and
// the calls are collected in a command file.
struct CommandFile {
  std::vector<StepCommands> steps;
  Command home;  // the last command
};

CommandFile CommandFileOf(const domain::Problem& problem, const plan::Plan& plan);

// Returns one line for each step and, indented, one for each command.
std::string Text(const domain::Problem& problem, const plan::Plan& plan, const CommandFile& file);

}  // namespace assay::execution
