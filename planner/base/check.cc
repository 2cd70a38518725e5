#include "planner/base/check.h"

#include <cstdio>
#include <cstdlib>

namespace assay {

void CheckFailed(const char* file, int line_number, const char* condition,
                 const std::string& message) {
  const std::string line = fmt::format("{}:{}: broken invariant: {}{}{}\n", file, line_number,
                                       condition, message.empty() ? "" : ": ", message);
  // fmt::print is not used, because it throws if standard error cannot be written.
  std::fputs(line.c_str(), stderr);
  std::fflush(stderr);
  std::abort();
}

}  // namespace assay
