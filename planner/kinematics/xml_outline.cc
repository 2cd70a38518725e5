#include "planner/kinematics/xml_outline.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>

#include "planner/base/input_files/quotation.h"

namespace assay::kinematics {
namespace {

constexpr std::size_t kMostElementsInEachOther = 100;  // limited because readers recurse

bool IsXmlBlank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

}  // namespace

class XmlTagReader {
 public:
  using Tag = XmlOutline::Tag;

  XmlTagReader(std::string_view text, const std::string& file)
      : text_(text), here_{.file = file, .line = 1, .column = 1} {}

  std::vector<Tag> Read() {
    while (SkipTo("<")) {
      if (!SkipWithoutElement()) ReadTag();
    }
    if (!open_.empty()) {
      Fail(tags_[open_.back()].place, fmt::format("<{}> is never closed", Last()));
    }
    if (tags_.empty()) Fail(here_, "there is no element");
    return std::move(tags_);
  }

 private:
  [[noreturn]] static void Fail(const FilePlace& place, const std::string& what) {
    throw InputError(place, "is not a URDF file: " + what, "well-formed XML");
  }

  std::string Last() const { return Show(tags_[open_.back()].element, kQuotedCharacters); }

  void Advance(std::size_t count) {
    for (const char c : text_.substr(0, count)) {
      here_.column = c == '\n' ? 1 : here_.column + 1;
      here_.line += c == '\n' ? 1 : 0;
    }
    text_.remove_prefix(std::min(count, text_.size()));
  }

  // Returns false if the text does not occur any further on.
  bool SkipTo(std::string_view what) {
    const std::size_t at = text_.find(what);
    Advance(std::min(at, text_.size()));
    return at != std::string_view::npos;
  }

  // Skips a comment, a declaration or raw text.
  bool SkipWithoutElement() {
    constexpr std::array<std::array<std::string_view, 2>, 4> kOthers = {
        {{"<!--", "-->"}, {"<![CDATA[", "]]>"}, {"<?", "?>"}, {"<!", ">"}}};
    for (const auto& [begin, end] : kOthers) {
      if (!text_.starts_with(begin)) continue;
      const FilePlace place = here_;
      Advance(begin.size());
      if (!SkipTo(end)) Fail(place, fmt::format("{} is never closed by {}", begin, end));
      Advance(end.size());
      return true;
    }
    return false;
  }

  std::string TakeName() {
    const std::size_t length = std::min(text_.find_first_of(" \t\r\n/>=\"'<"), text_.size());
    std::string name(text_.substr(0, length));
    Advance(length);
    return name;
  }

  void SkipXmlBlanks() {
    const auto blanks = std::ranges::find_if_not(text_, IsXmlBlank) - text_.begin();
    Advance(static_cast<std::size_t>(blanks));
  }

  void ReadTag() {
    const FilePlace place = here_;
    Advance(1);
    if (text_.starts_with("/")) return ReadEndTag(place);
    Tag tag{.element = TakeName(), .attributes = {}, .place = place};
    if (tag.element.empty()) Fail(place, "'<' begins no element");
    for (SkipXmlBlanks(); !text_.starts_with(">") && !text_.starts_with("/>"); SkipXmlBlanks()) {
      tag.attributes.push_back(TakeAttribute(place));
    }
    const bool is_closed = text_.starts_with("/");
    Advance(is_closed ? 2 : 1);
    tags_.push_back(std::move(tag));
    if (is_closed) return;
    if (open_.size() == kMostElementsInEachOther) Fail(place, "elements are nested too deeply");
    open_.push_back(tags_.size() - 1);
  }

  XmlOutline::Attribute TakeAttribute(const FilePlace& tag) {
    if (text_.empty()) Fail(tag, "the element's tag is never closed by '>'");
    const FilePlace place = here_;
    XmlOutline::Attribute attribute{.name = TakeName(), .value = {}};
    SkipXmlBlanks();
    const bool has_value = !attribute.name.empty() && text_.starts_with("=");
    if (has_value) Advance(1);
    SkipXmlBlanks();
    const char quote = text_.empty() ? '\0' : text_[0];
    const std::size_t end = text_.find(quote, 1);
    if (!has_value || (quote != '"' && quote != '\'') || end == std::string_view::npos) {
      Fail(place, fmt::format("attribute {} has no value in quotes", Quote(attribute.name)));
    }
    attribute.value = std::string(text_.substr(1, end - 1));
    Advance(end + 1);
    return attribute;
  }

  void ReadEndTag(const FilePlace& place) {
    Advance(1);
    const std::string element = TakeName();
    SkipXmlBlanks();
    if (open_.empty() || tags_[open_.back()].element != element || !text_.starts_with(">")) {
      Fail(place, open_.empty()
                      ? fmt::format("{} closes nothing", Quote("</" + element))
                      : fmt::format("{} where </{}> is expected", Quote("</" + element), Last()));
    }
    Advance(1);
    open_.pop_back();
  }

  std::string_view text_;  // the text that is still to be read
  FilePlace here_;
  std::vector<Tag> tags_;
  std::vector<std::size_t> open_;  // indices in tags_ of elements that are not closed
};

XmlOutline::XmlOutline(std::string_view text, const std::string& file)
    : tags_(XmlTagReader(text, file).Read()) {}

FilePlace XmlOutline::PlaceOf(std::string_view element, std::string_view name) const {
  const auto found = std::ranges::find_if(tags_, [&](const Tag& tag) {
    return tag.element == element &&
           std::ranges::any_of(tag.attributes, [&](const auto& attribute) {
             return attribute.name == "name" && attribute.value == name;
           });
  });
  return found == tags_.end() ? root() : found->place;
}

FilePlace XmlOutline::PlaceOfMention(std::string_view message) const {
  FilePlace place = root();
  std::size_t earliest = std::string_view::npos;
  for (const Tag& tag : std::span(tags_).subspan(1)) {
    for (const Attribute& attribute : tag.attributes) {
      if (attribute.value.empty()) continue;
      const std::size_t mention = std::min(message.find(fmt::format("'{}'", attribute.value)),
                                           message.find(fmt::format("[{}]", attribute.value)));
      if (mention >= earliest) continue;
      earliest = mention;
      place = tag.place;
    }
  }
  return place;
}

}  // namespace assay::kinematics
