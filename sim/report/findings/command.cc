#include "sim/report/findings/command.h"

#include <fmt/format.h>

#include <string_view>

#include "sim/sweep/shell_commands/shell.h"

namespace assay::report {

std::string ReplayCommand(const std::string& database, int trial) {
  return fmt::format("assay replay {} {}", sweep::Word(database), trial);
}

std::string ViewCommand(const std::string& database, int trial, std::optional<int> counterexample) {
  const std::string name = sweep::Word(database);
  if (!counterexample) return fmt::format("assay view {} {} -o trial-{}.html", name, trial, trial);
  return fmt::format("assay view {} {} --counterexample {} -o counterexample-{}-{}.html", name,
                     trial, *counterexample, trial, *counterexample);
}

std::string WithDatabase(const std::string& command, const std::string& database) {
  constexpr std::string_view kWord = " DB ";
  const std::size_t at = (command + " ").find(kWord);
  if (at == std::string::npos) return command;
  const std::size_t end = at + kWord.size() - 1;
  return fmt::format("{} {}{}", command.substr(0, at), sweep::Word(database),
                     end < command.size() ? command.substr(end) : "");
}

}  // namespace assay::report
