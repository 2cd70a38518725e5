#pragma once

#include <list>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace assay::report {

// Returns the text in a form that is safe as text or attribute value: no character is taken for
// markup. Control characters, which no page may contain, become U+FFFD.
std::string Escaped(std::string_view text);

// An element of a page to be written, in HTML or SVG that is also well-formed XML. Attributes keep
// the order in which they were set, and children the order in which they were added. All text is
// escaped.
class Element {
 public:
  explicit Element(std::string name) : name_(std::move(name)) {}
  Element(std::string name, std::string_view text) : name_(std::move(name)) { Text(text); }

  Element& Set(std::string_view attribute, std::string_view value) &;
  Element&& Set(std::string_view attribute, std::string_view value) && {
    return std::move(Set(attribute, value));
  }
  // Rounds the value to a tenth, for coordinates of drawings.
  Element& Set(std::string_view attribute, double value) &;
  Element&& Set(std::string_view attribute, double value) && {
    return std::move(Set(attribute, value));
  }

  Element& Text(std::string_view text) &;
  Element&& Text(std::string_view text) && { return std::move(Text(text)); }

  // Adds a new last child. The reference stays valid while this element lives.
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

// Returns the contents of a file that shows an SVG element by itself.
std::string SvgFile(const Element& svg);

}  // namespace assay::report
