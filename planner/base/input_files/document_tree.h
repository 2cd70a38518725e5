#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "planner/base/input_files/input_error.h"

// The inside of a document, for Value and for the readers of documents.
namespace assay {

inline constexpr std::size_t kMaxDepth = 256;  // levels of nested maps and lists

// A node of a document. Nodes belong to their document's tree, which stores texts and lists
// together, because plans have tens of thousands of numbers. A Value keeps the whole tree alive.
struct DocumentNode {
  enum class Kind : std::uint8_t { kNull, kScalar, kList, kMap };
  enum class Style : std::uint8_t { kPlain, kQuoted };
  struct Tree;
  class YamlReader;
  class JsonReader;

  // Returns the root, or null if the document is empty. Throws InputError for any error.
  static const DocumentNode* ReadYaml(const std::shared_ptr<Tree>& tree);
  // Reads JSON in the style of this program's plan files, in an eighth of the time that yaml-cpp
  // takes. It reports no errors. It returns null for anything that it does not know (comments,
  // characters given by number, a key given twice), and yaml-cpp then reads the text. Every text
  // that it accepts means the same to yaml-cpp.
  static const DocumentNode* ReadJson(Tree& tree);

  std::string Describe() const;
  std::vector<std::string> Keys() const;

  const std::string* file;
  std::string_view text = {};                       // of a scalar
  std::span<const DocumentNode* const> keys = {};   // of a map, scalars, as many as items
  std::span<const DocumentNode* const> items = {};  // of a map or a list
  int line;
  int column;  // in bytes, as compilers count
  Kind kind;
  Style style = Style::kPlain;  // only for a scalar
};

struct DocumentNode::Tree {
  Tree(std::string name, std::string read) : file(std::move(name)), text(std::move(read)) {}
  Tree(const Tree&) = delete;
  Tree& operator=(const Tree&) = delete;

  DocumentNode& Add(Kind kind, int line, int column) {
    return nodes.emplace_back(
        DocumentNode{.file = &file, .line = line, .column = column, .kind = kind});
  }
  std::string_view Keep(std::string written) { return texts.emplace_back(std::move(written)); }
  std::span<const DocumentNode* const> Keep(std::span<const DocumentNode* const> list) {
    if (list.empty()) return {};
    return lists.emplace_back(list.begin(), list.end());
  }

  std::string file;  // its name
  std::string text;  // the whole text that was read
  std::deque<DocumentNode> nodes;
  std::deque<std::string> texts;  // scalars whose meaning differs from their spelling
  std::deque<std::vector<const DocumentNode*>> lists;
};

}  // namespace assay
