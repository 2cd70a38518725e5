#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <utility>

#include "planner/base/input_files/input_error.h"
#include "tests/scratch_file.h"

namespace assay::fuzz {

// The folder of the models that scenarios name.
inline const std::filesystem::path kModels = std::filesystem::path(ASSAY_SOURCE_DIR) / "models";

// Returns the bytes from libFuzzer as a text.
inline std::string TextOf(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

// Splits an input into two texts, which some readers need. A line of equals signs is between them.
inline constexpr std::string_view kBetweenTexts = "\n=====\n";
inline std::pair<std::string, std::string> TwoTexts(const std::string& both) {
  const std::size_t end = both.find(kBetweenTexts);
  if (end == std::string::npos) return {both, ""};
  return {both.substr(0, end), both.substr(end + kBetweenTexts.size())};
}

// Writes the text to a temporary file of this process, for readers that open files.
inline std::filesystem::path FileOf(const std::string& text, const std::string& name) {
  const std::filesystem::path file = ScratchFile(name);
  std::filesystem::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary) << text;
  return file;
}

// Returns true for one input in `many`. Such an input is used beyond its reader, which takes a
// hundred times as long as reading. The result depends on the text alone, so that a finding
// repeats.
inline bool IsOneIn(int many, const std::string& text) {
  std::uint32_t hash = 2166136261;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 16777619;
  return hash % static_cast<std::uint32_t>(many) == 0;
}

// Does the work. A reader may refuse its input by an InputError only. Any other exception ends the
// process, which libFuzzer reports as a crash.
template <class Work>
int RefusesOrDoes(const Work& work) {
  try {
    work();
  } catch (const InputError&) {
    return 0;
  }
  return 0;
}

}  // namespace assay::fuzz
