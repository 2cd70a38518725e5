#pragma once

#include <span>

namespace assay::sweep {

inline constexpr int kApplicationId = 0x41535359;  // "ASSY"
inline constexpr int kFormatVersion = 4;           // in the database as user_version

// Makes the tables. What a database holds is compared with it word for word: a change of it, of a
// space even, is a new version of the format.
extern const char* const kSchema;

// What rows must be for the program to go on with them, beyond the types of their columns.
struct ContentRule {
  const char* wrong;  // a query: what is wrong, in words, for each row that is
  const char* allowed;
};
extern const std::span<const ContentRule> kContentRules;

}  // namespace assay::sweep
