#pragma once

#include <list>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace assay::report {

// A strict reader of well-formed markup, independent of what writes it: every tag is closed in
// order, every attribute is quoted and given once, no bare & < > in texts.
struct Markup {
  std::string name;
  std::map<std::string, std::string> attributes = {};
  std::string text = {};  // of it and all that is in it, with entities replaced
  std::list<Markup> children = {};

  // All elements of that name in it, in order.
  std::vector<const Markup*> All(std::string_view element) const;
  // The element with that id; null: there is none.
  const Markup* WithId(const std::string& id) const;
};

// After the document type. Throws std::runtime_error with the place if it is not well-formed.
Markup ReadMarkup(const std::string& page);

}  // namespace assay::report
