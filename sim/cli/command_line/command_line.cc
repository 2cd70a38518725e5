#include "sim/cli/command_line/command_line.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <new>
#include <sstream>
#include <system_error>

#include "planner/base/input_files/document.h"
#include "planner/base/input_files/input_error.h"
#include "planner/base/input_files/nearest_name.h"
#include "planner/base/input_files/quotation.h"
#include "planner/base/stop.h"
#include "sim/cli/command_line/console.h"
#include "sim/cli/command_line/interruption.h"
#include "sim/cli/command_line/usage_error.h"
#include "sim/cli/command_line/verb.h"

namespace assay::cli {
namespace {

constexpr const char* kDescription =
    "assay plans assemblies, executes the plans in physics and checks what they promise.";

std::string InQuotes(const std::string& text) { return Quote(text); }

std::string DidYouMean(const std::string& text, const std::vector<std::string>& names) {
  const std::string nearest = NearestName(text, names);
  return nearest.empty() ? "" : fmt::format("; did you mean {}?", InQuotes(nearest));
}

// Range checks of the library accept NaN, since it compares as less than nothing.
std::string ExplainNumber(const std::string& value) {
  double number = 0;
  const bool is_nan = CLI::detail::lexical_cast(value, number) && std::isnan(number);
  return is_nan ? fmt::format("{} is no number", InQuotes(value)) : std::string();
}

// Refuses an integer that its type does not have. The library would take another one.
template <class Integer>
std::string ExplainInteger(const std::string& value) {
  Integer number = 0;
  const char* const end = value.data() + value.size();
  const auto [rest, error] = std::from_chars(value.data(), end, number);
  const bool is_below = std::is_unsigned_v<Integer> && value.starts_with('-');
  if (error != std::errc::result_out_of_range && !is_below) return "";
  return fmt::format("{} is out of range; allowed: {} to {}", InQuotes(value),
                     std::numeric_limits<Integer>::min(), std::numeric_limits<Integer>::max());
}

std::string ExplainText(const std::string& value) {
  return value.empty() ? "an empty text is no value" : "";
}

class CommandLine {
 public:
  explicit CommandLine(const std::vector<std::string>& arguments) : arguments_(arguments) {
    app_.name("assay");
    app_.set_version_flag("--version", "assay " ASSAY_VERSION);
    app_.require_subcommand(1);
    app_.get_formatter()->label("SUBCOMMAND", "VERB");
    app_.footer(
        fmt::format("assay VERB --help describes a verb, with an example.\n\n{}\nExample:\n  assay "
                    "run scenarios/spar-fig13.yaml --renders -o out",
                    ExitCodeTable()));
    for (const Verb* verb : Verbs()) AddVerb(*verb);
  }

  ExitCode Run() {
    try {
      Parse();
    } catch (const CLI::Success& call_for_text) {
      std::ostringstream text;
      app_.exit(call_for_text, text, text);
      Print(text.str());
      return ExitCode::kDone;
    } catch (const CLI::ParseError& error) {
      PrintError(Explain(error));
      return ExitCode::kWrongCommandLine;
    }
    return execution_();
  }

 private:
  void AddVerb(const Verb& verb) {
    CLI::App* const command = app_.add_subcommand(verb.name, verb.summary);
    command->group("Verbs");
    command->footer(fmt::format("Example:\n  {}\n\nManual: {}", verb.example, verb.page));
    Execution execution = verb.declare(*command);
    CheckValues(*command);
    command->final_callback([this, execution] { execution_ = execution; });
  }

  // Adds checks that the library lacks.
  static void CheckValues(CLI::App& command) {
    for (CLI::Option* const option : command.get_options()) {
      const std::string type = option->get_type_name();
      const auto is = [&](const char* name) { return type.find(name) != std::string::npos; };
      if (is("FLOAT")) option->check(ExplainNumber);
      if (is("INT"))
        option->check(is("UINT") ? ExplainInteger<std::uint64_t> : ExplainInteger<std::int64_t>);
      // An empty list of errors is a valid value.
      const bool may_be_empty = option->check_lname("errors");
      if (is("TEXT") && !may_be_empty) option->check(ExplainText);
    }
    for (CLI::App* const part : command.get_subcommands({})) CheckValues(*part);
  }

  void Parse() {
    // The library takes its arguments from the back.
    std::vector<std::string> reversed(arguments_.rbegin(), arguments_.rend());
    if (!reversed.empty()) reversed.pop_back();
    app_.parse(std::move(reversed));
  }

  std::string Explain(const CLI::ParseError& error) const {
    const std::vector<CLI::App*> verbs = app_.get_subcommands();
    if (verbs.empty()) return fmt::format("{} (see assay --help)", ExplainWithoutVerb(error));
    const std::string name = verbs.back()->get_name();
    return fmt::format("{}: {} (see assay {} --help)", name, ExplainInVerb(error, *verbs.back()),
                       name);
  }

  std::string ExplainWithoutVerb(const CLI::ParseError& error) const {
    std::vector<std::string> names;
    for (const Verb* verb : Verbs()) names.push_back(verb->name);
    if (arguments_.size() < 2) return fmt::format("a verb is missing: {}", fmt::join(names, ", "));
    const std::string& first = arguments_[1];
    if (first.starts_with("-"))
      return fmt::format("{} is not an option before the verb", InQuotes(first));
    if (std::ranges::find(names, first) != names.end()) return error.what();
    return fmt::format("there is no verb {}{}", InQuotes(first), DidYouMean(first, names));
  }

  static std::string ExplainInVerb(const CLI::ParseError& error, const CLI::App& verb) {
    std::vector<std::string> names;
    for (const CLI::Option* option : verb.get_options()) {
      for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    }
    for (const std::string& rest : verb.remaining()) {
      if (!rest.starts_with("-")) return fmt::format("{} is one argument too many", InQuotes(rest));
      const std::string option = rest.substr(0, rest.find('='));
      return fmt::format("there is no option {}{}", InQuotes(option), DidYouMean(option, names));
    }
    return error.what();
  }

  const std::vector<std::string>& arguments_;
  CLI::App app_{kDescription};
  Execution execution_;
};

}  // namespace

ExitCode RunCommandLine(const std::vector<std::string>& arguments) {
  try {
    const ExitCode code = CommandLine(arguments).Run();
    FlushOutput();
    return code;
  } catch (const InputError& error) {
    PrintError(error.what());
    return ExitCode::kWrongInput;
  } catch (const UsageError& error) {
    PrintError(error.what());
    return ExitCode::kWrongCommandLine;
  } catch (const EnvironmentError& error) {
    PrintError(error.what());
  } catch (const std::system_error& error) {
    PrintError(error.what());
  } catch (const std::bad_alloc&) {
    PrintError("out of memory");
  } catch (const Stopped&) {
    PrintError("interrupted: nothing is there yet");
    return Interruption::CodeOr(ExitCode::kEnvironment);
  } catch (const std::exception& error) {
    PrintError(fmt::format("internal error of assay: {}", error.what()));
  } catch (...) {
    PrintError("internal error of assay");
  }
  return ExitCode::kEnvironment;
}

}  // namespace assay::cli
