#pragma once

#include <list>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace assay::report {

// An element that a strict reader of well-formed markup has read. The reader is independent of the
// writer. It requires that tags are closed in order, that attributes are quoted and given once, and
// that texts contain no bare & < >.
struct Markup {
  std::string name;
  std::map<std::string, std::string> attributes = {};
  std::string text = {};  // of this element and of its descendants, with entities replaced
  std::list<Markup> children = {};

  // Returns all descendants of that name, in order.
  std::vector<const Markup*> All(std::string_view element) const;
  // Returns the element with that id, or null if there is none.
  const Markup* WithId(const std::string& id) const;
};

// Returns the root element of the page, after the document type. Throws std::runtime_error with the
// place if the page is not well-formed.
Markup ReadMarkup(const std::string& page);

}  // namespace assay::report
