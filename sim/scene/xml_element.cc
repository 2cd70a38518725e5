#include "sim/scene/xml_element.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace assay::scene {
namespace {

std::string Escaped(std::string_view value) {
  std::string escaped;
  for (const char c : value) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

}  // namespace

XmlElement& XmlElement::Set(std::string_view attribute, std::string_view value) {
  attributes_.emplace_back(attribute, value);
  return *this;
}

XmlElement& XmlElement::Set(std::string_view attribute, double value) {
  return Set(attribute, fmt::format("{}", value));
}

XmlElement& XmlElement::Set(std::string_view attribute, std::span<const double> values) {
  return Set(attribute, fmt::format("{}", fmt::join(values, " ")));
}

XmlElement& XmlElement::Set(std::string_view attribute, std::initializer_list<double> values) {
  return Set(attribute, std::span(values.begin(), values.size()));
}

XmlElement& XmlElement::Set(std::string_view attribute, const geometry::Vector3& value) {
  return Set(attribute, {value.x(), value.y(), value.z()});
}

XmlElement& XmlElement::SetPose(const geometry::Pose& pose) {
  const Eigen::Quaterniond turn(pose.linear());
  return Set("pos", geometry::Vector3(pose.translation()))
      .Set("quat", {turn.w(), turn.x(), turn.y(), turn.z()});
}

XmlElement& XmlElement::Add(std::string name) { return children_.emplace_back(std::move(name)); }

std::string XmlElement::Text() const {
  std::string text;
  Append(text, 0);
  return text;
}

void XmlElement::Append(std::string& text, int depth) const {
  const std::string indent(static_cast<std::size_t>(2 * depth), ' ');
  text += fmt::format("{}<{}", indent, name_);
  for (const auto& [attribute, value] : attributes_) {
    text += fmt::format(" {}=\"{}\"", attribute, Escaped(value));
  }
  if (children_.empty()) {
    text += "/>\n";
    return;
  }
  text += ">\n";
  for (const XmlElement& child : children_) child.Append(text, depth + 1);
  text += fmt::format("{}</{}>\n", indent, name_);
}

}  // namespace assay::scene
