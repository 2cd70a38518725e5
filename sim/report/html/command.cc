#include "sim/report/html/command.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <sstream>
#include <string_view>

namespace assay::report {
namespace {

bool IsPlain(char c) {
  constexpr std::string_view kPlain = "_./-+:@%=,";
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || kPlain.find(c) != kPlain.npos;
}

}  // namespace

std::string ShellWord(const std::string& text) {
  if (!text.empty() && std::ranges::all_of(text, IsPlain)) return text;
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

std::string ReplayCommand(const std::string& database, int trial) {
  return fmt::format("assay replay {} {}", ShellWord(database), trial);
}

std::string ViewCommand(const std::string& database, int trial, std::optional<int> counterexample) {
  const std::string name = ShellWord(database);
  if (!counterexample) return fmt::format("assay view {} {} -o trial-{}.html", name, trial, trial);
  return fmt::format("assay view {} {} --counterexample {} -o counterexample-{}-{}.html", name,
                     trial, *counterexample, trial, *counterexample);
}

std::string WithDatabase(const std::string& command, const std::string& database) {
  constexpr std::string_view kWord = " DB ";
  const std::size_t at = (command + " ").find(kWord);
  if (at == std::string::npos) return command;
  const std::size_t end = at + kWord.size() - 1;
  return fmt::format("{} {}{}", command.substr(0, at), ShellWord(database),
                     end < command.size() ? command.substr(end) : "");
}

}  // namespace assay::report
