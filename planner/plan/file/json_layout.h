#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace assay::plan {

// All of them are valid UTF-8 without control characters, whatever texts are in the JSON: bytes
// that are none become U+FFFD.

// JSON as a file holds it: a list or an object that fits stands on one line of 100 columns, what is
// in longer ones on lines of their own, as many numbers and texts on each as it takes. Numbers have
// the fewest digits that read back as the same double. Ends with a line break.
std::string LaidOut(const nlohmann::ordered_json& json);

// JSON as it is printed for other programs: each item on a line of its own. Ends with a line break.
std::string JsonText(const nlohmann::ordered_json& json);
// The same on one line, without a line break.
std::string JsonLine(const nlohmann::ordered_json& json);

}  // namespace assay::plan
