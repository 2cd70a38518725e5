#pragma once

#include <pybind11/pybind11.h>

#include <optional>

#include "planner/base/stop.h"

namespace assay::python {

// While an object of this class lives, Ctrl-C requests a stop (planner/base/stop.h) as well as what
// Python does about it. Objects may live in several threads at once.
class StopOnInterrupt {
 public:
  StopOnInterrupt();
  ~StopOnInterrupt();
  StopOnInterrupt(const StopOnInterrupt&) = delete;
  StopOnInterrupt& operator=(const StopOnInterrupt&) = delete;
};

// Raises KeyboardInterrupt in Python if Ctrl-C was pressed, or if the work was stopped.
void RaiseIfInterrupted(bool is_stopped);

// Returns the result of the work, during which other threads of Python run. Ctrl-C ends the work
// and raises KeyboardInterrupt.
template <class Work>
auto Unlocked(const Work& work) {
  std::optional<decltype(work())> result;
  {
    const pybind11::gil_scoped_release release;
    const StopOnInterrupt stop;
    try {
      result.emplace(work());
    } catch (const Stopped&) {
    }
  }
  RaiseIfInterrupted(!result);
  return std::move(*result);
}

}  // namespace assay::python
