#pragma once

#include <string_view>

namespace assay::view {

// Returns the scripts and the style of the page, as esbuild has bundled them from sim/view/page and
// three.js.
std::string_view Bundle();

}  // namespace assay::view
