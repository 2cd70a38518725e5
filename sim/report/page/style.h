#pragma once

#include <string>

namespace assay::report {

// The style sheet of a page: for screens wide and narrow, light and dark, and
// for paper. Nothing in it is fetched.
std::string StyleSheet();

}  // namespace assay::report
