#pragma once

#include <string>
#include <string_view>

namespace assay::report {

// Returns a URI that contains the contents of a file (RFC 2397, base64 of RFC 4648).
std::string DataUri(std::string_view media_type, std::string_view contents);

}  // namespace assay::report
