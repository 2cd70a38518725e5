#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace assay {

// Returns the candidate with the smallest edit distance to `text`, or an empty text if that
// distance is too large for a typing mistake.
std::string NearestName(std::string_view text, const std::vector<std::string>& candidates);

}  // namespace assay
