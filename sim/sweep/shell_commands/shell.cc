#include "sim/sweep/shell_commands/shell.h"

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

CommandLine::CommandLine(const char* verb, const std::filesystem::path& input)
    : text_(fmt::format("assay {} {}", verb, Word(input.generic_string()))) {}

void CommandLine::AddFlag(const char* option, bool is_set) {
  if (is_set) text_ += fmt::format(" {}", option);
}

void CommandLine::AddModels(const domain::ModelPath& models) {
  for (const std::filesystem::path& folder : models.folders()) {
    Add("--models", folder.generic_string());
  }
}

}  // namespace assay::sweep
