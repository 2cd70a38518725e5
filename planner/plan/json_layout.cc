#include "planner/plan/json_layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string_view>

#include "planner/base/quotation.h"

namespace assay::plan {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kColumns = 100;
constexpr std::size_t kStep = 2;  // columns that what is inside is farther to the right

// JSON itself escapes control characters below U+0020 only. What else disturbs stands in texts
// alone.
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

// `write` of each item of a list or an object, with the key before it in the latter.
template <class Write>
void ForEachItem(const Json& json, const Write& write) {
  for (const auto& [key, value] : json.items()) {
    write(json.is_object() ? Dumped(key) + ": " : "", value);
  }
}

std::string OnOneLine(const Json& json) {
  if (json.is_number_float()) return fmt::format("{}", json.get<double>());
  if (!json.is_structured()) return Dumped(json);
  std::string text;
  ForEachItem(json, [&](const std::string& key, const Json& value) {
    text += (text.empty() ? "" : ", ") + key + OnOneLine(value);
  });
  return json.is_object() ? "{" + text + "}" : "[" + text + "]";
}

class Writer {
 public:
  std::string Write(const Json& json) {
    Put(json, OnOneLine(json), 0);
    return std::move(text_) + "\n";
  }

 private:
  std::size_t column() const { return text_.size() - (text_.rfind('\n') + 1); }

  void Put(const Json& json, const std::string& line, std::size_t indentation) {
    if (!json.is_structured() || column() + line.size() < kColumns) {
      text_ += line;
      return;
    }
    text_ += json.is_object() ? '{' : '[';
    PutItems(json, indentation + kStep);
    NewLine(indentation);
    text_ += json.is_object() ? '}' : ']';
  }

  void PutItems(const Json& json, std::size_t indentation) {
    const bool is_flat = std::ranges::none_of(json, &Json::is_structured);
    bool is_first = true;
    ForEachItem(json, [&](const std::string& key, const Json& value) {
      const std::string line = OnOneLine(value);
      if (!is_first) text_ += ',';
      const bool fits = column() + key.size() + line.size() + 2 < kColumns;
      if (is_first || !is_flat || !fits) {
        NewLine(indentation);
      } else {
        text_ += ' ';
      }
      is_first = false;
      text_ += key;
      Put(value, line, indentation);
    });
  }

  void NewLine(std::size_t indentation) {
    text_ += '\n';
    text_.append(indentation, ' ');
  }

  std::string text_;
};

}  // namespace

std::string LaidOut(const Json& json) { return Writer().Write(json); }

std::string JsonText(const Json& json) { return Dumped(json, 2) + '\n'; }

std::string JsonLine(const Json& json) { return Dumped(json); }

}  // namespace assay::plan
