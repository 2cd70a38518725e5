#include "planner/base/input_files/input_error.h"

#include <fmt/format.h>

#include "planner/base/input_files/quotation.h"

namespace assay {

std::string FilePlace::Text() const {
  const std::string shown = Show(file);
  return line > 0 ? fmt::format("{}:{}:{}", shown, line, column) : shown;
}

InputError::InputError(FilePlace place, const std::string& what, const std::string& allowed)
    : std::runtime_error(allowed.empty() ? fmt::format("{}: {}", place.Text(), Show(what))
                                         : fmt::format("{}: {}; allowed: {}", place.Text(),
                                                       Show(what), Show(allowed))),
      place_(std::move(place)) {}

}  // namespace assay
