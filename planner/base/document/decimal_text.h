#pragma once

#include <string_view>

namespace assay {

// [-+]? [0-9]+
bool IsInteger(std::string_view text);

// YAML 1.2's decimal floats and integers, which contain JSON's numbers: [-+]? ( \. [0-9]+ |
// [0-9]+ ( \. [0-9]* )? ) ( [eE] [-+]? [0-9]+ )?
bool IsDecimal(std::string_view text);

}  // namespace assay
