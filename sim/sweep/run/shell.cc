#include "sim/sweep/run/shell.h"

namespace assay::sweep {

std::string Quoted(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

std::string Word(const std::string& text) {
  constexpr const char* kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789._-/+,";
  const bool plain = !text.empty() && text.find_first_not_of(kPlain) == std::string::npos;
  return plain ? text : Quoted(text);
}

std::string ModelsOption(const domain::ModelPath& models) {
  std::string option;
  for (const std::filesystem::path& folder : models.folders()) {
    option += " --models " + Word(folder.generic_string());
  }
  return option;
}

}  // namespace assay::sweep
