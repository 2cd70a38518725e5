#pragma once

#include <functional>
#include <span>

#include "sim/cli/command_line/exit_code.h"

namespace CLI {
class App;
}

namespace assay::cli {

// The work of a verb after its arguments have been read.
using Execution = std::function<ExitCode()>;

// A verb of the command line: `assay NAME ...`. Each verb has a file of its name, with its options
// and its work.
struct Verb {
  const char* name;
  const char* summary;                      // one line
  const char* page;                         // page of the manual, by its path in the repository
  const char* example;                      // command lines for the help
  Execution (*declare)(CLI::App& command);  // adds the verb's arguments to the command
};

extern const Verb kBound;
extern const Verb kBudget;
extern const Verb kCalibrate;
extern const Verb kCheck;
extern const Verb kContingent;
extern const Verb kCompletion;
extern const Verb kDoctor;
extern const Verb kExport;
extern const Verb kFilm;
extern const Verb kImport;
extern const Verb kInit;
extern const Verb kLabel;
extern const Verb kList;
extern const Verb kMate;
extern const Verb kPlan;
extern const Verb kRender;
extern const Verb kReplay;
extern const Verb kReport;
extern const Verb kRun;
extern const Verb kSweep;
extern const Verb kTune;
extern const Verb kView;

std::span<const Verb* const> Verbs();  // in the order of the help

}  // namespace assay::cli
