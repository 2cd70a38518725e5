#include "planner/base/input_error.h"

#include <fmt/format.h>

namespace assay {

std::string FilePlace::Text() const {
  return line > 0 ? fmt::format("{}:{}:{}", file, line, column) : file;
}

InputError::InputError(FilePlace place, const std::string& what, const std::string& allowed)
    : std::runtime_error(allowed.empty()
                             ? fmt::format("{}: {}", place.Text(), what)
                             : fmt::format("{}: {}; allowed: {}", place.Text(), what, allowed)),
      place_(std::move(place)) {}

}  // namespace assay
