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
    Meaning{ExitCode::kDone, "done, and everything asked for holds"},
    Meaning{ExitCode::kWrongCommandLine, "wrong command line"},
    Meaning{ExitCode::kWrongInput, "wrong input file"},
    Meaning{ExitCode::kEnvironment, "the environment lacks something (renderer, room on the disk)"},
    Meaning{ExitCode::kNoPlan,
            "proved that there is no plan with the listed robots, actions, grasps and places "
            "(label: no labeling; mate: all sequences tried)"},
    Meaning{ExitCode::kBudgetSpent,
            "no answer: the budget was spent, or a limit of the planner, which the output names, "
            "was met"},
    Meaning{ExitCode::kFailed, "a prediction or check was violated, or a trial failed"},
    Meaning{ExitCode::kInterrupted,
            "interrupted (Ctrl-C); what was done until then is printed and written"},
    Meaning{ExitCode::kTerminated, "the same after SIGTERM or SIGHUP"},
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
