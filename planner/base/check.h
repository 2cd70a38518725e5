#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>

namespace assay {

// Prints the place, the broken condition and the message to standard error, then aborts.
[[noreturn]] void CheckFailed(const char* file, int line, const char* condition,
                              const std::string& message);

}  // namespace assay

// Stops the program, in every build type, if an invariant of the program is broken. It must not be
// used for mistakes that a user can make: they are reported by InputError (input_error.h). The way
// in which a planner or a trial ends is a value (outcome.h).
#define ASSAY_CHECK(condition, ...)                                                        \
  do {                                                                                     \
    if (!(condition)) [[unlikely]] {                                                       \
      ::assay::CheckFailed(__FILE__, __LINE__, #condition, ::fmt::format("" __VA_ARGS__)); \
    }                                                                                      \
  } while (false)
