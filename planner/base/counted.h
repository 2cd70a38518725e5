#pragma once

#include <cstdint>
#include <string>

namespace assay {

// Returns a text such as "1 recovery" or "3 recoveries".
inline std::string Counted(std::int64_t count, const char* one, const char* many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

// Returns a text such as "1 part" or "3 parts". The noun has a regular plural.
inline std::string Counted(std::int64_t count, const char* noun) {
  return Counted(count, noun, (std::string(noun) + "s").c_str());
}

}  // namespace assay
