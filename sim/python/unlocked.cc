#include "sim/python/unlocked.h"

#include <csignal>
#include <mutex>

namespace assay::python {
namespace {

std::mutex mutex;  // guards the count
int alive = 0;
struct sigaction python_action;

// Python's own handler makes the interpreter raise KeyboardInterrupt.
extern "C" void StopAndTellPython(int signal) {
  stop_requested = true;
  if (python_action.sa_handler != SIG_DFL && python_action.sa_handler != SIG_IGN) {
    python_action.sa_handler(signal);
  }
}

}  // namespace

StopOnInterrupt::StopOnInterrupt() {
  const std::lock_guard lock(mutex);
  if (alive++ > 0) return;
  stop_requested = false;
  struct sigaction action = {};
  action.sa_handler = StopAndTellPython;
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, &python_action);
}

StopOnInterrupt::~StopOnInterrupt() {
  const std::lock_guard lock(mutex);
  if (--alive > 0) return;
  sigaction(SIGINT, &python_action, nullptr);
  stop_requested = false;
}

bool TakeInterrupt() {
  if (PyErr_CheckSignals() == 0) return false;
  if (PyErr_ExceptionMatches(PyExc_KeyboardInterrupt) == 0) throw pybind11::error_already_set();
  PyErr_Clear();
  return true;
}

void RaiseKeyboardInterrupt() {
  PyErr_SetNone(PyExc_KeyboardInterrupt);
  throw pybind11::error_already_set();
}

}  // namespace assay::python
