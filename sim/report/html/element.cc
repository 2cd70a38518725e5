#include "sim/report/html/element.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "planner/base/input_files/quotation.h"

namespace assay::report {
namespace {

// Returns whether the element has no content and no end tag in HTML.
bool IsVoid(std::string_view name) {
  constexpr std::array<std::string_view, 5> kVoid = {"br", "hr", "img", "link", "meta"};
  return std::ranges::find(kVoid, name) != kVoid.end();
}

// Returns whether the element gets a line of its own, so that the page can be read and compared as
// text.
bool IsBlock(std::string_view name) {
  constexpr std::array<std::string_view, 25> kBlocks = {
      "head", "body",  "meta",  "title", "style",  "header",  "main", "nav", "section",
      "div",  "table", "thead", "tbody", "tr",     "caption", "h1",   "h2",  "h3",
      "h4",   "p",     "ul",    "li",    "figure", "footer",  "dl"};
  return std::ranges::find(kBlocks, name) != kBlocks.end();
}

std::string_view Replacement(char c) {
  switch (c) {
    case '&':
      return "&amp;";
    case '<':
      return "&lt;";
    case '>':
      return "&gt;";
    case '"':
      return "&quot;";
    case '\'':
      return "&#39;";
    default:
      return "";
  }
}

}  // namespace

std::string Escaped(std::string_view text) {
  std::string escaped;
  escaped.reserve(text.size());
  for (const char c : ShowLines(text)) {
    if (const std::string_view replacement = Replacement(c); !replacement.empty()) {
      escaped += replacement;
    } else {
      escaped += c;
    }
  }
  return escaped;
}

Element& Element::Set(std::string_view attribute, std::string_view value) & {
  attributes_.emplace_back(attribute, value);
  return *this;
}

Element& Element::Set(std::string_view attribute, double value) & {
  std::string text = fmt::format("{:.1f}", value);
  if (text.ends_with(".0")) text.resize(text.size() - 2);
  return Set(attribute, text == "-0" ? "0" : text);
}

Element& Element::Text(std::string_view text) & {
  children_.emplace_back(std::string(text));
  return *this;
}

Element& Element::Add(Element child) {
  return std::get<Element>(children_.emplace_back(std::move(child)));
}

std::string Element::Markup() const {
  std::string text;
  Append(text);
  return text;
}

void Element::Append(std::string& text) const {
  if (IsBlock(name_) && !text.empty() && text.back() != '\n') text += '\n';
  text += '<' + name_;
  for (const auto& [attribute, value] : attributes_) {
    text += fmt::format(" {}=\"{}\"", attribute, Escaped(value));
  }
  if (IsVoid(name_)) {
    text += " />";
    return;
  }
  text += '>';
  for (const Child& child : children_) {
    if (const auto* const words = std::get_if<std::string>(&child)) {
      text += Escaped(*words);
    } else {
      std::get<Element>(child).Append(text);
    }
  }
  text += fmt::format("</{}>", name_);
}

std::string SvgFile(const Element& svg) {
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n" + svg.Markup() + "\n";
}

}  // namespace assay::report
