#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace assay {

// The candidate with the smallest edit distance to `text`, if that is small enough to be a likely
// slip of the keyboard; else empty.
std::string NearestName(std::string_view text, const std::vector<std::string>& candidates);

}  // namespace assay
