#pragma once

#include <string>
#include <string_view>

#include "planner/base/input_files/document.h"

namespace assay::domain {

// Reads a name in a file: letters, digits, - and _. Throws InputError for other text; the message
// says what it is to name: `what` ("a part").
std::string ReadName(const Value& key, std::string_view what);

// Reads any text that is not empty.
std::string ReadAnyName(const Value& value);

}  // namespace assay::domain
