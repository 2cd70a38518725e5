#pragma once

#include <filesystem>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "planner/base/input_files/input_error.h"

namespace assay {

struct DocumentNode;  // document_tree.h

// A value in a YAML or JSON document, with its place. An accessor that does not find what it is
// asked for throws an InputError with file, line, column, the offending text and what is allowed.
// Values share the document, so they are cheap to copy and may outlive the Document.
class Value {
 public:
  bool IsMap() const;
  bool IsList() const;
  bool IsScalar() const;

  std::string Text() const;                              // any scalar
  double Number() const;                                 // finite: neither NaN nor infinite
  int Integer(int low, int high) const;                  // in [low, high]
  bool Flag() const;                                     // true or false
  std::vector<double> Numbers(std::size_t count) const;  // a list of exactly `count` numbers
  // Returns the index of the text in `names`. If it is not among them, the error lists them and
  // suggests the nearest.
  int OneOf(const std::vector<std::string>& names) const;

  Value At(std::string_view key) const;                   // a required key of a map
  std::optional<Value> Find(std::string_view key) const;  // an optional key of a map
  std::vector<Value> Items() const;                       // the items of a list
  std::vector<std::pair<Value, Value>> Entries() const;   // the keys and values of a map, in order

  // Fails at the first key of this map that is not among `keys`, and names the nearest of them.
  // Fails at a key that is given twice.
  void AllowOnly(const std::vector<std::string>& keys) const;
  void AllowOnly(std::initializer_list<std::string_view> keys) const;

  // Throws an InputError at this place.
  [[noreturn]] void Fail(const std::string& what, const std::string& allowed = "") const;
  FilePlace Place() const;

 private:
  friend class Document;
  explicit Value(std::shared_ptr<const DocumentNode> node);
  std::shared_ptr<const DocumentNode> node_;
};

// A complete YAML or JSON file with the place of each value.
class Document {
 public:
  // Load and Parse throw InputError if the file cannot be read or is not YAML.
  static Document Load(const std::filesystem::path& file);
  static Document Parse(const std::string& text, const std::string& file_name);

  const Value& root() const { return root_; }
  std::string file() const { return root_.Place().file; }  // the name as it was given
  const std::string& digest() const { return digest_; }    // a hash of the whole text

  // Throws InputError unless the root is a map whose key `format` has exactly this text.
  void RequireFormat(std::string_view format) const;

 private:
  Document(Value root, std::string digest) : root_(std::move(root)), digest_(std::move(digest)) {}
  Value root_;
  std::string digest_;
};

}  // namespace assay
