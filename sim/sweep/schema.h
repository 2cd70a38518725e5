#pragma once

namespace assay::sweep {

inline constexpr int kApplicationId = 0x41535359;  // "ASSY"
inline constexpr int kFormatVersion = 4;           // in the database as user_version

// Makes the tables.
extern const char* const kSchema;

}  // namespace assay::sweep
