#pragma once

#include <initializer_list>
#include <list>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "planner/geometry/coordinates.h"


namespace assay::scene {

// An element of an XML document to be written. Attributes keep the order in which they were set.
// Numbers are written with the fewest digits that read back to the same bits.
class XmlElement {
 public:
  explicit XmlElement(std::string name) : name_(std::move(name)) {}

  XmlElement& Set(std::string_view attribute, std::string_view value);
  XmlElement& Set(std::string_view attribute, const char* value) {
    return Set(attribute, std::string_view(value));
  }
  XmlElement& Set(std::string_view attribute, double value);
  XmlElement& Set(std::string_view attribute, std::span<const double> values);
  XmlElement& Set(std::string_view attribute, std::initializer_list<double> values);
  XmlElement& Set(std::string_view attribute, const geometry::Vector3& value);
  // Sets the attributes `pos` and `quat` (w x y z).
  XmlElement& SetPose(const geometry::Pose& pose);

  // Adds a new last child. The reference stays valid while this element lives.
  XmlElement& Add(std::string name);

  std::string Text() const;  // the element as indented XML with a newline at the end

 private:
  void Append(std::string& text, int depth) const;

  std::string name_;
  std::vector<std::pair<std::string, std::string>> attributes_;
  std::list<XmlElement> children_;
};

}  // namespace assay::scene
