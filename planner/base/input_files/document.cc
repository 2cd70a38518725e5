#include "planner/base/input_files/document.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <limits>

#include "planner/base/check.h"
#include "planner/base/digest.h"
#include "planner/base/input_files/decimal_text.h"
#include "planner/base/input_files/document_tree.h"
#include "planner/base/input_files/input_file.h"
#include "planner/base/input_files/nearest_name.h"
#include "planner/base/input_files/quotation.h"

namespace assay {
namespace {

std::string Join(const std::vector<std::string>& names) {
  return names.empty() ? "nothing" : fmt::format("{}", fmt::join(names, ", "));
}

std::string DidYouMean(std::string_view text, const std::vector<std::string>& names) {
  const std::string nearest = NearestName(text, names);
  return nearest.empty() ? "" : fmt::format("; did you mean '{}'?", nearest);
}

// Returns nothing if the number does not fit. Unlike strtod, from_chars ignores the locale and does
// not accept '+'.
template <class T>
std::optional<T> Convert(std::string_view digits) {
  if (digits[0] == '+') digits.remove_prefix(1);
  T value{};
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc()) return std::nullopt;
  return value;
}

}  // namespace

// Describes the value of the node for a message.
std::string DocumentNode::Describe() const {
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

std::vector<std::string> DocumentNode::Keys() const {
  std::vector<std::string> names;
  for (const DocumentNode* key : keys) names.emplace_back(key->text);
  return names;
}

Value::Value(std::shared_ptr<const DocumentNode> node) : node_(std::move(node)) {}

bool Value::IsMap() const { return node_->kind == DocumentNode::Kind::kMap; }
bool Value::IsList() const { return node_->kind == DocumentNode::Kind::kList; }
bool Value::IsScalar() const { return node_->kind == DocumentNode::Kind::kScalar; }

std::string Value::Text() const {
  if (!IsScalar()) Fail(node_->Describe() + " is not a text", "a text");
  return std::string(node_->text);
}

double Value::Number() const {
  const std::string allowed = "a finite decimal number, such as 12, -0.5 or 2.5e-3, not quoted";
  const bool plain = IsScalar() && node_->style == DocumentNode::Style::kPlain;
  if (!plain || !IsDecimal(node_->text)) Fail(node_->Describe() + " is not a number", allowed);
  const std::optional<double> number = Convert<double>(node_->text);
  if (!number) Fail(node_->Describe() + " is out of the range of a double", allowed);
  return *number;
}

int Value::Integer(int low, int high) const {
  const std::string allowed = low > high
                                  ? "no number: there is nothing to choose from"
                                  : fmt::format("an integer from {} to {}, not quoted", low, high);
  const bool plain = IsScalar() && node_->style == DocumentNode::Style::kPlain;
  if (!plain || !IsInteger(node_->text)) Fail(node_->Describe() + " is not an integer", allowed);
  const std::optional<int> number = Convert<int>(node_->text);
  if (!number || *number < low || *number > high) {
    Fail(node_->Describe() + " is out of range", allowed);
  }
  return *number;
}

bool Value::Flag() const {
  const bool plain = IsScalar() && node_->style == DocumentNode::Style::kPlain;
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
  for (const DocumentNode* item : node_->items) numbers.push_back(Value({node_, item}).Number());
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
  for (const DocumentNode* item : node_->items) items.push_back(Value({node_, item}));
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

// A key that is given twice was refused when the document was read.
void Value::AllowOnly(std::initializer_list<std::string_view> keys) const {
  AllowOnly(std::vector<std::string>(keys.begin(), keys.end()));
}

void Value::AllowOnly(const std::vector<std::string>& names) const {
  if (!IsMap()) Fail(node_->Describe() + " is not a map", "a map with the keys " + Join(names));
  for (const DocumentNode* key : node_->keys) {
    const std::string_view text = key->text;
    if (std::find(names.begin(), names.end(), text) != names.end()) continue;
    Value({node_, key})
        .Fail(fmt::format("unknown key {}{}", Quote(text), DidYouMean(text, names)), Join(names));
  }
}

void Value::Fail(const std::string& what, const std::string& allowed) const {
  throw InputError(Place(), what, allowed);
}

FilePlace Value::Place() const {
  return {.file = *node_->file, .line = node_->line, .column = node_->column};
}

Document Document::Load(const std::filesystem::path& file) {
  return Parse(ReadInput(file, "a YAML or JSON file that can be read"), file.string());
}

Document Document::Parse(const std::string& text, const std::string& file_name) {
  if (text.size() > kMostInputBytes) {
    throw InputError({.file = file_name}, "the file is too large",
                     fmt::format("{} bytes", kMostInputBytes));
  }
  const std::string body = text.starts_with("\xef\xbb\xbf") ? text.substr(3) : text;
  RequireText(body, file_name);
  const auto tree = std::make_shared<DocumentNode::Tree>(file_name, body);
  const DocumentNode* root = DocumentNode::ReadJson(*tree);
  if (root == nullptr) root = DocumentNode::ReadYaml(tree);
  if (root == nullptr) {
    throw InputError({.file = file_name, .line = 1, .column = 1}, "the document is empty",
                     "a map, a list or a text");
  }
  return Document(Value({tree, root}), Digest().Add(text).Hex());
}

void Document::RequireFormat(std::string_view format) const {
  const Value given = root_.At("format");
  const std::vector<std::string> known = {std::string(format)};
  const std::string text = given.Text();
  if (text == format) return;
  given.Fail(fmt::format("unknown format {}{}", Quote(text), DidYouMean(text, known)), Join(known));
}

}  // namespace assay
