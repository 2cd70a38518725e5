#pragma once

#include <stdexcept>
#include <string>

namespace assay {

// A place in an input file. Lines and columns count from 1; 0 means that the place has none.
struct FilePlace {
  std::string file;
  int line = 0;
  int column = 0;

  std::string Text() const;  // "file:line:column", "file" without a line
};

// What a user wrote is wrong. The message reads "file:line:column: what; allowed: ...", each shown
// as quotation.h says: texts of the user may stand in it as they are.
class InputError : public std::runtime_error {
 public:
  InputError(FilePlace place, const std::string& what, const std::string& allowed);

  const FilePlace& place() const { return place_; }

 private:
  FilePlace place_;
};

// The environment lacks something that the command needs (a renderer, room on the disk).
class EnvironmentError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace assay
