#pragma once

#include <pybind11/pybind11.h>

#include <optional>

#include "planner/base/stop.h"

namespace assay::python {

// While an object of this class lives, Ctrl-C requests a stop (planner/base/stop.h) and also calls
// Python's own handler. Objects may live in several threads at once.
class StopOnInterrupt {
 public:
  StopOnInterrupt();
  ~StopOnInterrupt();
  StopOnInterrupt(const StopOnInterrupt&) = delete;
  StopOnInterrupt& operator=(const StopOnInterrupt&) = delete;
};

// Returns whether Ctrl-C was pressed, and clears Python's record of it. Throws the exception that
// another handler of the signal raises.
bool TakeInterrupt();
[[noreturn]] void RaiseKeyboardInterrupt();

// The result of work during which Ctrl-C may have been pressed. After Ctrl-C, the result has what
// was finished until then.
template <class Result>
struct Interruptible {
  std::optional<Result> result = {};
  bool is_interrupted = false;
};

// Returns the result of the work, during which other threads of Python run. Ctrl-C requests a stop.
// If the work throws Stopped because it has no result yet, KeyboardInterrupt is raised.
template <class Work>
auto UnlockedUntilStopped(const Work& work) {
  Interruptible<decltype(work())> made;
  {
    const pybind11::gil_scoped_release release;
    const StopOnInterrupt stop;
    try {
      made.result.emplace(work());
    } catch (const Stopped&) {
    }
    made.is_interrupted = stop_requested;
  }
  if (TakeInterrupt()) made.is_interrupted = true;
  if (!made.result) RaiseKeyboardInterrupt();
  return made;
}

// Does the same for work whose result is of no use if a stop was requested: KeyboardInterrupt is
// raised then.
template <class Work>
auto Unlocked(const Work& work) {
  auto made = UnlockedUntilStopped(work);
  if (made.is_interrupted) RaiseKeyboardInterrupt();
  return std::move(*made.result);
}

}  // namespace assay::python
