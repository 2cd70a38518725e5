#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace assay::view {

// Returns the values in few bytes, if they change smoothly or seldom. The code is exact;
// page/data.md defines it.
std::string EncodedSeries(std::span<const std::int64_t> values);

}  // namespace assay::view
