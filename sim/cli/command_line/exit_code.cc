#include "sim/cli/command_line/exit_code.h"

#include <fmt/format.h>

#include <array>

namespace assay::cli {
namespace {

struct Meaning {
  ExitCode code;
  const char* text;
};

constexpr std::array kMeanings = {
    Meaning{ExitCode::kDone, "the command has succeeded, and all its checks hold"},
    Meaning{ExitCode::kWrongCommandLine, "the command line is wrong"},
    Meaning{ExitCode::kWrongInput, "an input file is wrong"},
    Meaning{ExitCode::kEnvironment,
            "the environment lacks something, for example a renderer or room on the disk"},
    Meaning{ExitCode::kNoPlan,
            "it is proved that there is no plan with the listed robots, actions, grasps and places "
            "(label: no labeling; mate: no strategy among all sequences)"},
    Meaning{ExitCode::kBudgetSpent,
            "there is no answer: the budget was spent, or the planner met a limit, which the "
            "output names"},
    Meaning{ExitCode::kFailed, "a check was violated, or a trial failed"},
    Meaning{ExitCode::kInterrupted,
            "Ctrl-C interrupted the command; finished trials, attempts and plans are printed and "
            "written"},
    Meaning{ExitCode::kTerminated, "SIGTERM or SIGHUP interrupted the command"},
};

}  // namespace

ExitCode ExitCodeOf(Outcome outcome) {
  switch (outcome) {
    case Outcome::kFound:
      return ExitCode::kDone;
    case Outcome::kNone:
      return ExitCode::kNoPlan;
    case Outcome::kBudget:
      return ExitCode::kBudgetSpent;
  }
  return ExitCode::kDone;
}

std::string ExitCodeTable() {
  std::string text = "Exit codes:\n";
  for (const Meaning& meaning : kMeanings) {
    text += fmt::format(" {:3}  {}\n", static_cast<int>(meaning.code), meaning.text);
  }
  return text;
}

}  // namespace assay::cli
