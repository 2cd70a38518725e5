#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace assay::plan {

// The results of all these functions are valid UTF-8 without control characters, whatever texts are
// in the JSON. Invalid bytes become U+FFFD.

// Returns JSON in the layout of files. A list or an object that fits stands on one line of 100
// columns. The items of a longer one stand on lines of their own, with as many numbers and texts on
// each line as fit. Numbers have the fewest digits that read back as the same double. The text ends
// with a line break.
std::string LaidOut(const nlohmann::ordered_json& json);

// Returns JSON as it is printed for other programs, with each item on a line of its own. The text
// ends with a line break.
std::string JsonText(const nlohmann::ordered_json& json);
// Returns JSON on one line, without a line break.
std::string JsonLine(const nlohmann::ordered_json& json);

}  // namespace assay::plan
