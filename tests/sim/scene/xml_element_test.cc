#include "sim/scene/xml_element.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace assay::scene::xml_element_test {
namespace {

TEST(XmlElement, WritesChildrenInside) {
  XmlElement root("mujoco");
  root.Set("model", "a");
  root.Add("worldbody").Add("body").Set("pos", {1, 2.5, -3e-7});
  EXPECT_EQ(root.Text(),
            "<mujoco model=\"a\">\n"
            "  <worldbody>\n"
            "    <body pos=\"1 2.5 -3e-07\"/>\n"
            "  </worldbody>\n"
            "</mujoco>\n");
}

TEST(XmlElement, EscapesWhatXmlReserves) {
  XmlElement root("a");
  root.Set("name", "<\"&");
  EXPECT_EQ(root.Text(), "<a name=\"&lt;&quot;&amp;\"/>\n");
}

TEST(XmlElement, NumbersReadBackToTheSameBits) {
  for (const double value : {1.0 / 3, 0.1, 1e-300, -0.0, 6.02214076e23}) {
    XmlElement element("a");
    element.Set("v", value);
    const std::string text = element.Text();
    EXPECT_EQ(std::strtod(text.c_str() + text.find('"') + 1, nullptr), value);
  }
}

}  // namespace
}  // namespace assay::scene::xml_element_test
