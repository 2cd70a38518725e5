#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "planner/base/document/input_error.h"

namespace assay::kinematics {

// Where the elements of an XML text stand, which urdfdom forgets. Only the tags are looked at.
class XmlOutline {
 public:
  // Throws InputError, with line and column, unless there is an element, every one is closed in its
  // turn, attributes have values in quotes, and at most 100 elements are in each other.
  XmlOutline(std::string_view text, const std::string& file);

  FilePlace root() const { return tags_.front().place; }
  // Of the first such element whose attribute `name` is this; else of the root.
  FilePlace PlaceOf(std::string_view element, std::string_view name) const;
  // Of the element with the attribute whose value the message has first in quotes or brackets; else
  // of the root.
  FilePlace PlaceOfMention(std::string_view message) const;

 private:
  friend class XmlTagReader;
  struct Attribute {
    std::string name, value;
  };
  struct Tag {
    std::string element;
    std::vector<Attribute> attributes;
    FilePlace place;
  };
  std::vector<Tag> tags_;
};

}  // namespace assay::kinematics
