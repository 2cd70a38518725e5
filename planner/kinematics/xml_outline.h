#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "planner/base/input_files/input_error.h"

namespace assay::kinematics {

// The places of the elements of an XML text, which urdfdom does not keep. Only the tags are read.
class XmlOutline {
 public:
  // Reads the tags of the text. Throws InputError, with line and column, unless there is an
  // element, all elements are properly nested and closed, attributes have quoted values, and at
  // most 100 elements are nested.
  XmlOutline(std::string_view text, const std::string& file);

  FilePlace root() const { return tags_.front().place; }
  // Returns the place in a URDF file of the first such element whose attribute `name` has this
  // value, or else of the root.
  FilePlace PlaceOf(std::string_view element, std::string_view name) const;
  // Finds the first text in the message, in quotes or brackets, that is an attribute's value in the
  // URDF file. Returns the place of the element with this attribute. If there is no such text,
  // returns the place of the root.
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
