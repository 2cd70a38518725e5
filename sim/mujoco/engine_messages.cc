#include "sim/mujoco/engine_messages.h"

#include <mujoco/mujoco.h>

#include <mutex>
#include <utility>

#include "planner/base/check.h"

namespace assay::mujoco {
namespace {

thread_local std::vector<std::string> engine_warnings;

void KeepWarning(const char* message) { engine_warnings.emplace_back(message); }

// The engine does not expect its error handler to return.
[[noreturn]] void StopOnError(const char* message) {
  CheckFailed("mujoco", 0, "no engine error", message);
}

}  // namespace

void HandleEngineMessages() {
  static std::once_flag once;
  std::call_once(once, [] {
    mju_user_warning = KeepWarning;
    mju_user_error = StopOnError;
  });
}

std::vector<std::string> TakeEngineWarnings() { return std::exchange(engine_warnings, {}); }

}  // namespace assay::mujoco
