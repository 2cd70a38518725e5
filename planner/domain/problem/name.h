#pragma once

#include <string>
#include <string_view>

#include "planner/base/document/document.h"

namespace assay::domain {

// A name that a file gives: letters, digits, - and _. Throws InputError, which tells what it is to
// name ("a part").
std::string ReadName(const Value& key, std::string_view what);

// Any text but none.
std::string ReadAnyName(const Value& value);

}  // namespace assay::domain
