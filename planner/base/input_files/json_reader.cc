#include <algorithm>

#include "planner/base/input_files/decimal_text.h"
#include "planner/base/input_files/document_tree.h"

namespace assay {

class DocumentNode::JsonReader {
 public:
  explicit JsonReader(Tree& tree) : tree_(tree), rest_(tree.text) {}

  // Returns the root, or null if yaml-cpp has to read the text.
  const DocumentNode* Read();

 private:
  using List = std::vector<const DocumentNode*>;

  void SkipSpace();
  bool Take(char c);  // skips space first
  DocumentNode& Make(Kind kind) const;
  const DocumentNode* ReadValue(std::size_t depth);
  const DocumentNode* ReadList(std::size_t depth);
  const DocumentNode* ReadMap(std::size_t depth);
  const DocumentNode* ReadKey();
  const DocumentNode* ReadQuoted();
  const DocumentNode* ReadPlain();
  bool ReadEscapes(std::string_view written, std::string& meant) const;

  Tree& tree_;
  std::string_view rest_;
  int line_ = 1;
  const char* line_start_ = rest_.data();
};

const DocumentNode* DocumentNode::JsonReader::Read() {
  SkipSpace();
  if (!rest_.starts_with('{') && !rest_.starts_with('[')) return nullptr;
  const DocumentNode* const root = ReadValue(0);
  SkipSpace();
  return rest_.empty() ? root : nullptr;
}

void DocumentNode::JsonReader::SkipSpace() {
  while (!rest_.empty()) {
    const char c = rest_.front();
    if (c != ' ' && c != '\n') return;
    rest_.remove_prefix(1);
    if (c == ' ') continue;
    ++line_;
    line_start_ = rest_.data();
  }
}

bool DocumentNode::JsonReader::Take(char c) {
  SkipSpace();
  if (!rest_.starts_with(c)) return false;
  rest_.remove_prefix(1);
  return true;
}

// Makes a node at the place of the next character.
DocumentNode& DocumentNode::JsonReader::Make(Kind kind) const {
  return tree_.Add(kind, line_, static_cast<int>(rest_.data() - line_start_) + 1);
}

const DocumentNode* DocumentNode::JsonReader::ReadValue(std::size_t depth) {
  SkipSpace();
  if (rest_.starts_with('[')) return ReadList(depth);
  if (rest_.starts_with('{')) return ReadMap(depth);
  return rest_.starts_with('"') ? ReadQuoted() : ReadPlain();
}

const DocumentNode* DocumentNode::JsonReader::ReadList(std::size_t depth) {
  if (depth == kMaxDepth) return nullptr;
  DocumentNode& list = Make(Kind::kList);
  rest_.remove_prefix(1);
  if (Take(']')) return &list;
  List items;
  do {
    items.push_back(ReadValue(depth + 1));
    if (items.back() == nullptr) return nullptr;
  } while (Take(','));
  list.items = tree_.Keep(items);
  return Take(']') ? &list : nullptr;
}

const DocumentNode* DocumentNode::JsonReader::ReadMap(std::size_t depth) {
  if (depth == kMaxDepth) return nullptr;
  DocumentNode& map = Make(Kind::kMap);
  rest_.remove_prefix(1);
  if (Take('}')) return &map;
  List keys, items;
  do {
    keys.push_back(ReadKey());
    if (keys.back() == nullptr) return nullptr;
    items.push_back(ReadValue(depth + 1));
    if (items.back() == nullptr) return nullptr;
  } while (Take(','));
  std::vector<std::string_view> names;
  for (const DocumentNode* key : keys) names.push_back(key->text);
  std::ranges::sort(names);
  if (std::ranges::adjacent_find(names) != names.end()) return nullptr;
  map.keys = tree_.Keep(keys);
  map.items = tree_.Keep(items);
  return Take('}') ? &map : nullptr;
}

// Reads a key and the colon directly after it. yaml-cpp accepts no keys longer than about a
// kilobyte.
const DocumentNode* DocumentNode::JsonReader::ReadKey() {
  constexpr std::size_t kLongest = 1000;
  SkipSpace();
  if (!rest_.starts_with('"')) return nullptr;
  const std::size_t before = rest_.size();
  const DocumentNode* const key = ReadQuoted();
  if (key == nullptr || before - rest_.size() > kLongest || !rest_.starts_with(':')) return nullptr;
  rest_.remove_prefix(1);
  return key;
}

const DocumentNode* DocumentNode::JsonReader::ReadQuoted() {
  std::size_t end = 1;
  bool is_escaped = false;
  for (; end < rest_.size() && rest_[end] != '"'; ++end) {
    if (static_cast<unsigned char>(rest_[end]) < 0x20) return nullptr;
    if (rest_[end] != '\\') continue;
    is_escaped = true;
    ++end;
  }
  if (end >= rest_.size()) return nullptr;
  DocumentNode& quoted = Make(Kind::kScalar);
  quoted.style = Style::kQuoted;
  quoted.text = rest_.substr(1, end - 1);
  if (is_escaped) {
    std::string meant;
    if (!ReadEscapes(quoted.text, meant)) return nullptr;
    quoted.text = tree_.Keep(std::move(meant));
  }
  rest_.remove_prefix(end + 1);
  return &quoted;
}

bool DocumentNode::JsonReader::ReadEscapes(std::string_view written, std::string& meant) const {
  constexpr std::string_view kNames = "\"\\/bfnrt";
  constexpr std::string_view kMeanings = "\"\\/\b\f\n\r\t";
  for (std::size_t i = 0; i < written.size(); ++i) {
    if (written[i] != '\\') {
      meant += written[i];
      continue;
    }
    const std::size_t name = kNames.find(written[++i]);
    if (name == std::string_view::npos) return false;
    meant += kMeanings[name];
  }
  return true;
}

// Reads a number, true or false. Null is left to yaml-cpp, because no format of this program uses
// it.
const DocumentNode* DocumentNode::JsonReader::ReadPlain() {
  const std::string_view written = rest_.substr(0, rest_.find_first_of(",]} \n"));
  if (written != "true" && written != "false" && !IsDecimal(written)) return nullptr;
  DocumentNode& plain = Make(Kind::kScalar);
  plain.text = written;
  rest_.remove_prefix(written.size());
  return &plain;
}

const DocumentNode* DocumentNode::ReadJson(Tree& tree) { return JsonReader(tree).Read(); }

}  // namespace assay
