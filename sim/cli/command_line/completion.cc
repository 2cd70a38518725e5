#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "sim/cli/command_line/console.h"
#include "sim/cli/command_line/verb.h"

namespace assay::cli {
namespace completion_verb {

struct Flag {
  std::vector<std::string> spellings;  // "-o", "--output"
  std::string description;
  std::vector<std::string> values;  // the allowed values, if they can be listed
  bool takes_value = false;
};

// A verb, or a subcommand of a verb such as `sweep show`, as the command line declares it.
struct Word {
  std::string name;
  std::string summary;
  std::vector<Flag> flags;
  std::vector<Word> words;
};

// Returns the allowed values of a type. The type's name holds them as "{a,b}".
std::vector<std::string> ValuesIn(const std::string& type) {
  const std::size_t begin = type.find('{');
  const std::size_t end = type.find('}', begin);
  if (begin == std::string::npos || end == std::string::npos) return {};
  return CLI::detail::split(type.substr(begin + 1, end - begin - 1), ',');
}

Flag FlagOf(const CLI::Option& option) {
  Flag flag{.spellings = {},
            .description = option.get_description(),
            .values = ValuesIn(option.get_type_name()),
            .takes_value = option.get_items_expected_max() > 0};
  for (const std::string& name : option.get_snames()) flag.spellings.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) flag.spellings.push_back("--" + name);
  return flag;
}

Word WordOf(const CLI::App& app) {
  Word word{.name = app.get_name(), .summary = app.get_description(), .flags = {}, .words = {}};
  for (const CLI::Option* option : app.get_options()) {
    if (option->nonpositional()) word.flags.push_back(FlagOf(*option));
  }
  for (const CLI::App* part : app.get_subcommands({})) {
    Word inner = WordOf(*part);
    if (inner.name.empty()) {  // the library keeps a group of options as an App without a name
      word.flags.insert(word.flags.end(), inner.flags.begin(), inner.flags.end());
    } else {
      word.words.push_back(std::move(inner));
    }
  }
  return word;
}

std::vector<std::string> TextsOf(const std::vector<Word>& words) {
  std::vector<std::string> names;
  for (const Word& word : words) names.push_back(word.name);
  return names;
}

std::vector<std::string> SpellingsOf(const std::vector<Flag>& flags) {
  std::vector<std::string> spellings;
  for (const Flag& flag : flags) {
    spellings.insert(spellings.end(), flag.spellings.begin(), flag.spellings.end());
  }
  return spellings;
}

// Returns the text in single quotes of a shell.
std::string Quoted(std::string text) {
  for (std::size_t at = text.find('\''); at != std::string::npos; at = text.find('\'', at + 4)) {
    text.replace(at, 1, "'\\''");
  }
  return "'" + text + "'";
}

// Returns one case for each verb, with the words that may follow it.
std::string BashCase(const Word& word, const std::string& path) {
  std::string text =
      fmt::format("    {}) words='{} {}' ;;\n", Quoted(path), fmt::join(TextsOf(word.words), " "),
                  fmt::join(SpellingsOf(word.flags), " "));
  for (const Word& part : word.words) text += BashCase(part, path + " " + part.name);
  return text;
}

std::string BashValues(const Word& word, const std::string& path) {
  std::string text;
  for (const Flag& flag : word.flags) {
    if (!flag.takes_value) continue;
    for (const std::string& spelling : flag.spellings) {
      text += fmt::format("    {}) words='{}'; files={} ;;\n", Quoted(path + " " + spelling),
                          fmt::join(flag.values, " "), flag.values.empty() ? 1 : 0);
    }
  }
  for (const Word& part : word.words) text += BashValues(part, path + " " + part.name);
  return text;
}

std::string Bash(const Word& assay) {
  return fmt::format(
      R"(# Completion of assay's command line for bash.
_assay() {{
  local current=${{COMP_WORDS[COMP_CWORD]}} previous=${{COMP_WORDS[COMP_CWORD - 1]}}
  local path=assay words='' files=0 i
  for ((i = 1; i < COMP_CWORD; ++i)); do
    case "$path ${{COMP_WORDS[i]}}" in
    {0}) path="$path ${{COMP_WORDS[i]}}" ;;
    esac
  done
  case $path in
{1}  esac
  case "$path $previous" in
{2}  esac
  if ((files)) || [[ $current != -* && $path != assay ]]; then COMPREPLY=($(compgen -f -- "$current")); fi
  COMPREPLY+=($(compgen -W "$words" -- "$current"))
}}
complete -o filenames -F _assay assay
)",
      fmt::join(
          [&] {
            std::vector<std::string> paths;
            for (const Word& verb : assay.words) {
              paths.push_back(Quoted("assay " + verb.name));
              for (const Word& part : verb.words) {
                paths.push_back(Quoted("assay " + verb.name + " " + part.name));
              }
            }
            return paths;
          }(),
          " | "),
      BashCase(assay, "assay"), BashValues(assay, "assay"));
}

// Returns the lines for a word. fish evaluates `condition` to decide whether the command line has
// reached this word.
std::string FishLines(const Word& word, const std::string& condition) {
  std::string text;
  for (const Word& part : word.words) {
    text += fmt::format("complete -c assay -n {} -a {} -d {}\n", Quoted(condition),
                        Quoted(part.name), Quoted(part.summary));
  }
  for (const Flag& flag : word.flags) {
    text += fmt::format("complete -c assay -n {}", Quoted(condition));
    for (const std::string& spelling : flag.spellings) {
      const bool is_long = spelling.starts_with("--");
      text += fmt::format(" -{} {}", is_long ? "l" : "s", Quoted(spelling.substr(is_long ? 2 : 1)));
    }
    if (flag.takes_value) text += " -r";
    if (!flag.values.empty()) {
      text += fmt::format(" -f -a {}", Quoted(fmt::format("{}", fmt::join(flag.values, " "))));
    }
    text += fmt::format(" -d {}\n", Quoted(flag.description));
  }
  for (const Word& part : word.words) {
    const bool is_verb = condition == "__fish_use_subcommand";
    text += FishLines(part, is_verb ? "__fish_seen_subcommand_from " + part.name
                                    : condition + "; and __fish_seen_subcommand_from " + part.name);
  }
  return text;
}

std::string Fish(const Word& assay) {
  return "# Completion of assay's command line for fish.\n" +
         FishLines(assay, "__fish_use_subcommand");
}

// Escapes the characters that zsh's _arguments gives a meaning, such as brackets and colons.
std::string ZshText(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '[' || c == ']' || c == ':' || c == '\\') escaped += '\\';
    escaped += c;
  }
  return escaped;
}

std::string ZshFlag(const Flag& flag) {
  std::string value;
  if (flag.takes_value) {
    value = flag.values.empty() ? ":value:_files"
                                : fmt::format(":value:({})", fmt::join(flag.values, " "));
  }
  std::string text;
  for (const std::string& spelling : flag.spellings) {
    text += " " + Quoted(fmt::format("*{}[{}]{}", spelling, ZshText(flag.description), value));
  }
  return text;
}

std::string ZshFunction(const Word& word, const std::string& name) {
  std::string text = name + "() {\n";
  if (!word.words.empty()) text += "  local line state\n";
  text += "  _arguments -C";
  for (const Flag& flag : word.flags) text += ZshFlag(flag);
  if (word.words.empty()) return text + " '*:file:_files'\n}\n";
  text +=
      " '1: :->word' '*::argument:->arguments'\n  case $state in\n  word)\n    local -a words=(";
  for (const Word& part : word.words) {
    text += " " + Quoted(ZshText(part.name) + ":" + part.summary);
  }
  text += " )\n    _describe verb words ;;\n  arguments)\n    case $line[1] in\n";
  for (const Word& part : word.words) {
    text += fmt::format("    {0}) {1}_{0} ;;\n", part.name, name);
  }
  text += "    esac ;;\n  esac\n}\n";
  for (const Word& part : word.words) text += ZshFunction(part, name + "_" + part.name);
  return text;
}

std::string Zsh(const Word& assay) {
  return "#compdef assay\n# Completion of assay's command line for zsh.\n" +
         ZshFunction(assay, "_assay") +
         "# zsh reads this file as the function's body at the first completion; sourced, it "
         "declares it.\n"
         "if [[ $funcstack[1] == _assay ]]; then _assay \"$@\"; else compdef _assay assay; fi\n";
}

Execution Declare(CLI::App& command) {
  const auto shell = std::make_shared<std::string>();
  command.add_option("shell", *shell, "bash, zsh or fish")
      ->required()
      ->check(CLI::IsMember({"bash", "zsh", "fish"}));
  return [shell, &command] {
    const Word assay = WordOf(*command.get_parent());
    Print(*shell == "bash" ? Bash(assay) : *shell == "zsh" ? Zsh(assay) : Fish(assay));
    return ExitCode::kDone;
  };
}

}  // namespace completion_verb

const Verb kCompletion = {
    .name = "completion",
    .summary = "prints a script with which a shell completes command lines",
    .page = "sim/running.md",
    .example = "assay completion bash > ~/.local/share/bash-completion/completions/assay",
    .declare = completion_verb::Declare,
};

}  // namespace assay::cli
