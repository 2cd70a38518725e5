#pragma once

#include <span>

namespace assay::sweep {

inline constexpr int kApplicationId = 0x41535359;  // "ASSY"
inline constexpr int kFormatVersion = 4;           // stored as user_version of the database

// The SQL statements that make the tables. The tables of an existing database are compared with
// them word for word. Therefore any change, even of a space, needs a new version of the format.
extern const char* const kSchema;

// A rule for the contents of rows, beyond the types of their columns. The program accepts only
// databases that obey all rules.
struct ContentRule {
  const char* wrong;  // a query that returns a description of each wrong row
  const char* allowed;
};
extern const std::span<const ContentRule> kContentRules;

}  // namespace assay::sweep
