#pragma once

#include <string>

namespace assay::sweep {

// For the shell, as one word, in quotes.
std::string Quoted(const std::string& text);
// The same, without quotes where it needs none.
std::string Word(const std::string& text);

}  // namespace assay::sweep
