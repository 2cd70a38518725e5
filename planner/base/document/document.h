#pragma once

#include <filesystem>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "planner/base/document/input_error.h"

namespace assay {

struct DocumentNode;  // document_tree.h

// A place in a YAML or JSON document, with what stands there. Every accessor that does not find
// what it wants throws an InputError with file, line, column, the offending text and what is
// allowed. Values share the document, so they are cheap to copy and may outlive the loader.
class Value {
 public:
  bool IsMap() const;
  bool IsList() const;
  bool IsScalar() const;

  std::string Text() const;                              // any scalar
  double Number() const;                                 // finite; no NaN, no infinity
  int Integer(int low, int high) const;                  // in [low, high]
  bool Flag() const;                                     // true or false
  std::vector<double> Numbers(std::size_t count) const;  // a list of exactly `count` numbers
  // The index in `names` of the text; else an error that lists them and suggests the nearest.
  int OneOf(const std::vector<std::string>& names) const;

  Value At(std::string_view key) const;                   // a required key of a map
  std::optional<Value> Find(std::string_view key) const;  // an optional key of a map
  std::vector<Value> Items() const;                       // of a list
  std::vector<std::pair<Value, Value>> Entries() const;   // of a map, keys and values, in order

  // Fails at the first key of this map that is not among `keys`, naming the nearest of them, and
  // at a key that is given twice.
  void AllowOnly(std::initializer_list<std::string_view> keys) const;

  // Throws an InputError at this place.
  [[noreturn]] void Fail(const std::string& what, const std::string& allowed = "") const;
  FilePlace Place() const;

 private:
  friend class Document;
  explicit Value(std::shared_ptr<const DocumentNode> node);
  std::shared_ptr<const DocumentNode> node_;
};

// A YAML or JSON file read whole, with the place of each value.
class Document {
 public:
  // Throws InputError if the file cannot be read or is not YAML.
  static Document Load(const std::filesystem::path& file);
  static Document Parse(const std::string& text, const std::string& file_name);

  const Value& root() const { return root_; }
  std::string file() const { return root_.Place().file; }  // its name, as it was given

  // The root is a map whose key `format` has exactly this text; anything else is an error.
  void RequireFormat(std::string_view format) const;

 private:
  explicit Document(Value root) : root_(std::move(root)) {}
  Value root_;
};

}  // namespace assay
