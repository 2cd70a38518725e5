#pragma once

#include <string>
#include <string_view>

namespace assay::report {

// A file's contents as an address that holds them (RFC 2397, base64 of RFC
// 4648).
std::string DataUri(std::string_view media_type, std::string_view contents);

}  // namespace assay::report
