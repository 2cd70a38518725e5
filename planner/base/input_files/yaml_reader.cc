#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <optional>
#include <sstream>
#include <unordered_map>

#include "planner/base/input_files/document_tree.h"
#include "planner/base/input_files/quotation.h"

namespace assay {
namespace {

// Returns true if the quotation mark that begins the text is closed within it. Two single quotation
// marks in a row stand for one.
bool IsClosed(std::string_view text) {
  const char quote = text[0];
  for (std::size_t i = 1; i < text.size(); ++i) {
    const bool doubled = quote == '\'' && text.substr(i).starts_with("''");
    if (doubled || (quote == '"' && text[i] == '\\')) {
      ++i;
    } else if (text[i] == quote) {
      return true;
    }
  }
  return false;
}

}  // namespace

// Builds the tree from yaml-cpp's events. The tree of yaml-cpp itself is not suitable: it has
// resolved the aliases and dropped the anchors, it keeps the last of equal keys, and it ends after
// one document.
class DocumentNode::YamlReader : public YAML::EventHandler {
 public:
  explicit YamlReader(std::shared_ptr<Tree> tree) : tree_(std::move(tree)), text_(tree_->text) {}

  // Returns the root, or null if the document is empty.
  const DocumentNode* Read();

  void OnDocumentStart(const YAML::Mark& mark) override;
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override;
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override;
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& text) override;
  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value style) override;
  void OnSequenceEnd() override { End(); }
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value style) override;
  void OnMapEnd() override { End(); }

 private:
  // A map or a list whose end has not been read yet.
  struct Open {
    DocumentNode* node;
    const DocumentNode* key = nullptr;  // of a map, without its value so far
    std::vector<const DocumentNode*> keys = {};
    std::vector<const DocumentNode*> items = {};
    std::unordered_map<std::string_view, int> line_of_key = {};
  };

  FilePlace At(const YAML::Mark& mark) const;
  std::size_t LineStart(std::size_t end) const;
  FilePlace Before(const YAML::Mark& mark) const;
  FilePlace OfNull(const YAML::Mark& mark) const;
  bool SpellsNull(const YAML::Mark& mark) const;
  char CharacterAt(const YAML::Mark& mark) const;
  std::string Rest(const YAML::Mark& mark) const;
  void CheckLastQuote() const;
  [[noreturn]] void Refuse(const YAML::Exception& error) const;
  void RefuseExtras(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor) const;
  DocumentNode& Make(Kind kind, const FilePlace& place) const;
  void Begin(Kind kind, const YAML::Mark& mark);
  void End();
  void Add(const DocumentNode& node);
  void AddKey(Open& map, const DocumentNode& key) const;
  [[noreturn]] void Fail(const DocumentNode& node, const std::string& what,
                         const std::string& allowed) const;

  std::shared_ptr<Tree> tree_;
  const std::string& text_;  // refers to the tree's text
  const DocumentNode* root_ = nullptr;
  std::vector<Open> open_;
  FilePlace last_{.file = tree_->file, .line = 1, .column = 1};
  std::optional<YAML::Mark> last_quote_;  // the last quoted scalar
  int documents_ = 0;
};

const DocumentNode* DocumentNode::YamlReader::Read() {
  try {
    std::istringstream in(text_);
    YAML::Parser parser(in);
    while (parser.HandleNextDocument(*this)) {
    }
    CheckLastQuote();
  } catch (const InputError&) {
    throw;
  } catch (const YAML::Exception& error) {
    Refuse(error);
  } catch (const std::exception& error) {
    throw InputError(last_, fmt::format("not readable from here on: {}", error.what()),
                     "YAML or JSON");
  }
  return root_ && root_->kind != Kind::kNull ? root_ : nullptr;
}

// yaml-cpp resets the column at the end of the text, so the column is counted here.
FilePlace DocumentNode::YamlReader::At(const YAML::Mark& mark) const {
  if (mark.is_null()) return last_;
  const bool end = static_cast<std::size_t>(mark.pos) >= text_.size();
  const int column = end ? static_cast<int>(text_.size() - LineStart(text_.size())) : mark.column;
  return {.file = tree_->file, .line = mark.line + 1, .column = column + 1};
}

// Returns the start of the line that contains the character before `end`.
std::size_t DocumentNode::YamlReader::LineStart(std::size_t end) const {
  const std::size_t line_break = end == 0 ? std::string::npos : text_.rfind('\n', end - 1);
  return line_break == std::string::npos ? 0 : line_break + 1;
}

// Returns the place of the last character before the mark that is not white space.
FilePlace DocumentNode::YamlReader::Before(const YAML::Mark& mark) const {
  const auto end = std::min(static_cast<std::size_t>(std::max(mark.pos, 0)), text_.size());
  if (end == 0) return At(mark);
  const std::size_t found = text_.find_last_not_of(" \t\r\n", end - 1);
  if (found == std::string::npos) return At(mark);
  const auto skipped = std::string_view(text_).substr(found, end - found);
  const auto lines = static_cast<int>(std::count(skipped.begin(), skipped.end(), '\n'));
  if (lines == 0) {
    const int column = At(mark).column - static_cast<int>(skipped.size());
    return {.file = tree_->file, .line = mark.line + 1, .column = std::max(column, 1)};
  }
  return {.file = tree_->file,
          .line = mark.line + 1 - lines,
          .column = static_cast<int>(found - LineStart(found)) + 1};
}

// For a missing value yaml-cpp gives the place of whatever comes next, which is often a line too
// late.
FilePlace DocumentNode::YamlReader::OfNull(const YAML::Mark& mark) const {
  if (SpellsNull(mark)) return At(mark);
  if (!open_.empty() && open_.back().key != nullptr) {
    const DocumentNode& key = *open_.back().key;
    return {.file = tree_->file, .line = key.line, .column = key.column};
  }
  return Before(mark);
}

bool DocumentNode::YamlReader::SpellsNull(const YAML::Mark& mark) const {
  const std::string rest = Rest(mark);
  for (std::string_view name : {"~", "null", "Null", "NULL"}) {
    if (rest.starts_with(name)) return true;
  }
  return false;
}

// Returns NUL at the end of the text, since no text contains it.
char DocumentNode::YamlReader::CharacterAt(const YAML::Mark& mark) const {
  const bool inside = !mark.is_null() && static_cast<std::size_t>(mark.pos) < text_.size();
  return inside ? text_[static_cast<std::size_t>(mark.pos)] : '\0';
}

// yaml-cpp accepts the end of the file as the end of a quotation if a line break precedes it.
void DocumentNode::YamlReader::CheckLastQuote() const {
  if (!last_quote_) return;
  if (IsClosed(std::string_view(text_).substr(static_cast<std::size_t>(last_quote_->pos)))) return;
  throw InputError(At(*last_quote_),
                   fmt::format("the quote is never closed at {}", Quote(Rest(*last_quote_))),
                   "YAML or JSON");
}

// Returns as much of the text after the mark as a message may need.
std::string DocumentNode::YamlReader::Rest(const YAML::Mark& mark) const {
  if (CharacterAt(mark) == '\0') return "";
  const auto start = static_cast<std::size_t>(mark.pos);
  const std::string some = text_.substr(start, 4 * (kQuotedCharacters + 1));
  return some.substr(0, some.find_first_of("\r\n"));
}

void DocumentNode::YamlReader::Refuse(const YAML::Exception& error) const {
  const std::string rest = Rest(error.mark);
  throw InputError(
      At(error.mark),
      fmt::format("{}, at {}", error.msg, rest.empty() ? "the end of the line" : Quote(rest)),
      "YAML or JSON");
}

// With an alias two places share one value, so no error could name the right place. A tag changes
// the meaning of a value, and no format of this program defines tags.
void DocumentNode::YamlReader::RefuseExtras(const YAML::Mark& mark, const std::string& tag,
                                            YAML::anchor_t anchor) const {
  if (anchor != YAML::NullAnchor) {
    throw InputError(At(mark), fmt::format("anchor or alias at {}", Quote(Rest(mark))),
                     "no anchors and aliases");
  }
  const bool named = tag != "" && tag != "?" && tag != "!";  // the tags of plain and quoted scalars
  if (named || CharacterAt(mark) == '!') {
    throw InputError(At(mark), fmt::format("tag at {}", Quote(Rest(mark))), "no tags");
  }
}

DocumentNode& DocumentNode::YamlReader::Make(Kind kind, const FilePlace& place) const {
  return tree_->Add(kind, place.line, place.column);
}

void DocumentNode::YamlReader::Fail(const DocumentNode& node, const std::string& what,
                                    const std::string& allowed) const {
  throw InputError({.file = *node.file, .line = node.line, .column = node.column}, what, allowed);
}

void DocumentNode::YamlReader::AddKey(Open& map, const DocumentNode& key) const {
  if (key.kind != Kind::kScalar) {
    Fail(key, fmt::format("{} cannot be the key of a map", key.Describe()), "a text as the key");
  }
  const auto [twin, first] = map.line_of_key.emplace(key.text, key.line);
  if (!first) {
    Fail(key,
         fmt::format("key {} is given twice, first in line {}", Quote(twin->first), twin->second),
         "each key once");
  }
  map.key = &key;
}

void DocumentNode::YamlReader::Add(const DocumentNode& node) {
  if (open_.empty()) {
    root_ = &node;
    return;
  }
  Open& parent = open_.back();
  if (parent.node->kind == Kind::kMap && parent.key == nullptr) {
    AddKey(parent, node);
    return;
  }
  if (parent.key != nullptr) parent.keys.push_back(std::exchange(parent.key, nullptr));
  parent.items.push_back(&node);
}

void DocumentNode::YamlReader::Begin(Kind kind, const YAML::Mark& mark) {
  if (open_.size() == kMaxDepth) {
    throw InputError(At(mark), fmt::format("nested too deeply at {}", Quote(Rest(mark))),
                     fmt::format("{} maps and lists in each other", kMaxDepth));
  }
  last_ = At(mark);
  open_.push_back({.node = &Make(kind, last_)});
}

// Adds the node to its parent only when the node ends. yaml-cpp mistakes a list that is not closed
// for a key. If such a list were added when it begins, AddKey would report a wrong key. As it is,
// yaml-cpp reports the missing end of the list first, which is the clearer error.
void DocumentNode::YamlReader::End() {
  const Open& last = open_.back();
  DocumentNode& node = *last.node;
  node.keys = tree_->Keep(last.keys);
  node.items = tree_->Keep(last.items);
  open_.pop_back();
  Add(node);
}

void DocumentNode::YamlReader::OnDocumentStart(const YAML::Mark& mark) {
  if (++documents_ == 1) return;
  throw InputError(At(mark), fmt::format("a second document starts at {}", Quote(Rest(mark))),
                   "one document in a file");
}

void DocumentNode::YamlReader::OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) {
  RefuseExtras(mark, "", anchor);
  Add(Make(Kind::kNull, OfNull(mark)));
}

void DocumentNode::YamlReader::OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) {
  RefuseExtras(mark, "", anchor);
}

void DocumentNode::YamlReader::OnScalar(const YAML::Mark& mark, const std::string& tag,
                                        YAML::anchor_t anchor, const std::string& text) {
  RefuseExtras(mark, tag, anchor);
  last_ = At(mark);
  DocumentNode& node = Make(Kind::kScalar, last_);
  node.text = tree_->Keep(text);
  node.style = tag == "!" ? Style::kQuoted : Style::kPlain;
  if (CharacterAt(mark) == '"' || CharacterAt(mark) == '\'') last_quote_ = mark;
  Add(node);
}

void DocumentNode::YamlReader::OnSequenceStart(const YAML::Mark& mark, const std::string& tag,
                                               YAML::anchor_t anchor, YAML::EmitterStyle::value) {
  RefuseExtras(mark, tag, anchor);
  Begin(Kind::kList, mark);
}

void DocumentNode::YamlReader::OnMapStart(const YAML::Mark& mark, const std::string& tag,
                                          YAML::anchor_t anchor, YAML::EmitterStyle::value) {
  RefuseExtras(mark, tag, anchor);
  Begin(Kind::kMap, mark);
}

const DocumentNode* DocumentNode::ReadYaml(const std::shared_ptr<Tree>& tree) {
  return YamlReader(tree).Read();
}

}  // namespace assay
