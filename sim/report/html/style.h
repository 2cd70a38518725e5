#pragma once

#include <string>

namespace assay::report {

// Returns the style sheet of a page for wide and narrow screens, for light and dark ones, and for
// paper. Nothing in it is fetched.
std::string StyleSheet();

}  // namespace assay::report
