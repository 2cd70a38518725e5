#pragma once

#include <string>

#include "sim/report/html/element.h"

namespace assay::report {

// Returns the head of a page that fetches nothing and runs no scripts, with the style sheet.
Element Head(const std::string& title);

}  // namespace assay::report
