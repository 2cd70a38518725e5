#pragma once

#include <string_view>

namespace assay {

// Returns true if the text has the form [-+]? [0-9]+
bool IsInteger(std::string_view text);

// Returns true if the text is a decimal number of YAML 1.2, which covers JSON's numbers:
// [-+]? ( \. [0-9]+ | [0-9]+ ( \. [0-9]* )? ) ( [eE] [-+]? [0-9]+ )?
bool IsDecimal(std::string_view text);

}  // namespace assay
