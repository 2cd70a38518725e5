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

#include "planner/base/document/input_error.h"

// What a document has inside: for Value and for those who read documents.
namespace assay {

inline constexpr std::size_t kMaxDepth = 256;  // of maps and lists in each other

// Nodes lie in their document's tree, where texts and lists are kept once and together: plans have
// tens of thousands of numbers. A Value keeps the whole tree alive.
struct DocumentNode {
  enum class Kind : std::uint8_t { kNull, kScalar, kList, kMap };
  enum class Style : std::uint8_t { kPlain, kQuoted };
  struct Tree;
  class YamlReader;
  class JsonReader;

  // The root; null if the document is empty. Throws InputError for all that is wrong.
  static const DocumentNode* ReadYaml(const std::shared_ptr<Tree>& tree);
  // Reads JSON as our own plans are written, in an eighth of the time that yaml-cpp takes. It does
  // not tell what is wrong: it returns null for whatever it does not know (comments, characters by
  // number, a key given twice), which is left to yaml-cpp, and what it knows means the same to
  // yaml-cpp.
  static const DocumentNode* ReadJson(Tree& tree);

  std::string Describe() const;
  std::vector<std::string> Keys() const;

  const std::string* file;
  std::string_view text = {};                       // of a scalar
  std::span<const DocumentNode* const> keys = {};   // of a map, scalars, as many as items
  std::span<const DocumentNode* const> items = {};  // of a map or a list
  int line;
  int column;  // in bytes, like a compiler's
  Kind kind;
  Style style = Style::kPlain;  // of a scalar
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
  std::string text;  // all that was read
  std::deque<DocumentNode> nodes;
  std::deque<std::string> texts;  // of scalars that are written otherwise than they are meant
  std::deque<std::vector<const DocumentNode*>> lists;
};

}  // namespace assay
