#include "planner/base/document.h"

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <deque>
#include <fstream>
#include <functional>
#include <limits>
#include <span>
#include <sstream>
#include <system_error>
#include <unordered_map>

#include "planner/base/check.h"

namespace assay {
namespace {

constexpr std::size_t kMaxBytes = std::size_t{8} << 20;
constexpr std::size_t kMaxDepth = 256;         // of maps and lists in each other
constexpr std::size_t kQuotedCharacters = 60;  // of the offending text in a message

struct CodePoint {
  char32_t value = 0;
  std::size_t bytes = 0;  // 0: the bytes are not UTF-8
};

std::size_t Utf8Length(unsigned char lead) {
  if (lead < 0x80) return 1;
  if (lead >> 5 == 0x06) return 2;
  if (lead >> 4 == 0x0e) return 3;
  if (lead >> 3 == 0x1e) return 4;
  return 0;
}

// The first code point of a text that is not empty, by RFC 3629: no overlong forms, no surrogates.
CodePoint Decode(std::string_view text) {
  constexpr std::array<char32_t, 5> kLeast = {0, 0, 0x80, 0x800, 0x10000};
  const auto lead = static_cast<unsigned char>(text[0]);
  const std::size_t bytes = Utf8Length(lead);
  if (bytes == 0 || bytes > text.size()) return {};
  char32_t value = bytes == 1 ? lead : lead & (0x7fu >> bytes);
  for (std::size_t i = 1; i < bytes; ++i) {
    const auto next = static_cast<unsigned char>(text[i]);
    if (next >> 6 != 0x02) return {};
    value = value << 6 | (next & 0x3fu);
  }
  const bool surrogate = value >= 0xd800 && value <= 0xdfff;
  if (value < kLeast[bytes] || surrogate || value > 0x10ffff) return {};
  return {.value = value, .bytes = bytes};
}

bool IsControl(char32_t c) { return c < 0x20 || (c >= 0x7f && c < 0xa0); }

std::string Visible(char32_t control) {
  if (control == U'\n') return "\\n";
  if (control == U'\r') return "\\r";
  if (control == U'\t') return "\\t";
  return fmt::format("\\x{:02x}", static_cast<std::uint32_t>(control));
}

// At most `limit` characters of the text, on one line.
std::string Show(std::string_view text, std::size_t limit) {
  std::string shown;
  for (std::size_t i = 0; i < limit && !text.empty(); ++i) {
    const CodePoint c = Decode(text);
    const std::size_t bytes = std::max<std::size_t>(c.bytes, 1);
    const char32_t control = c.bytes > 0 ? c.value : static_cast<unsigned char>(text[0]);
    shown +=
        c.bytes == 0 || IsControl(c.value) ? Visible(control) : std::string(text.substr(0, bytes));
    text.remove_prefix(bytes);
  }
  return text.empty() ? shown : shown + "...";
}

std::string Quote(std::string_view text) {
  return fmt::format("'{}'", Show(text, kQuotedCharacters));
}

std::string Join(const std::vector<std::string>& names) {
  return names.empty() ? "nothing" : fmt::format("{}", fmt::join(names, ", "));
}

std::string DidYouMean(std::string_view text, const std::vector<std::string>& names) {
  const std::string nearest = NearestName(text, names);
  return nearest.empty() ? "" : fmt::format("; did you mean '{}'?", nearest);
}

std::size_t CountDigits(std::string_view text) {
  return std::min(text.find_first_not_of("0123456789"), text.size());
}

std::string_view SkipSign(std::string_view text) {
  if (!text.empty() && (text[0] == '+' || text[0] == '-')) text.remove_prefix(1);
  return text;
}

bool IsInteger(std::string_view text) {
  text = SkipSign(text);
  return !text.empty() && CountDigits(text) == text.size();
}

// YAML 1.2's decimal floats and integers, which contain JSON's numbers: [-+]? ( \. [0-9]+ |
// [0-9]+ ( \. [0-9]* )? ) ( [eE] [-+]? [0-9]+ )?
bool IsDecimal(std::string_view text) {
  text = SkipSign(text);
  std::size_t digits = CountDigits(text);
  text.remove_prefix(digits);
  if (!text.empty() && text[0] == '.') {
    text.remove_prefix(1);
    const std::size_t fraction = CountDigits(text);
    digits += fraction;
    text.remove_prefix(fraction);
  }
  if (digits == 0) return false;
  return text.empty() || ((text[0] == 'e' || text[0] == 'E') && IsInteger(text.substr(1)));
}

// Empty if the number does not fit. Unlike strtod, from_chars ignores the locale; it refuses '+'.
template <class T>
std::optional<T> Convert(std::string_view digits) {
  if (digits[0] == '+') digits.remove_prefix(1);
  T value{};
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc()) return std::nullopt;
  return value;
}

// What YAML calls printable, which leaves out NUL and with it binary files and UTF-16.
bool IsPrintable(char32_t c) {
  return c == U'\t' || c == U'\n' || c == U'\r' || c == 0x85 || (!IsControl(c) && c < 0xfffe) ||
         c >= 0x10000;
}

// yaml-cpp would silently replace wrong UTF-8, and takes the control character 4 for the end.
void CheckCharacters(std::string_view text, const std::string& file_name) {
  FilePlace place{.file = file_name, .line = 1, .column = 1};
  const auto is_plain = [](char c) { return c >= 0x20 && c < 0x7f; };  // most are
  while (true) {
    const auto plain = std::ranges::find_if_not(text, is_plain) - text.begin();
    place.column += static_cast<int>(plain);
    text.remove_prefix(static_cast<std::size_t>(plain));
    if (text.empty()) return;
    const CodePoint c = Decode(text);
    if (c.bytes == 0 || !IsPrintable(c.value)) {
      throw InputError(place,
                       fmt::format("the byte 0x{:02x} is not part of a text",
                                   static_cast<unsigned char>(text[0])),
                       "UTF-8 without control characters");
    }
    place.column = c.value == U'\n' ? 1 : place.column + static_cast<int>(c.bytes);
    place.line += c.value == U'\n' ? 1 : 0;
    text.remove_prefix(c.bytes);
  }
}

// Whether the quote that begins the text is closed in it. Doubled single quotes stand for one.
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

// At most one block more than Parse takes, so that Parse finds a file too large.
std::string ReadAll(std::istream& in) {
  std::string text;
  std::vector<char> block(std::size_t{1} << 16);
  while (in && text.size() <= kMaxBytes) {
    in.read(block.data(), static_cast<std::streamsize>(block.size()));
    text.append(block.data(), static_cast<std::size_t>(in.gcount()));
  }
  return text;
}

// The optimal string alignment distance (Damerau 1964): insertions, deletions, substitutions and
// swaps of neighbours each cost one.
std::size_t EditDistance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before, previous(b.size() + 1), current(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) current[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    before = std::exchange(previous, current);
    current[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substitution = previous[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      current[j] = std::min({substitution, previous[j] + 1, current[j - 1] + 1});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) current[j] = std::min(current[j], before[j - 2] + 1);
    }
  }
  return current[b.size()];
}

}  // namespace

// Nodes lie in their document's tree, where texts and lists are kept once and together: plans have
// tens of thousands of numbers. A Value keeps the whole tree alive.
struct Value::Node {
  enum class Kind : std::uint8_t { kNull, kScalar, kList, kMap };
  enum class Style : std::uint8_t { kPlain, kQuoted };
  struct Tree;
  class Reader;
  class JsonReader;

  std::string Describe() const;
  std::vector<std::string> Keys() const;

  const std::string* file;
  std::string_view text = {};               // of a scalar
  std::span<const Node* const> keys = {};   // of a map, scalars, as many as items
  std::span<const Node* const> items = {};  // of a map or a list
  int line;
  int column;  // in bytes, like a compiler's
  Kind kind;
  Style style = Style::kPlain;  // of a scalar
};

struct Value::Node::Tree {
  Tree(std::string name, std::string read) : file(std::move(name)), text(std::move(read)) {}
  Tree(const Tree&) = delete;
  Tree& operator=(const Tree&) = delete;

  Node& Add(Kind kind, int line, int column) {
    return nodes.emplace_back(Node{.file = &file, .line = line, .column = column, .kind = kind});
  }
  std::string_view Keep(std::string written) { return texts.emplace_back(std::move(written)); }
  std::span<const Node* const> Keep(std::span<const Node* const> list) {
    if (list.empty()) return {};
    return lists.emplace_back(list.begin(), list.end());
  }

  std::string file;  // its name
  std::string text;  // all that was read
  std::deque<Node> nodes;
  std::deque<std::string> texts;  // of scalars that are written otherwise than they are meant
  std::deque<std::vector<const Node*>> lists;
};

// What stands at the node, for a message.
std::string Value::Node::Describe() const {
  switch (kind) {
    case Kind::kNull:
      return "nothing";
    case Kind::kScalar:
      return style == Style::kQuoted ? "the quoted text " + Quote(text) : Quote(text);
    case Kind::kList:
      return fmt::format("a list of length {}", items.size());
    case Kind::kMap:
      return fmt::format("a map with the keys {}", Quote(Join(Keys())));
  }
  ASSAY_CHECK(false);
}

std::vector<std::string> Value::Node::Keys() const {
  std::vector<std::string> names;
  for (const Node* key : keys) names.emplace_back(key->text);
  return names;
}

// Builds the tree from yaml-cpp's events. Its own tree would not do: it has dissolved the aliases
// and forgotten the anchors, it keeps the last of equal keys, and it stops after one document.
class Value::Node::Reader : public YAML::EventHandler {
 public:
  explicit Reader(std::shared_ptr<Tree> tree) : tree_(std::move(tree)), text_(tree_->text) {}

  // The root; null if the document is empty.
  const Node* Read();

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
  // A map or a list whose end has not come yet.
  struct Open {
    Node* node;
    const Node* key = nullptr;  // of a map, without its value so far
    std::vector<const Node*> keys = {};
    std::vector<const Node*> items = {};
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
  Node& Make(Kind kind, const FilePlace& place) const;
  void Begin(Kind kind, const YAML::Mark& mark);
  void End();
  void Add(const Node& node);
  void AddKey(Open& map, const Node& key) const;
  [[noreturn]] void Fail(const Node& node, const std::string& what,
                         const std::string& allowed) const;

  std::shared_ptr<Tree> tree_;
  const std::string& text_;  // the tree's
  const Node* root_ = nullptr;
  std::vector<Open> open_;
  FilePlace last_{.file = tree_->file, .line = 1, .column = 1};
  std::optional<YAML::Mark> last_quote_;  // of the last quoted scalar
  int documents_ = 0;
};

const Value::Node* Value::Node::Reader::Read() {
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

// yaml-cpp resets the column at the end of the text, so there it is counted anew.
FilePlace Value::Node::Reader::At(const YAML::Mark& mark) const {
  if (mark.is_null()) return last_;
  const bool end = static_cast<std::size_t>(mark.pos) >= text_.size();
  const int column = end ? static_cast<int>(text_.size() - LineStart(text_.size())) : mark.column;
  return {.file = tree_->file, .line = mark.line + 1, .column = column + 1};
}

// Where the line begins that goes on before `end`.
std::size_t Value::Node::Reader::LineStart(std::size_t end) const {
  const std::size_t line_break = end == 0 ? std::string::npos : text_.rfind('\n', end - 1);
  return line_break == std::string::npos ? 0 : line_break + 1;
}

// The last character before the mark that is not white space.
FilePlace Value::Node::Reader::Before(const YAML::Mark& mark) const {
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

// yaml-cpp marks a value that is left out at whatever comes next, often a line too late.
FilePlace Value::Node::Reader::OfNull(const YAML::Mark& mark) const {
  if (SpellsNull(mark)) return At(mark);
  if (!open_.empty() && open_.back().key != nullptr) {
    const Node& key = *open_.back().key;
    return {.file = tree_->file, .line = key.line, .column = key.column};
  }
  return Before(mark);
}

bool Value::Node::Reader::SpellsNull(const YAML::Mark& mark) const {
  const std::string rest = Rest(mark);
  for (std::string_view name : {"~", "null", "Null", "NULL"}) {
    if (rest.starts_with(name)) return true;
  }
  return false;
}

// NUL, which no text contains, at the end.
char Value::Node::Reader::CharacterAt(const YAML::Mark& mark) const {
  const bool inside = !mark.is_null() && static_cast<std::size_t>(mark.pos) < text_.size();
  return inside ? text_[static_cast<std::size_t>(mark.pos)] : '\0';
}

// yaml-cpp lets the end of the file close a quote when a line break stands before it.
void Value::Node::Reader::CheckLastQuote() const {
  if (!last_quote_) return;
  if (IsClosed(std::string_view(text_).substr(static_cast<std::size_t>(last_quote_->pos)))) return;
  throw InputError(At(*last_quote_),
                   fmt::format("the quote is never closed at {}", Quote(Rest(*last_quote_))),
                   "YAML or JSON");
}

// The text from the mark on, as far as a message may want it.
std::string Value::Node::Reader::Rest(const YAML::Mark& mark) const {
  if (CharacterAt(mark) == '\0') return "";
  const auto start = static_cast<std::size_t>(mark.pos);
  const std::string some = text_.substr(start, 4 * (kQuotedCharacters + 1));
  return some.substr(0, some.find_first_of("\r\n"));
}

void Value::Node::Reader::Refuse(const YAML::Exception& error) const {
  const std::string rest = Rest(error.mark);
  throw InputError(
      At(error.mark),
      fmt::format("{}, at {}", error.msg, rest.empty() ? "the end of the line" : Quote(rest)),
      "YAML or JSON");
}

// An alias makes two places share one value, so no error could name the right one; a tag changes
// the meaning of a value in a way that no format here defines.
void Value::Node::Reader::RefuseExtras(const YAML::Mark& mark, const std::string& tag,
                                       YAML::anchor_t anchor) const {
  if (anchor != YAML::NullAnchor) {
    throw InputError(At(mark), fmt::format("anchor or alias at {}", Quote(Rest(mark))),
                     "no anchors and aliases");
  }
  const bool named = tag != "" && tag != "?" && tag != "!";  // yaml-cpp's for plain and quoted
  if (named || CharacterAt(mark) == '!') {
    throw InputError(At(mark), fmt::format("tag at {}", Quote(Rest(mark))), "no tags");
  }
}

Value::Node& Value::Node::Reader::Make(Kind kind, const FilePlace& place) const {
  return tree_->Add(kind, place.line, place.column);
}

void Value::Node::Reader::Fail(const Node& node, const std::string& what,
                               const std::string& allowed) const {
  Value({tree_, &node}).Fail(what, allowed);
}

void Value::Node::Reader::AddKey(Open& map, const Node& key) const {
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

void Value::Node::Reader::Add(const Node& node) {
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

void Value::Node::Reader::Begin(Kind kind, const YAML::Mark& mark) {
  if (open_.size() == kMaxDepth) {
    throw InputError(At(mark), fmt::format("nested too deeply at {}", Quote(Rest(mark))),
                     fmt::format("{} maps and lists in each other", kMaxDepth));
  }
  last_ = At(mark);
  open_.push_back({.node = &Make(kind, last_)});
}

// Only now does the parent learn of the node: yaml-cpp takes a list that never ends for a key, and
// its own error, which comes before this, says it better than AddKey would.
void Value::Node::Reader::End() {
  const Open& last = open_.back();
  Node& node = *last.node;
  node.keys = tree_->Keep(last.keys);
  node.items = tree_->Keep(last.items);
  open_.pop_back();
  Add(node);
}

void Value::Node::Reader::OnDocumentStart(const YAML::Mark& mark) {
  if (++documents_ == 1) return;
  throw InputError(At(mark), fmt::format("a second document starts at {}", Quote(Rest(mark))),
                   "one document in a file");
}

void Value::Node::Reader::OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) {
  RefuseExtras(mark, "", anchor);
  Add(Make(Kind::kNull, OfNull(mark)));
}

void Value::Node::Reader::OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) {
  RefuseExtras(mark, "", anchor);
}

void Value::Node::Reader::OnScalar(const YAML::Mark& mark, const std::string& tag,
                                   YAML::anchor_t anchor, const std::string& text) {
  RefuseExtras(mark, tag, anchor);
  last_ = At(mark);
  Node& node = Make(Kind::kScalar, last_);
  node.text = tree_->Keep(text);
  node.style = tag == "!" ? Style::kQuoted : Style::kPlain;
  if (CharacterAt(mark) == '"' || CharacterAt(mark) == '\'') last_quote_ = mark;
  Add(node);
}

void Value::Node::Reader::OnSequenceStart(const YAML::Mark& mark, const std::string& tag,
                                          YAML::anchor_t anchor, YAML::EmitterStyle::value) {
  RefuseExtras(mark, tag, anchor);
  Begin(Kind::kList, mark);
}

void Value::Node::Reader::OnMapStart(const YAML::Mark& mark, const std::string& tag,
                                     YAML::anchor_t anchor, YAML::EmitterStyle::value) {
  RefuseExtras(mark, tag, anchor);
  Begin(Kind::kMap, mark);
}

// Reads JSON as our own plans are written, in an eighth of the time that yaml-cpp takes. It does
// not tell what is wrong: whatever it does not know (comments, characters by number, a key given
// twice) is left to yaml-cpp, and what it knows means the same to yaml-cpp.
class Value::Node::JsonReader {
 public:
  explicit JsonReader(Tree& tree) : tree_(tree), rest_(tree.text) {}

  // The root; null if yaml-cpp is to read it.
  const Node* Read();

 private:
  using List = std::vector<const Node*>;

  void SkipSpace();
  bool Take(char c);  // after space
  Node& Make(Kind kind) const;
  const Node* ReadValue(std::size_t depth);
  const Node* ReadList(std::size_t depth);
  const Node* ReadMap(std::size_t depth);
  const Node* ReadKey();
  const Node* ReadQuoted();
  const Node* ReadPlain();
  bool ReadEscapes(std::string_view written, std::string& meant) const;

  Tree& tree_;
  std::string_view rest_;
  int line_ = 1;
  const char* line_start_ = rest_.data();
};

const Value::Node* Value::Node::JsonReader::Read() {
  SkipSpace();
  if (!rest_.starts_with('{') && !rest_.starts_with('[')) return nullptr;
  const Node* const root = ReadValue(0);
  SkipSpace();
  return rest_.empty() ? root : nullptr;
}

void Value::Node::JsonReader::SkipSpace() {
  while (!rest_.empty()) {
    const char c = rest_.front();
    if (c != ' ' && c != '\n') return;
    rest_.remove_prefix(1);
    if (c == ' ') continue;
    ++line_;
    line_start_ = rest_.data();
  }
}

bool Value::Node::JsonReader::Take(char c) {
  SkipSpace();
  if (!rest_.starts_with(c)) return false;
  rest_.remove_prefix(1);
  return true;
}

// At what comes next.
Value::Node& Value::Node::JsonReader::Make(Kind kind) const {
  return tree_.Add(kind, line_, static_cast<int>(rest_.data() - line_start_) + 1);
}

const Value::Node* Value::Node::JsonReader::ReadValue(std::size_t depth) {
  SkipSpace();
  if (rest_.starts_with('[')) return ReadList(depth);
  if (rest_.starts_with('{')) return ReadMap(depth);
  return rest_.starts_with('"') ? ReadQuoted() : ReadPlain();
}

const Value::Node* Value::Node::JsonReader::ReadList(std::size_t depth) {
  if (depth == kMaxDepth) return nullptr;
  Node& list = Make(Kind::kList);
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

const Value::Node* Value::Node::JsonReader::ReadMap(std::size_t depth) {
  if (depth == kMaxDepth) return nullptr;
  Node& map = Make(Kind::kMap);
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
  for (const Node* key : keys) names.push_back(key->text);
  std::ranges::sort(names);
  if (std::ranges::adjacent_find(names) != names.end()) return nullptr;
  map.keys = tree_.Keep(keys);
  map.items = tree_.Keep(items);
  return Take('}') ? &map : nullptr;
}

// With its colon, which stands directly behind. yaml-cpp takes no longer keys than a kilobyte.
const Value::Node* Value::Node::JsonReader::ReadKey() {
  constexpr std::size_t kLongest = 1000;
  SkipSpace();
  if (!rest_.starts_with('"')) return nullptr;
  const std::size_t before = rest_.size();
  const Node* const key = ReadQuoted();
  if (key == nullptr || before - rest_.size() > kLongest || !rest_.starts_with(':')) return nullptr;
  rest_.remove_prefix(1);
  return key;
}

const Value::Node* Value::Node::JsonReader::ReadQuoted() {
  std::size_t end = 1;
  bool is_escaped = false;
  for (; end < rest_.size() && rest_[end] != '"'; ++end) {
    if (static_cast<unsigned char>(rest_[end]) < 0x20) return nullptr;
    if (rest_[end] != '\\') continue;
    is_escaped = true;
    ++end;
  }
  if (end >= rest_.size()) return nullptr;
  Node& quoted = Make(Kind::kScalar);
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

bool Value::Node::JsonReader::ReadEscapes(std::string_view written, std::string& meant) const {
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

// A number, true or false. Null is left to yaml-cpp: no format here has it.
const Value::Node* Value::Node::JsonReader::ReadPlain() {
  const std::string_view written = rest_.substr(0, rest_.find_first_of(",]} \n"));
  if (written != "true" && written != "false" && !IsDecimal(written)) return nullptr;
  Node& plain = Make(Kind::kScalar);
  plain.text = written;
  rest_.remove_prefix(written.size());
  return &plain;
}

Value::Value(std::shared_ptr<const Node> node) : node_(std::move(node)) {}

bool Value::IsMap() const { return node_->kind == Node::Kind::kMap; }
bool Value::IsList() const { return node_->kind == Node::Kind::kList; }
bool Value::IsScalar() const { return node_->kind == Node::Kind::kScalar; }

std::string Value::Text() const {
  if (!IsScalar()) Fail(node_->Describe() + " is not a text", "a text");
  return std::string(node_->text);
}

double Value::Number() const {
  const std::string allowed = "a finite decimal number, such as 12, -0.5 or 2.5e-3, not quoted";
  const bool plain = IsScalar() && node_->style == Node::Style::kPlain;
  if (!plain || !IsDecimal(node_->text)) Fail(node_->Describe() + " is not a number", allowed);
  const std::optional<double> number = Convert<double>(node_->text);
  if (!number) Fail(node_->Describe() + " is out of the range of a double", allowed);
  return *number;
}

int Value::Integer(int low, int high) const {
  const std::string allowed = fmt::format("an integer from {} to {}, not quoted", low, high);
  const bool plain = IsScalar() && node_->style == Node::Style::kPlain;
  if (!plain || !IsInteger(node_->text)) Fail(node_->Describe() + " is not an integer", allowed);
  const std::optional<int> number = Convert<int>(node_->text);
  if (!number || *number < low || *number > high) {
    Fail(node_->Describe() + " is out of range", allowed);
  }
  return *number;
}

bool Value::Flag() const {
  const bool plain = IsScalar() && node_->style == Node::Style::kPlain;
  if (plain && node_->text == "true") return true;
  if (plain && node_->text == "false") return false;
  Fail(node_->Describe() + " is not a truth value", "true or false, not quoted");
}

std::vector<double> Value::Numbers(std::size_t count) const {
  if (!IsList() || node_->items.size() != count) {
    Fail(fmt::format("{} is not a list of {} numbers", node_->Describe(), count),
         fmt::format("a list of {} numbers", count));
  }
  std::vector<double> numbers;
  for (const Node* item : node_->items) numbers.push_back(Value({node_, item}).Number());
  return numbers;
}

int Value::OneOf(const std::vector<std::string>& names) const {
  if (!IsScalar()) Fail(node_->Describe() + " is not a name", Join(names));
  const auto found = std::find(names.begin(), names.end(), node_->text);
  if (found == names.end()) {
    Fail(fmt::format("unknown name {}{}", Quote(node_->text), DidYouMean(node_->text, names)),
         Join(names));
  }
  return static_cast<int>(found - names.begin());
}

Value Value::At(std::string_view key) const {
  std::optional<Value> value = Find(key);
  if (!value) {
    Fail(fmt::format("missing key '{}' in {}", key, node_->Describe()),
         fmt::format("a map with the key '{}'", key));
  }
  return *std::move(value);
}

std::optional<Value> Value::Find(std::string_view key) const {
  if (!IsMap()) {
    Fail(fmt::format("{} is not a map", node_->Describe()),
         fmt::format("a map with the key '{}'", key));
  }
  for (std::size_t i = 0; i < node_->keys.size(); ++i) {
    if (node_->keys[i]->text == key) return Value({node_, node_->items[i]});
  }
  return std::nullopt;
}

std::vector<Value> Value::Items() const {
  if (!IsList()) Fail(node_->Describe() + " is not a list", "a list");
  std::vector<Value> items;
  items.reserve(node_->items.size());
  for (const Node* item : node_->items) items.push_back(Value({node_, item}));
  return items;
}

std::vector<std::pair<Value, Value>> Value::Entries() const {
  if (!IsMap()) Fail(node_->Describe() + " is not a map", "a map");
  std::vector<std::pair<Value, Value>> entries;
  for (std::size_t i = 0; i < node_->keys.size(); ++i) {
    entries.emplace_back(Value({node_, node_->keys[i]}), Value({node_, node_->items[i]}));
  }
  return entries;
}

// A key that is given twice has been refused when the document was read.
void Value::AllowOnly(std::initializer_list<std::string_view> keys) const {
  const std::vector<std::string> names(keys.begin(), keys.end());
  if (!IsMap()) Fail(node_->Describe() + " is not a map", "a map with the keys " + Join(names));
  for (const Node* key : node_->keys) {
    const std::string_view text = key->text;
    if (std::find(names.begin(), names.end(), text) != names.end()) continue;
    Value({node_, key})
        .Fail(fmt::format("unknown key {}{}", Quote(text), DidYouMean(text, names)), Join(names));
  }
}

void Value::Fail(const std::string& what, const std::string& allowed) const {
  constexpr std::size_t kAll = std::numeric_limits<std::size_t>::max();
  throw InputError(Place(), Show(what, kAll), Show(allowed, kAll));
}

FilePlace Value::Place() const {
  return {.file = *node_->file, .line = node_->line, .column = node_->column};
}

Document Document::Load(const std::filesystem::path& file) {
  const FilePlace place{.file = file.string()};
  const std::string allowed = "a YAML or JSON file that can be read";
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status)) throw InputError(place, "no such file", allowed);
  if (std::filesystem::is_directory(status)) throw InputError(place, "is a directory", allowed);
  std::ifstream in(file, std::ios::binary);
  const std::string text = ReadAll(in);
  if (in.bad() || !in.is_open()) throw InputError(place, "cannot be read", allowed);
  return Parse(text, place.file);
}

Document Document::Parse(const std::string& text, const std::string& file_name) {
  if (text.size() > kMaxBytes) {
    throw InputError({.file = file_name}, "the file is too large",
                     fmt::format("{} bytes", kMaxBytes));
  }
  const std::string body = text.starts_with("\xef\xbb\xbf") ? text.substr(3) : text;  // the BOM
  CheckCharacters(body, file_name);
  const auto tree = std::make_shared<Value::Node::Tree>(file_name, body);
  const Value::Node* root = Value::Node::JsonReader(*tree).Read();
  if (root == nullptr) root = Value::Node::Reader(tree).Read();
  if (root == nullptr) {
    throw InputError({.file = file_name, .line = 1, .column = 1}, "the document is empty",
                     "a map, a list or a text");
  }
  return Document(Value({tree, root}));
}

void Document::RequireFormat(std::string_view format) const {
  const Value given = root_.At("format");
  const std::vector<std::string> known = {std::string(format)};
  const std::string text = given.Text();
  if (text == format) return;
  given.Fail(fmt::format("unknown format {}{}", Quote(text), DidYouMean(text, known)), Join(known));
}

std::string NearestName(std::string_view text, const std::vector<std::string>& candidates) {
  std::string nearest;
  std::size_t least = std::numeric_limits<std::size_t>::max();
  for (const std::string& candidate : candidates) {
    const std::size_t slips = std::max<std::size_t>(candidate.size() / 3, 1);
    if (text.size() > candidate.size() + slips) continue;  // also bounds the work
    const std::size_t distance = EditDistance(text, candidate);
    if (distance > slips || distance >= text.size() || distance >= least) continue;
    least = distance;
    nearest = candidate;
  }
  return nearest;
}

}  // namespace assay
