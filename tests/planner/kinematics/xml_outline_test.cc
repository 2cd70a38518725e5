#include "planner/kinematics/xml_outline.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace assay::kinematics::xml_outline_test {
namespace {

using ::testing::HasSubstr;

constexpr const char* kText =
    "<?xml version=\"1.0\"?>\n"
    "<!-- <link name=\"a\"> -->\n"
    "<robot name='r'>\n"
    "  <link name=\"a\"/><link\n"
    "      name = 'b > c'>\n"
    "    <mass value=\"two\"/>\n"
    "  </link >\n"
    "  <joint name=\"a\"></joint>\n"
    "</robot>\n";

TEST(XmlOutline, TellsWhereElementsBegin) {
  const XmlOutline outline(kText, "f");
  EXPECT_EQ(outline.root().Text(), "f:3:1");
  EXPECT_EQ(outline.PlaceOf("link", "a").Text(), "f:4:3");
  EXPECT_EQ(outline.PlaceOf("link", "b > c").Text(), "f:4:19");
  EXPECT_EQ(outline.PlaceOf("joint", "a").Text(), "f:8:3");
  EXPECT_EQ(outline.PlaceOf("joint", "z").Text(), "f:3:1");
}

TEST(XmlOutline, FindsWhatAMessageSpeaksOf) {
  const XmlOutline outline(kText, "f");
  EXPECT_EQ(outline.PlaceOfMention("mass [two] is not a float").Text(), "f:6:5");
  EXPECT_EQ(outline.PlaceOfMention("mass [two] is no float; so is Link [a]").Text(), "f:6:5");
  EXPECT_EQ(outline.PlaceOfMention("link 'a' is not unique").Text(), "f:4:3");
  EXPECT_EQ(outline.PlaceOfMention("something else").Text(), "f:3:1");
}

struct WrongXml {
  const char* text;
  const char* place;
  const char* message;
};

TEST(XmlOutline, RefusesWhatIsNotWellFormed) {
  for (const WrongXml& wrong : {
           WrongXml{"", "f:1:1", "no element"},
           WrongXml{"robot", "f:1:6", "no element"},
           WrongXml{"<a>\n <b>\n</a>", "f:3:1", "'</a' where </b> is expected"},
           WrongXml{"<a>\n <b></b>", "f:1:1", "<a> is never closed"},
           WrongXml{"</a>", "f:1:1", "closes nothing"},
           WrongXml{"<a/></a>", "f:1:5", "closes nothing"},
           WrongXml{"<a b></a>", "f:1:4", "'b' has no value"},
           WrongXml{"<a b=1></a>", "f:1:4", "'b' has no value"},
           WrongXml{"<a b=\"1></a>", "f:1:4", "'b' has no value"},
           WrongXml{"<a\n", "f:1:1", "never closed by '>'"},
           WrongXml{"<a>\n<!-- ", "f:2:1", "<!-- is never closed"},
           WrongXml{"< a></a>", "f:1:1", "begins no element"},
       }) {
    try {
      XmlOutline(wrong.text, "f");
      ADD_FAILURE() << "accepted: " << wrong.text;
    } catch (const InputError& error) {
      EXPECT_EQ(error.place().Text(), wrong.place) << wrong.text;
      EXPECT_THAT(error.what(), HasSubstr(wrong.message)) << wrong.text;
    }
  }
}

TEST(XmlOutline, RefusesWhatIsNestedTooDeeply) {
  const auto nested = [](int levels) {
    std::string text;
    for (int i = 0; i < levels; ++i) text += "<a>";
    for (int i = 0; i < levels; ++i) text += "</a>";
    return text;
  };
  EXPECT_NO_THROW(XmlOutline(nested(100), "f"));
  EXPECT_THROW(XmlOutline(nested(101), "f"), InputError);
}

}  // namespace
}  // namespace assay::kinematics::xml_outline_test
