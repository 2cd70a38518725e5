#pragma once

#include <cstdint>
#include <string>

namespace assay {

// Returns a text such as "1 part" or "3 parts". The noun has a regular plural.
inline std::string Counted(std::int64_t count, const char* noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

}  // namespace assay
