#pragma once

#include <string>
#include <string_view>

namespace assay {

// Reads the words of a text that describes a solid or a surface, line by line.
class TextWords {
 public:
  TextWords(std::string_view text, std::string file) : rest_(text), file_(std::move(file)) {}

  int line() const { return line_; }
  const std::string& file() const { return file_; }

  // Goes to the next line. Returns false at the end of the text.
  bool NextLine();
  // Returns the next word of the line; empty if there is none.
  std::string_view Word();
  // Returns the next word of this line or of one that follows; empty at the end of the text.
  std::string_view WordOfAnyLine();
  // Returns the next word of the line as a number, which is finite and of at most a million.
  double Number();

  // Throws InputError at the last word of the line.
  [[noreturn]] void Fail(const std::string& what, const std::string& allowed) const;

 private:
  std::string_view rest_;     // after the line
  std::string_view current_;  // what is left of the line
  std::string_view whole_;    // the line
  int column_ = 1;            // of the last word
  std::string file_;
  int line_ = 0;
};

}  // namespace assay
