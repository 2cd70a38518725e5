#include "planner/base/input_files/document.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "planner/base/input_files/nearest_name.h"
#include "planner/base/random.h"
#include "tests/scratch_file.h"

namespace assay::document_test {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

Value Root(const std::string& text) { return Document::Parse(text, "f.yaml").root(); }

// Returns the message of the InputError that `action` throws.
template <class Action>
std::string Error(Action action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  ADD_FAILURE() << "no InputError";
  return "";
}

std::string ParseError(const std::string& text) {
  return Error([&] { Document::Parse(text, "f.yaml"); });
}

TEST(DocumentTest, GivesMapsListsAndScalarsInOrder) {
  const Value root = Root("b: [1, two]\na: {x: 'q'}\n");
  ASSERT_TRUE(root.IsMap());
  const auto entries = root.Entries();
  ASSERT_EQ(entries.size(), 2u);
  EXPECT_EQ(entries[0].first.Text(), "b");
  EXPECT_EQ(entries[1].first.Text(), "a");
  ASSERT_TRUE(entries[0].second.IsList());
  EXPECT_EQ(entries[0].second.Items()[1].Text(), "two");
  EXPECT_TRUE(root.At("a").At("x").IsScalar());
  EXPECT_FALSE(root.Find("c").has_value());
}

TEST(DocumentTest, ReadsJson) {
  const Value root = Root(
      "{\n\t\"format\":\"assay-plan/1\",\n\t\"actions\": [{\"id\":0, \"ok\":true}],\"x\":-2.5E-3,"
      "\"t\":\"a\\/b\\n\\u00e9\",\"none\":[],\"map\":{}}\n");
  EXPECT_EQ(root.At("actions").Items()[0].At("id").Integer(0, 0), 0);
  EXPECT_TRUE(root.At("actions").Items()[0].At("ok").Flag());
  EXPECT_EQ(root.At("x").Number(), -2.5e-3);
  EXPECT_EQ(root.At("t").Text(), "a/b\n\xc3\xa9");
  EXPECT_TRUE(root.At("none").Items().empty());
  EXPECT_TRUE(root.At("map").Entries().empty());
}

TEST(DocumentTest, PlacesCountFromOne) {
  const Value root = Root("\xef\xbb\xbf# comment\na: 1\nb:\n  - {c: x,\n     d: y}\r\n  - z\n");
  EXPECT_EQ(root.Place().Text(), "f.yaml:2:1");
  EXPECT_EQ(root.At("a").Place().Text(), "f.yaml:2:4");
  EXPECT_EQ(root.At("b").Place().Text(), "f.yaml:4:3");
  EXPECT_EQ(root.At("b").Items()[0].At("d").Place().Text(), "f.yaml:5:9");
  EXPECT_EQ(root.At("b").Items()[1].Place().Text(), "f.yaml:6:5");
  EXPECT_EQ(Root("[1,\n 2]").Items()[1].Place().Text(), "f.yaml:2:2");
}

TEST(DocumentTest, AValueLeftOutIsNamedWhereItBelongs) {
  const Value root = Root("a:\n\nb: ~\nc:\n  -\n\n  - 1\n");
  EXPECT_EQ(root.At("a").Place().Text(), "f.yaml:1:1");
  EXPECT_EQ(root.At("b").Place().Text(), "f.yaml:3:4");
  EXPECT_EQ(root.At("c").Items()[0].Place().Text(), "f.yaml:5:3");
  EXPECT_FALSE(root.At("a").IsScalar());
  EXPECT_EQ(Error([&] { root.At("a").Number(); }),
            "f.yaml:1:1: nothing is not a number; allowed: a finite decimal number, such as 12, "
            "-0.5 or 2.5e-3, not quoted");
}

TEST(DocumentTest, ValuesOutliveTheDocument) {
  std::optional<Value> value;
  {
    const Document document = Document::Parse("a: {b: [1, 2]}", "f.yaml");
    value = document.root().At("a").At("b");
  }
  EXPECT_THAT(value->Numbers(2), ElementsAre(1.0, 2.0));
}

TEST(NumberTest, AcceptsPlainDecimals) {
  const std::pair<const char*, double> cases[] = {
      {"0", 0.0},         {"12", 12.0},
      {"+1.5", 1.5},      {"-0.25", -0.25},
      {".5", 0.5},        {"-.5", -0.5},
      {"3.", 3.0},        {"1e3", 1e3},
      {"1E+3", 1e3},      {"2.5e-3", 2.5e-3},
      {"010", 10.0},      {"0.1", 0.1},
      {"5e-324", 5e-324}, {"1.7976931348623157e308", 1.7976931348623157e308}};
  for (const auto& [text, number] : cases) {
    EXPECT_EQ(Root(std::string("[") + text + "]").Items()[0].Number(), number) << text;
  }
}

TEST(NumberTest, RefusesEverythingElse) {
  for (const char* text :
       {".inf", "-.inf", ".nan",  "inf",    "nan",  "0x10", "0o7", "1_000", "1,5e", "1.2.3",
        "1e",   "1e+",   "e5",    ".",      "+",    "+-1",  "--1", "1 2",   "1m",   "1.5 deg",
        "'1'",  "\"1\"", "1e999", "-1e999", "true", "~",    "{}",  "[1]",   "1e5.0"}) {
    const Value value = Root(std::string("a: ") + text).At("a");
    EXPECT_THAT(Error([&] { value.Number(); }),
                AllOf(StartsWith("f.yaml:1:"), HasSubstr("; allowed: a finite decimal number")))
        << text;
  }
}

TEST(NumberTest, NamesPlaceTextAndWhatIsAllowed) {
  EXPECT_EQ(Error([] { Root("mass: 1.5kg").At("mass").Number(); }),
            "f.yaml:1:7: '1.5kg' is not a number; allowed: a finite decimal number, such as 12, "
            "-0.5 or 2.5e-3, not quoted");
  EXPECT_THAT(Error([] { Root("mass: '1.5'").At("mass").Number(); }),
              HasSubstr("the quoted text '1.5' is not a number"));
}

TEST(IntegerTest, AcceptsTheWholeRange) {
  const Value root = Root("[-3, 4, +4, 2147483647, -2147483648]");
  EXPECT_EQ(root.Items()[0].Integer(-3, 4), -3);
  EXPECT_EQ(root.Items()[1].Integer(-3, 4), 4);
  EXPECT_EQ(root.Items()[2].Integer(-3, 4), 4);
  EXPECT_EQ(root.Items()[3].Integer(0, 2147483647), 2147483647);
  EXPECT_EQ(root.Items()[4].Integer(-2147483647 - 1, 0), -2147483647 - 1);
}

TEST(IntegerTest, RefusesEverythingElseWithTheRange) {
  for (const char* text : {"-4", "5", "1.0", "1e0", "0x1", "'1'", "99999999999999999999", "one",
                           "2147483648", "4294967297", "~", "[]", "+", "1 1"}) {
    const Value value = Root(std::string("a: ") + text).At("a");
    EXPECT_THAT(
        Error([&] { value.Integer(-3, 4); }),
        AllOf(StartsWith("f.yaml:1:"), EndsWith("; allowed: an integer from -3 to 4, not quoted")))
        << text;
  }
  EXPECT_THAT(Error([] { Root("a: 5").At("a").Integer(0, -1); }),
              HasSubstr("out of range; allowed: no number: there is nothing to choose from"));
  EXPECT_THAT(Error([] { Root("a: 5").At("a").Integer(-3, 4); }),
              StartsWith("f.yaml:1:4: '5' is out of range"));
}

TEST(FlagTest, IsTrueOrFalse) {
  const Value root = Root("[true, false, yes, True, 'true', 1]");
  EXPECT_TRUE(root.Items()[0].Flag());
  EXPECT_FALSE(root.Items()[1].Flag());
  for (int i = 2; i < 6; ++i) {
    EXPECT_THAT(Error([&] { root.Items()[static_cast<std::size_t>(i)].Flag(); }),
                EndsWith("is not a truth value; allowed: true or false, not quoted"));
  }
}

TEST(NumbersTest, WantsExactlySoMany) {
  const Value list = Root("a: [1, 2.5, -3]").At("a");
  EXPECT_THAT(list.Numbers(3), ElementsAre(1.0, 2.5, -3.0));
  EXPECT_EQ(Error([&] { list.Numbers(2); }),
            "f.yaml:1:4: a list of length 3 is not a list of 2 numbers; allowed: a list of 2 "
            "numbers");
  EXPECT_THAT(Error([] { Root("a: 1").At("a").Numbers(1); }), HasSubstr("'1' is not a list of 1"));
  EXPECT_THAT(Error([] { Root("a: [1, x]").At("a").Numbers(2); }),
              StartsWith("f.yaml:1:8: 'x' is not a number"));
}

TEST(OneOfTest, GivesTheIndexOrListsTheNames) {
  const std::vector<std::string> names = {"metre", "inch"};
  EXPECT_EQ(Root("[inch]").Items()[0].OneOf(names), 1);
  EXPECT_EQ(Root("['metre']").Items()[0].OneOf(names), 0);
  EXPECT_EQ(Error([&] { Root("[inhc]").Items()[0].OneOf(names); }),
            "f.yaml:1:2: unknown name 'inhc'; did you mean 'inch'?; allowed: metre, inch");
  EXPECT_EQ(Error([&] { Root("[parsec]").Items()[0].OneOf(names); }),
            "f.yaml:1:2: unknown name 'parsec'; allowed: metre, inch");
  EXPECT_EQ(Error([&] { Root("[[]]").Items()[0].OneOf(names); }),
            "f.yaml:1:2: a list of length 0 is not a name; allowed: metre, inch");
}

TEST(MapTest, AMissingKeyNamesTheMap) {
  EXPECT_EQ(Error([] { Root("a: 1\nb:\n  c: 1\n  d: 2\n").At("b").At("goal"); }),
            "f.yaml:3:3: missing key 'goal' in a map with the keys 'c, d'; allowed: a map with the "
            "key 'goal'");
  EXPECT_THAT(Error([] { Root("a: 1").At("a").At("b"); }),
              StartsWith("f.yaml:1:4: '1' is not a map"));
  EXPECT_THAT(Error([] { Root("[1]").Find("b"); }), HasSubstr("a list of length 1 is not a map"));
  EXPECT_THAT(Error([] { Root("[1]").Entries(); }), EndsWith("; allowed: a map"));
  EXPECT_THAT(Error([] { Root("{}").Items(); }), EndsWith("; allowed: a list"));
  EXPECT_THAT(Error([] { Root("{}").Text(); }), EndsWith("; allowed: a text"));
}

TEST(MapTest, AnUnknownKeyNamesTheNearest) {
  const Value root =
      Document::Parse("format: f\n\nunits: u\n\n\n\ngaol: g\n", "scenario.yaml").root();
  EXPECT_EQ(Error([&] {
              root.AllowOnly({"format", "units", "goal"});
            }),
            "scenario.yaml:7:1: unknown key 'gaol'; did you mean 'goal'?; allowed: format, units, "
            "goal");
  EXPECT_THAT(Error([&] { root.AllowOnly({"format"}); }),
              StartsWith("scenario.yaml:3:1: unknown key 'units'; allowed: format"));
  EXPECT_THAT(Error([&] { root.AllowOnly({}); }), EndsWith("; allowed: nothing"));
  root.AllowOnly({"goal", "gaol", "units", "format"});
  EXPECT_THAT(Error([] { Root("[1]").AllowOnly({"a"}); }), HasSubstr("is not a map"));
}

TEST(MapTest, AKeyGivenTwiceIsAnError) {
  EXPECT_EQ(ParseError("a: 1\nb:\n  c: 1\n  d: 2\n  c: 3\n"),
            "f.yaml:5:3: key 'c' is given twice, first in line 3; allowed: each key once");
  EXPECT_THAT(ParseError("{\"a\": 1, a: 2}"), StartsWith("f.yaml:1:10: key 'a' is given twice"));
  EXPECT_EQ(Root("[{a: 1}, {a: 2}]").Items()[1].At("a").Number(), 2.0);
}

TEST(MapTest, AKeyIsAScalar) {
  EXPECT_THAT(ParseError("[1, 2]: 3"), HasSubstr("cannot be the key of a map"));
  EXPECT_THAT(ParseError("? {a: b}\n: 3"), HasSubstr("cannot be the key of a map"));
  EXPECT_THAT(ParseError("~: 3"), StartsWith("f.yaml:1:1: nothing cannot be the key of a map"));
}

TEST(MessageTest, ShortensTheOffendingTextAndShowsControlCharacters) {
  const std::string message = Error([] {
    Root("[\"a\\nb\\tc\\0d\\u001be\\x7f" + std::string(5000, 'x') + "\"]").Items()[0].Number();
  });
  EXPECT_THAT(message, HasSubstr("'a\\nb\\tc\\x00d\\x1be\\x7fxxx"));
  EXPECT_THAT(message, HasSubstr("xxx...'"));
  EXPECT_LT(message.size(), 250u);
}

TEST(MessageTest, CutsBetweenCharacters) {
  std::string text;
  for (int i = 0; i < 100; ++i) text += "\xe2\x82\xac";
  std::string shown;
  for (int i = 0; i < 60; ++i) shown += "\xe2\x82\xac";
  EXPECT_THAT(Error([&] { Root("[" + text + "]").Items()[0].Number(); }),
              HasSubstr("'" + shown + "...' is not a number"));
}

TEST(MessageTest, FailThrowsAtThePlace) {
  const Value value = Root("a:\n  b: 7").At("a").At("b");
  EXPECT_EQ(Error([&] { value.Fail("7 is no prime\nnumber", "8"); }),
            "f.yaml:2:6: 7 is no prime\\nnumber; allowed: 8");
  EXPECT_EQ(Error([&] { value.Fail("too late"); }), "f.yaml:2:6: too late");
}

TEST(ParseTest, AnEmptyDocumentIsAnError) {
  for (const char* text :
       {"", "\n \n", "# nothing\n", "---\n", "---\n...\n", "~", "null", "\xef\xbb\xbf"}) {
    EXPECT_THAT(ParseError(text), StartsWith("f.yaml:1:1: the document is empty; allowed: "))
        << text;
  }
}

TEST(ParseTest, ASyntaxErrorHasAPlace) {
  EXPECT_THAT(ParseError("a: 1\nb: [1, 2\nc: 3\n"), StartsWith("f.yaml:3:"));
  EXPECT_THAT(ParseError("a: 1\n  b: 2\n"), AllOf(StartsWith("f.yaml:2:4: "), HasSubstr("at ':")));
  EXPECT_THAT(ParseError("a: %"), StartsWith("f.yaml:1:4: "));
}

// A file that was cut short must not be accepted as a whole file.
TEST(ParseTest, RefusesWhatIsNeverClosed) {
  for (const char* text :
       {"a: \"x", "a: \"x\n", "a: 'x\n", "a: 'x''\n", "a: \"x\\\"\n", "a: \"x\n # y\n", "\"x\n",
        "[1, 2", "[1, 2\n", "{a: 1", "{a: 1,\n", "[\"x\n", "{\"a\": [1, {\"b\": \"c\n"}) {
    EXPECT_THAT(ParseError(text), EndsWith("; allowed: YAML or JSON")) << text;
  }
  EXPECT_EQ(ParseError("b: 'y'\na: \"x\n"),
            "f.yaml:2:4: the quote is never closed at '\"x'; allowed: YAML or JSON");
  EXPECT_THAT(ParseError("a: 1\nb: [1, 2"), StartsWith("f.yaml:2:9: "));
  EXPECT_EQ(Root("a: 'it''s'''\n").At("a").Text(), "it's'");
  EXPECT_EQ(Root("a: \"x\\\\\"\n").At("a").Text(), "x\\");
}

TEST(ParseTest, RefusesAnchorsAliasesAndTags) {
  EXPECT_THAT(ParseError("a: &x 1\nb: *x\n"),
              AllOf(StartsWith("f.yaml:1:"), EndsWith("; allowed: no anchors and aliases")));
  EXPECT_THAT(ParseError("a: &x [1]"), EndsWith("; allowed: no anchors and aliases"));
  EXPECT_THAT(ParseError("a: &x {b: *x}"), EndsWith("; allowed: no anchors and aliases"));
  EXPECT_THAT(ParseError("a: &x ~"), EndsWith("; allowed: no anchors and aliases"));
  EXPECT_THAT(ParseError("a: *x"), StartsWith("f.yaml:1:4: "));
  EXPECT_THAT(ParseError("a: !!str 1"),
              AllOf(StartsWith("f.yaml:1:"), EndsWith("; allowed: no tags")));
  for (const char* text :
       {"a: !pose {}", "a: ! 1", "a: !\n", "a: !!null ~", "!x a: 1", "- !<y> z"}) {
    EXPECT_THAT(ParseError(text), EndsWith("; allowed: no tags")) << text;
  }
}

TEST(ParseTest, RefusesASecondDocument) {
  EXPECT_THAT(ParseError("a: 1\n---\nb: 2\n"),
              AllOf(StartsWith("f.yaml:2:1: a second document"),
                    EndsWith("; allowed: one document in a file")));
  EXPECT_THAT(ParseError("{} {}"), StartsWith("f.yaml:1:"));
  EXPECT_EQ(Root("---\na: 1\n...\n").At("a").Number(), 1.0);
}

TEST(ParseTest, RefusesWhatIsNoText) {
  EXPECT_EQ(ParseError(std::string("a: 1\nb\0", 7)),
            "f.yaml:2:2: the byte 0x00 is not part of a text; allowed: UTF-8 without control "
            "characters");
  for (const char* bytes : {"\x04", "\x1b", "\x7f", "\xff", "\xc3", "\xc0\xaf", "\xed\xa0\x80",
                            "\xf4\x90\x80\x80", "\xe2\x82", "\xc2\x9b", "\xef\xbf\xbe"}) {
    EXPECT_THAT(ParseError(std::string("a: ") + bytes), StartsWith("f.yaml:1:4: the byte 0x"));
  }
  EXPECT_EQ(Root("a: \xc2\x85x\xf0\x9f\x98\x80").At("a").IsScalar(), true);
}

TEST(ParseTest, BoundsTheNesting) {
  const std::string deep(256, '['), ends(256, ']');
  EXPECT_TRUE(Root(deep + "1" + ends).IsList());
  EXPECT_THAT(ParseError(deep + "[1]" + ends), StartsWith("f.yaml:1:257: nested too deeply"));
}

TEST(ParseTest, SurvivesHostileNesting) {
  for (const std::string unit : {"[", "{", "[{", "[a: ", "{a: ", "- ", "? ", ": ", "a:\n ", "[?",
                                 "{?", "!a ", "&a ", "- ? "}) {
    std::string text;
    while (text.size() < 100000) text += unit;
    EXPECT_THROW(Document::Parse(text, "f.yaml"), InputError) << unit;
  }
  std::string staircase;
  for (std::size_t i = 0; i < 600; ++i) staircase += std::string(i, ' ') + "a:\n";
  EXPECT_THAT(ParseError(staircase), HasSubstr("nested too deeply"));
}

TEST(LoadTest, ReadsAFileAndNamesIt) {
  const std::filesystem::path file = ScratchFile("document.yaml");
  std::ofstream(file) << "format: assay-scenario/1\nx: y\n";
  const Document document = Document::Load(file);
  document.RequireFormat("assay-scenario/1");
  EXPECT_EQ(document.root().At("x").Place().Text(), file.string() + ":2:4");
  std::filesystem::remove(file);
}

TEST(LoadTest, RefusesMissingFilesAndDirectories) {
  const std::filesystem::path directory = testing::TempDir();
  EXPECT_THAT(Error([&] { Document::Load(directory / "assay_no_such_file.yaml"); }),
              HasSubstr("assay_no_such_file.yaml: no such file; allowed: "));
  EXPECT_THAT(Error([&] { Document::Load(directory); }), HasSubstr(": is a directory; allowed: "));
  EXPECT_THAT(Error([] { Document::Load(""); }), HasSubstr("no such file"));
}

TEST(LoadTest, RefusesTooLargeAFile) {
  const std::filesystem::path file = ScratchFile("large.yaml");
  std::ofstream(file) << "a";
  std::filesystem::resize_file(file, (std::uintmax_t{8} << 20) + 1);
  EXPECT_THAT(Error([&] { Document::Load(file); }),
              HasSubstr("the file is too large; allowed: 8388608 bytes"));
  std::filesystem::remove(file);
}

TEST(FormatTest, IsRequiredExactly) {
  const auto require = [](const std::string& text) {
    Document::Parse(text, "f.yaml").RequireFormat("assay-plan/1");
  };
  require("format: assay-plan/1");
  require("{\"format\": \"assay-plan/1\"}");
  EXPECT_EQ(Error([&] { require("format: assay-plan/2"); }),
            "f.yaml:1:9: unknown format 'assay-plan/2'; did you mean 'assay-plan/1'?; allowed: "
            "assay-plan/1");
  EXPECT_THAT(Error([&] { require("x: 1"); }), HasSubstr("missing key 'format'"));
  EXPECT_THAT(Error([&] { require("[]"); }), HasSubstr("is not a map"));
  EXPECT_THAT(Error([&] { require("format: []"); }), HasSubstr("is not a text"));
}

TEST(NearestNameTest, FindsSlipsOfTheKeyboard) {
  const std::vector<std::string> names = {"format", "units", "goal", "mating_vector"};
  EXPECT_EQ(NearestName("gaol", names), "goal");
  EXPECT_EQ(NearestName("gol", names), "goal");
  EXPECT_EQ(NearestName("fromat", names), "format");
  EXPECT_EQ(NearestName("unit", names), "units");
  EXPECT_EQ(NearestName("mating-vektor", names), "mating_vector");
  EXPECT_EQ(NearestName("workcell", names), "");
  EXPECT_EQ(NearestName("", names), "");
  EXPECT_EQ(NearestName("x", {"y"}), "");
  EXPECT_EQ(NearestName("abd", {"abc", "abe"}), "abc") << "the first of equally near names";
  EXPECT_EQ(NearestName("goal", {}), "");
}

// Calls every accessor of every value. An accessor may throw only an InputError at the place of the
// value.
void Walk(const Value& value) {
  const auto attempt = [&](auto accessor) {
    try {
      accessor();
    } catch (const InputError& error) {
      EXPECT_GT(error.place().line, 0);
      EXPECT_GT(error.place().column, 0);
      EXPECT_THAT(error.what(), Not(HasSubstr("\n")));
    }
  };
  attempt([&] { value.Text(); });
  attempt([&] { value.Number(); });
  attempt([&] { value.Integer(-5, 5); });
  attempt([&] { value.Flag(); });
  attempt([&] { value.Numbers(3); });
  attempt([&] { value.OneOf({"inch", "metre"}); });
  attempt([&] { value.At("pose"); });
  attempt([&] { value.Find("pose"); });
  attempt([&] { value.AllowOnly({"format", "units", "pose"}); });
  attempt([&] {
    for (const Value& item : value.Items()) Walk(item);
  });
  attempt([&] {
    for (const auto& [key, item] : value.Entries()) {
      Walk(key);
      Walk(item);
    }
  });
}

const char* const kSamples[] = {
    R"(format: assay-scenario/1
units: {length: inch, angle: degree}
parts:
  block: {model: block, pose: {stable: face-down, at: [22, 6], yaw: 30}, error: {x: 0.11}}
goal:
  - assembled: {held: peg, fixed: block, features: [[7, 8], [7, 8]],
                pose: {columns: [[-1, 0, 0], [0, 1, 0]]}, mating_vector: [-4, 0, 0]}
)",
    R"({"format": "assay-plan/1", "outcome": "planned",
 "actions": [{"id": 0, "name": "pickup", "arguments": {"part": "peg", "at": [1e-3, -2.5, 0]}}],
 "ordering": [[0, 1], [1, 2]], "errors": 0, "ok": true, "text": "a\n\u00e9\\"}
)",
    R"(# block style, with every kind of scalar
---
name: 'it''s quoted'
folded: >
  one
  two
literal: |
  three

  four
? asked
: answered
empty:
list:
- - 1
  - .5
- ~
- "x\ty"
...
)"};

std::string Mutate(std::string text, RandomStream& random) {
  const auto place = [&] {
    return static_cast<std::size_t>(random.Index(static_cast<int>(text.size())));
  };
  for (int count = 1 + random.Index(4); count > 0 && !text.empty(); --count) {
    const std::size_t at = place();
    const std::size_t length = 1 + static_cast<std::size_t>(random.Index(8));
    constexpr std::string_view kSyntax = "[]{}:,-?&*!|>'\"%@`#\n\t ~\\.0";
    switch (random.Index(6)) {
      case 0:
        text[at] = static_cast<char>(text[at] ^ (1 << random.Index(8)));
        break;
      case 1:
        text.erase(at, length);
        break;
      case 2:
        text.insert(at, 1, static_cast<char>(random.Index(256)));
        break;
      case 3:
        text.insert(
            at, 1,
            kSyntax[static_cast<std::size_t>(random.Index(static_cast<int>(kSyntax.size())))]);
        break;
      case 4:
        text.insert(place(), text.substr(at, 4 * length));
        break;
      case 5:
        text.resize(at);
        break;
    }
  }
  return text;
}

TEST(RobustnessTest, AMutatedDocumentParsesOrIsAnInputError) {
  RandomStream random(20240521, "document mutations");
  int parsed = 0;
  for (int i = 0; i < 3000; ++i) {
    const std::string text = Mutate(kSamples[i % 3], random);
    SCOPED_TRACE(testing::Message() << "mutation " << i << ":\n" << text);
    try {
      const Document document = Document::Parse(text, "f.yaml");
      ++parsed;
      Walk(document.root());
    } catch (const InputError& error) {
      ASSERT_GT(error.place().line, 0);
      ASSERT_GT(error.place().column, 0);
    } catch (const std::exception& error) {
      FAIL() << error.what();
    }
  }
  EXPECT_GT(parsed, 500) << "mutations too wild to test the accessors";
  EXPECT_LT(parsed, 2500) << "mutations too tame to test the parser";
}

// Returns everything that a value's accessors return, as a text.
std::string Told(const Value& value) {
  std::string told = value.Place().Text();
  if (value.IsScalar()) {
    told += " " + value.Text();
    try {
      value.Number();
      told += " is a number";
    } catch (const InputError& error) {
      told += error.what();
    }
  } else if (value.IsList()) {
    told += " list";
    for (const Value& item : value.Items()) told += "\n" + Told(item);
  } else if (value.IsMap()) {
    told += " map";
    for (const auto& [key, item] : value.Entries()) told += "\n" + Told(key) + ": " + Told(item);
  }
  return told + ";";
}

const char* const kJsonSamples[] = {
    R"({"format": "assay-plan/1", "outcome": "planned",
 "actions": [{"id": 0, "name": "pickup", "arguments": {"part": "peg", "at": [1e-3, -2.5, 0]}}],
 "ordering": [[0, 1], [1, 2]], "errors": 0, "ok": true, "text": "a\n\u00e9\\ \/"}
)",
    "[\n  {\"\": [], \"a b\": {}, \"\xc3\xa9\xe2\x82\xac\": \"\xf0\x9f\x98\x80 # no: comment\", "
    "\"n\": 1 },\n"
    "-1,\n\"- 1\", [ false ,\n true], {\"x\":{\"y\":[1,2,[\"\\t\\\"'\"]]}}, \"~\", \"\"]\n\n",
    R"({"a": [1.5E+3, -0.0, "b"], "c": {"d": "e, f", "g": [[], {}, [{}]]}, "h": "i", "j": -7})"};

// JSON texts are read without yaml-cpp, and must give the same values as with it. The oracle is the
// same text with a YAML comment at its end. With the comment, the text is not JSON, so yaml-cpp
// reads it.
TEST(JsonTest, IsReadAsYamlIs) {
  RandomStream random(20240522, "JSON mutations");
  int parsed = 0;
  for (int i = 0; i < 6000; ++i) {
    const std::string sample = kJsonSamples[i % 3];
    const std::string text = i < 3 ? sample : Mutate(sample, random);
    SCOPED_TRACE(testing::Message() << "mutation " << i << ":\n" << text);
    std::string told;
    try {
      told = Told(Document::Parse(text, "f.yaml").root());
    } catch (const InputError&) {
      continue;
    }
    ++parsed;
    EXPECT_EQ(told, Told(Document::Parse(text + "\n#", "f.yaml").root()));
  }
  EXPECT_GT(parsed, 300) << "mutations too wild";
}

}  // namespace
}  // namespace assay::document_test
