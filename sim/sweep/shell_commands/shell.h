#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <optional>
#include <string>

#include "planner/domain/workcell/model_path.h"

namespace assay::sweep {

// Returns the text as one quoted word for the shell.
std::string Quoted(const std::string& text);
// Returns the text as one word for the shell, without quotes if it needs none.
std::string Word(const std::string& text);

// A command line of the program that a person can give to the shell.
class CommandLine {
 public:
  // Begins with "assay VERB INPUT".
  CommandLine(const char* verb, const std::filesystem::path& input);

  const std::string& text() const { return text_; }

  void AddFlag(const char* option, bool is_set);
  template <class T>
  void Add(const char* option, const T& value) {
    text_ += fmt::format(" {} {}", option, Word(fmt::format("{}", value)));
  }
  template <class T>
  void AddIfGiven(const char* option, const std::optional<T>& value) {
    if (value) Add(option, *value);
  }
  template <class T>
  void AddUnless(const T& usual, const char* option, const T& value) {
    if (value != usual) Add(option, value);
  }
  // Adds " --models FOLDER" for each folder, in the order of the path.
  void AddModels(const domain::ModelPath& models);

 private:
  std::string text_;
};

}  // namespace assay::sweep
