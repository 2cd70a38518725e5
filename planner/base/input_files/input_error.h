#pragma once

#include <stdexcept>
#include <string>

namespace assay {

// A place in an input file. Lines and columns count from 1; 0 means unknown.
struct FilePlace {
  std::string file;
  int line = 0;
  int column = 0;

  std::string Text() const;  // "file:line:column", or "file" without a line
};

// An error in a user's input. The message reads "file:line:column: what; allowed: ...". Each part
// is made printable as in quotation.h, so it may contain texts of the user unchanged.
class InputError : public std::runtime_error {
 public:
  InputError(FilePlace place, const std::string& what, const std::string& allowed);

  const FilePlace& place() const { return place_; }

 private:
  FilePlace place_;
};

// Reports that the environment lacks something that the command needs (a renderer, room on the
// disk).
class EnvironmentError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace assay
