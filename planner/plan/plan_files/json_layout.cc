#include "planner/plan/plan_files/json_layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string_view>

#include "planner/base/input_files/quotation.h"

namespace assay::plan {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kColumns = 100;
constexpr std::size_t kStep = 2;  // indentation of each level, in columns

// Returns the JSON as text. The JSON library itself escapes only control characters below U+0020.
// Other disturbing characters occur in texts alone.
std::string Dumped(const Json& json, int indentation = -1) {
  const std::string dumped = json.dump(indentation, ' ', false, Json::error_handler_t::replace);
  std::string text;
  text.reserve(dumped.size());
  for (std::string_view rest = dumped; !rest.empty();) {
    const CodePoint c = Decode(rest);
    const std::string_view bytes = rest.substr(0, c.bytes);
    text += c.value >= 0x7f && Disturbs(c.value)
                ? fmt::format("\\u{:04x}", static_cast<std::uint32_t>(c.value))
                : std::string(bytes);
    rest.remove_prefix(bytes.size());
  }
  return text;
}

bool IsPlain(char c) { return c >= ' ' && c < 0x7f && c != '"' && c != '\\'; }

// A list or an object is begun on the current line. If the line gets too long, the written part of
// it is taken back, and each item gets a line of its own.
class Writer {
 public:
  std::string Write(const Json& json) {
    Put(json, 0);
    return std::move(text_) + "\n";
  }

 private:
  std::size_t column() const { return text_.size() - line_; }

  void Put(const Json& json, std::size_t indentation) {
    const std::size_t before = text_.size();
    if (PutOnThisLine(json) || !json.is_structured()) return;
    text_.resize(before);
    text_ += json.is_object() ? '{' : '[';
    PutItems(json, indentation + kStep);
    NewLine(indentation);
    text_ += json.is_object() ? '}' : ']';
  }

  void PutItems(const Json& json, std::size_t indentation) {
    const bool is_flat = std::ranges::none_of(json, &Json::is_structured);
    bool is_first = true;
    for (auto item = json.begin(); item != json.end(); ++item) {
      if (!is_first) text_ += ',';
      if (is_first || !is_flat || !PutBehind(json, item)) {
        NewLine(indentation);
        PutKey(json, item);
        Put(item.value(), indentation);
      }
      is_first = false;
    }
  }

  // Puts an item on the line of the item before. Returns false, with nothing written, if no comma
  // would fit behind it.
  bool PutBehind(const Json& json, Json::const_iterator item) {
    const std::size_t before = text_.size();
    text_ += ' ';
    PutKey(json, item);
    if (PutOnThisLine(item.value()) && column() + 1 < kColumns) return true;
    text_.resize(before);
    return false;
  }

  // Puts a value on this line. Returns false if the value is a structure that does not fit. A part
  // of the structure has then been written.
  bool PutOnThisLine(const Json& json) {
    if (!json.is_structured()) {
      PutScalar(json);
      return true;
    }
    text_ += json.is_object() ? '{' : '[';
    bool is_first = true;
    for (auto item = json.begin(); item != json.end(); ++item) {
      if (!is_first) text_ += ", ";
      is_first = false;
      PutKey(json, item);
      if (!PutOnThisLine(item.value()) || column() >= kColumns) return false;
    }
    text_ += json.is_object() ? '}' : ']';
    return column() < kColumns;
  }

  // Puts the key of an object's item.
  void PutKey(const Json& json, Json::const_iterator item) {
    if (!json.is_object()) return;
    PutText(item.key());
    text_ += ": ";
  }

  void PutScalar(const Json& json) {
    if (json.is_number_float()) {
      fmt::format_to(std::back_inserter(text_), "{}", json.get<double>());
    } else if (json.is_string()) {
      PutText(json.get_ref<const std::string&>());
    } else {
      text_ += Dumped(json);
    }
  }

  void PutText(const std::string& text) {
    if (std::ranges::all_of(text, IsPlain)) {
      text_ += '"';
      text_ += text;
      text_ += '"';
    } else {
      text_ += Dumped(text);
    }
  }

  void NewLine(std::size_t indentation) {
    text_ += '\n';
    line_ = text_.size();
    text_.append(indentation, ' ');
  }

  std::string text_;
  std::size_t line_ = 0;  // start of the last line
};

}  // namespace

std::string LaidOut(const Json& json) { return Writer().Write(json); }

std::string JsonText(const Json& json) { return Dumped(json, 2) + '\n'; }

std::string JsonLine(const Json& json) { return Dumped(json); }

}  // namespace assay::plan
