#pragma once

#include <list>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace assay::report {

// For text and for values of attributes: no letter of it is taken for markup.
// Control characters, which no page may hold, become U+FFFD.
std::string Escaped(std::string_view text);

// An element of a page that is being written: HTML, or SVG in it, in the form
// that is also well-formed XML. Attributes stand in the order in which they
// were set, children in the order in which they were added; all text is
// escaped.
class Element {
 public:
  explicit Element(std::string name) : name_(std::move(name)) {}
  Element(std::string name, std::string_view text) : name_(std::move(name)) { Text(text); }

  Element& Set(std::string_view attribute, std::string_view value) &;
  Element&& Set(std::string_view attribute, std::string_view value) && {
    return std::move(Set(attribute, value));
  }
  // To a tenth: coordinates of drawings.
  Element& Set(std::string_view attribute, double value) &;
  Element&& Set(std::string_view attribute, double value) && {
    return std::move(Set(attribute, value));
  }

  Element& Text(std::string_view text) &;
  Element&& Text(std::string_view text) && { return std::move(Text(text)); }

  // A new last child; the reference stays good while this element lives.
  Element& Add(Element child);
  Element& Add(std::string name) { return Add(Element(std::move(name))); }
  Element& Add(std::string name, std::string_view text) {
    return Add(Element(std::move(name), text));
  }

  std::string Markup() const;

 private:
  using Child = std::variant<std::string, Element>;
  void Append(std::string& text) const;

  std::string name_;
  std::vector<std::pair<std::string, std::string>> attributes_;
  std::list<Child> children_;
};

}  // namespace assay::report
