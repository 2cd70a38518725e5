#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>

#include "tests/sim/cli/program.h"

namespace assay::cli::command_line_test {
namespace {

using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::MatchesRegex;
using ::testing::StartsWith;

const std::vector<std::string> kVerbs = {"check",  "sweep",  "replay",    "plan",  "run",
                                         "render", "export", "label",     "bound", "calibrate",
                                         "doctor", "list",   "contingent"};

TEST(Help, ListsVerbsAndExitCodes) {
  const Ended ended = Assay({"--help"});
  EXPECT_EQ(ended.code, 0);
  for (const std::string& verb : kVerbs) EXPECT_THAT(ended.out, HasSubstr("\n  " + verb + " "));
  for (const char* code : {"   0  ", "   2  ", "   3  ", "   4  ", "  10  ", "  11  ", "  12  "}) {
    EXPECT_THAT(ended.out, HasSubstr(std::string("\n") + code));
  }
}

TEST(Help, OfEveryVerbHasAnExampleOfTheVerbAndNamesItsPage) {
  const std::regex manual("\nManual: (\\S+\\.md)\n");
  for (const std::string& verb : kVerbs) {
    const Ended ended = Assay({verb, "--help"});
    EXPECT_EQ(ended.code, 0) << verb;
    EXPECT_THAT(ended.out, HasSubstr("Example:\n  assay " + verb)) << verb;
    std::smatch page;
    ASSERT_TRUE(std::regex_search(ended.out, page, manual)) << ended.out;
    EXPECT_TRUE(std::filesystem::exists(std::filesystem::path(ASSAY_SOURCE_DIR) / page[1].str()))
        << page[1];
  }
}

// The greatest seed is 2^64 - 1. It must be read as a whole number, because the nearest double is
// 2^64.
TEST(Seeds, AreWhole) {
  const auto json = Assay({"run", kTwoActions, "--seed", "18446744073709551615", "--json"}).Json();
  EXPECT_EQ(json["seed"], 18446744073709551615ULL);
}

TEST(Version, IsPrinted) {
  const Ended ended = Assay({"--version"});
  EXPECT_EQ(ended.code, 0);
  EXPECT_THAT(ended.out, MatchesRegex("assay [0-9]+\\.[0-9]+\\.[0-9]+\n"));
}

// A wrong command line ends with exit code 2 and one line that says where help is.
class WrongCommandLine : public ::testing::Test {
 protected:
  static std::string Error(const std::vector<std::string>& arguments) {
    const Ended ended = Assay(arguments);
    EXPECT_EQ(ended.code, 2);
    EXPECT_EQ(ended.out, "");
    EXPECT_THAT(ended.err, AllOf(StartsWith("assay: "), HasSubstr("--help"), EndsWith("\n")));
    EXPECT_EQ(std::ranges::count(ended.err, '\n'), 1);
    return ended.err;
  }
};

TEST_F(WrongCommandLine, NoVerb) { EXPECT_THAT(Error({}), HasSubstr("plan, run")); }

TEST_F(WrongCommandLine, MistypedVerb) {
  EXPECT_THAT(Error({"plna", kTwoActions}), HasSubstr("did you mean 'plan'?"));
}

TEST_F(WrongCommandLine, MistypedOption) {
  EXPECT_THAT(Error({"plan", kTwoActions, "--bugdet", "5"}), HasSubstr("did you mean '--budget'?"));
  EXPECT_THAT(Error({"run", "--trails=3", kTwoActions}), HasSubstr("did you mean '--trials'?"));
}

TEST_F(WrongCommandLine, NumberOutOfRangeIsToldInItsUnit) {
  EXPECT_THAT(Error({"mate", kTwoActions, "--displacement", "30"}),
              HasSubstr("--displacement: 30 mm is out of range; allowed: 0 mm to 20 mm"));
  EXPECT_THAT(Error({"mate", kTwoActions, "--rotation", "-1"}),
              HasSubstr("--rotation: -1 deg is out of range; allowed: 0 deg to 10 deg"));
  EXPECT_THAT(Error({"mate", kTwoActions, "--clearance", "101"}),
              HasSubstr("101 mm is out of range; allowed: 0 mm to 100 mm"));
  EXPECT_THAT(Error({"check", kTwoActions, "--clearance", "1e3"}),
              HasSubstr("1e3 mm is out of range; allowed: 0 mm to 10 mm"));
  EXPECT_THAT(Error({"mate", kTwoActions, "--velocity", "0.2"}),
              HasSubstr("--velocity: 0.2 is out of range; allowed: 0 to 0.1"));
  EXPECT_THAT(Error({"run", kTwoActions, "--error-scale", "-1"}),
              HasSubstr("-1 is out of range; allowed: 0 or more"));
  EXPECT_THAT(Error({"run", kTwoActions, "--error-scale", "inf"}),
              HasSubstr("'inf' is no finite number"));
  EXPECT_THAT(Error({"run", kTwoActions, "--error-scale", "some"}),
              HasSubstr("'some' is no number"));
}

// Text is not read as the integer that the type's arithmetic makes of it.
TEST_F(WrongCommandLine, SeedsAreNotNegative) {
  for (const char* verb : {"run", "mate", "calibrate"}) {
    EXPECT_THAT(Error({verb, kTwoActions, "--seed", "-1"}),
                HasSubstr("'-1' is out of range; allowed: 0 to 18446744073709551615"))
        << verb;
  }
}

TEST_F(WrongCommandLine, OptionBeforeTheVerb) { Error({"--json", "plan", kTwoActions}); }

TEST_F(WrongCommandLine, MissingArgument) {
  for (const char* verb : {"plan", "check", "run", "render", "export", "label"}) {
    EXPECT_THAT(Error({verb}), HasSubstr("required")) << verb;
  }
}

TEST_F(WrongCommandLine, ArgumentTooMany) {
  EXPECT_THAT(Error({"plan", kTwoActions, "more"}), HasSubstr("'more'"));
}

TEST_F(WrongCommandLine, ValuesOutOfRange) {
  Error({"plan", kTwoActions, "--budget", "0"});
  Error({"plan", kTwoActions, "--budget", "many"});
  Error({"plan", kTwoActions, "--instances", "-1"});
  Error({"plan", kTwoActions, "--propagation", "papper"});
  Error({"plan", kTwoActions, "--explain", "pickup"});
  Error({"run", kTwoActions, "--trials", "0"});
  Error({"run", kTwoActions, "--jobs", "0"});
  Error({"run", kTwoActions, "--seed", "-1"});
  Error({"run", kTwoActions, "--seed", "18446744073709551616"});
  Error({"run", kTwoActions, "--attempts", "9223372036854775808"});
  Error({"run", kTwoActions, "--seed", "18446744073709551616"});
  Error({"run", kTwoActions, "--camera", "nope"});
  Error({"run", kTwoActions, "--grasp", "glue"});
  Error({"plan", kTwoActions, "--models", "/no/such/folder"});
  Error({"list", "robots"});
}

TEST_F(WrongCommandLine, WhatIsNoNumber) {
  for (const char* value : {"nan", "-nan", "NaN"}) {
    EXPECT_THAT(Error({"mate", kTwoActions, "--friction", value}), HasSubstr("no number")) << value;
    EXPECT_THAT(Error({"run", kTwoActions, "--error-scale", value}), HasSubstr("no number"));
  }
}

TEST_F(WrongCommandLine, PictureSizes) {
  for (const char* size : {"640", "0x480", "640x", "x", "640x480x3", "-1x2", "5000x10", "6.4x4"}) {
    EXPECT_THAT(Error({"render", kTwoActions, "-o", "out", "--size", size}),
                HasSubstr("WIDTHxHEIGHT"))
        << size;
  }
}

TEST_F(WrongCommandLine, PicturesNeedAFolder) { Error({"run", kTwoActions, "--renders"}); }

TEST_F(WrongCommandLine, ExportsOneThing) {
  Error({"export", kTwoActions});
  Error({"export", kTwoActions, "--mjcf", "--dot"});
  Error({"export", kTwoActions, "--network", "--contacts"});
}

TEST_F(WrongCommandLine, RequestsThatExcludeEachOther) {
  Error({"label", "network.json", "--all", "--count"});
  Error({"plan", kTwoActions, "--explain", "1", "--json"});
}

}  // namespace
}  // namespace assay::cli::command_line_test
