#pragma once

#include <string>

#include "sim/cli/command_line/exit_code.h"

namespace assay::cli {

// While an object of this class lives, SIGINT, SIGTERM and SIGHUP (a key, a cluster's time limit, a
// closed terminal) do not end the program. The first one is recorded and requests a stop
// (planner/base/stop.h): executions and searches under way throw Stopped, so that the results so
// far can be printed and written soon. The second signal ends the program. Signals that were
// ignored before (nohup) stay ignored. Only one object may live at a time. What prints and writes
// the results must not call StopIfRequested.
class Interruption {
 public:
  Interruption();
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  // Returns whether an interruption was requested. May be called from any thread.
  static bool Requested();

  // Returns `code`, or the exit code of the signal if the program was interrupted.
  static ExitCode CodeOr(ExitCode code);
  // Returns "interrupted: 3 of 20 trials were made\n", or an empty text if there was no
  // interruption.
  static std::string Text(long long made, long long wanted, const char* done = "trials were made");
};

}  // namespace assay::cli
