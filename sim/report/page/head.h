#pragma once

#include <string>

#include "sim/report/page/element.h"

namespace assay::report {

// Of a page that fetches nothing and runs nothing, in the house's style.
Element Head(const std::string& title);

}  // namespace assay::report
