#include "planner/plan/plan_files/json_layout.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "planner/base/random.h"

namespace assay::plan::json_layout_test {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::uint64_t kSeed = 29;

// Returns whether the text contains no control characters of a terminal: C0 except line breaks,
// DEL, C1, and U+202E.
bool IsHarmless(const std::string& text) {
  for (std::size_t at = 0; at < text.size(); ++at) {
    const auto byte = static_cast<unsigned char>(text[at]);
    const auto next = static_cast<unsigned char>(at + 1 < text.size() ? text[at + 1] : 0xff);
    if ((byte < 0x20 && byte != '\n') || byte == 0x7f || (byte == 0xc2 && next < 0xa0))
      return false;
    if (text.compare(at, 3, "\xe2\x80\xae") == 0) return false;
  }
  return true;
}

// For texts of any bytes, the JSON can be read and contains no control characters of a terminal.
TEST(Json, IsTextWhateverTheBytes) {
  RandomStream random(kSeed, "bytes");
  const std::string likely = "\x1b\x7f\n\xc2\x9b\xe2\x80\xae\xff\xc0\x80\"\\";
  for (int i = 0; i < 1000; ++i) {
    std::string bytes;
    for (int n = random.Index(30); n > 0; --n) {
      bytes += random.Index(2) == 0
                   ? likely[static_cast<std::size_t>(random.Index(static_cast<int>(likely.size())))]
                   : static_cast<char>(random.Index(256));
    }
    const Json json = {{"key " + bytes, bytes}, {"list", {bytes, 1}}};
    for (const std::string& text : {LaidOut(json), JsonText(json), JsonLine(json)}) {
      const Json read = Json::parse(text);  // the parser checks that the text is UTF-8
      EXPECT_EQ(read["list"][1], 1);
      EXPECT_TRUE(IsHarmless(text))
          << Json(bytes).dump(-1, ' ', true, Json::error_handler_t::replace);
    }
  }
}

TEST(Json, KeepsTextsThatAreOnes) {
  const Json json = {{"ä", "\x1b\xc2\x9b\n组装"}};
  EXPECT_EQ(Json::parse(JsonText(json)), json);
  EXPECT_EQ(Json::parse(LaidOut(json)), json);
  EXPECT_EQ(JsonLine(json), "{\"ä\":\"\\u001b\\u009b\\n组装\"}");
}

TEST(LaidOut, WhatFitsStandsOnOneLine) {
  EXPECT_EQ(LaidOut({{"a", {1, 2.5, "three"}}, {"b", Json::object()}}),
            "{\"a\": [1, 2.5, \"three\"], \"b\": {}}\n");
}

TEST(LaidOut, LongListsOfNumbersFillTheirLines) {
  const Json json = {{"numbers", std::vector<double>(40, 0.125)}};
  EXPECT_EQ(LaidOut(json),
            "{\n  \"numbers\": [\n"
            "    0.125, 0.125, 0.125, 0.125, 0.125, 0.125, 0.125, 0.125, 0.125, 0.125, 0.125, "
            "0.125, 0.125,\n"
            "    0.125, 0.125, 0.125, 0.125, 0.125, 0.125, 0.125, 0.125, 0.125, 0.125, 0.125, "
            "0.125, 0.125,\n"
            "    0.125, 0.125, 0.125, 0.125, 0.125, 0.125, 0.125, 0.125, 0.125, 0.125, 0.125, "
            "0.125, 0.125,\n"
            "    0.125\n  ]\n}\n");
}

// The shortest decimal number that reads back to the same double has at most 17 digits. With one
// digit less it would not read back.
TEST(LaidOut, NumbersAreExactAndAsShortAsTheyCanBe) {
  RandomStream random(kSeed, "numbers");
  for (int i = 0; i < 20'000; ++i) {
    const double x = std::ldexp(random.Uniform(-1, 1), random.Index(200) - 100);
    const std::string text = LaidOut(x);
    ASSERT_EQ(std::stod(text), x) << text;
    std::size_t digits = 0;
    while (digits < 17) {
      std::ostringstream shorter;
      shorter.precision(static_cast<std::streamsize>(++digits));
      shorter << x;
      if (std::stod(shorter.str()) == x) break;
    }
    const auto mantissa = text.substr(0, text.find('e'));
    const auto written = std::count_if(mantissa.begin(), mantissa.end(),
                                       [](char c) { return c >= '0' && c <= '9'; });
    EXPECT_LE(written, static_cast<std::ptrdiff_t>(digits) + 5) << text;  // room for leading zeros
  }
}

Json RandomJson(RandomStream& random, int depth) {
  if (depth == 0 || random.Index(4) == 0) {
    switch (random.Index(5)) {
      case 0:
        return random.Uniform(-1e3, 1e3);
      case 1:
        return random.Index(1000);
      case 2:
        return std::string(static_cast<std::size_t>(random.Index(150)), '"');
      case 3:
        return random.Index(2) == 0;
      default:
        return nullptr;
    }
  }
  Json json = random.Index(2) == 0 ? Json::array() : Json::object();
  for (int i = random.Index(12); i > 0; --i) {
    Json item = RandomJson(random, depth - 1);
    if (json.is_array()) {
      json.push_back(std::move(item));
    } else {
      json["a \\ key " + std::to_string(i)] = std::move(item);
    }
  }
  return json;
}

TEST(LaidOut, ReadsBackAsTheSame) {
  RandomStream random(kSeed, "documents");
  for (int i = 0; i < 300; ++i) {
    const Json json = RandomJson(random, 5);
    EXPECT_EQ(Json::parse(LaidOut(json)), json);
  }
}

// A value is spread over several lines only if it would not fit on its first line.
TEST(LaidOut, OnlyWhatDoesNotFitIsSpread) {
  RandomStream random(kSeed, "spread");
  int spread = 0;
  for (int i = 0; i < 100; ++i) {
    std::istringstream text(LaidOut(RandomJson(random, 5)));
    std::vector<std::string> lines;
    for (std::string line; std::getline(text, line);) lines.push_back(line);
    for (std::size_t first = 0; first < lines.size(); ++first) {
      if (lines[first].back() != '[' && lines[first].back() != '{') continue;
      const std::size_t indentation = lines[first].find_first_not_of(' ');
      std::string together = lines[first];
      for (std::size_t next = first + 1;; ++next) {
        const std::size_t begin = lines[next].find_first_not_of(' ');
        together += (together.back() == ',' ? " " : "") + lines[next].substr(begin);
        if (begin == indentation) break;
      }
      if (together.back() == ',') together.pop_back();
      EXPECT_GE(together.size(), 100u) << together;
      ++spread;
    }
  }
  EXPECT_GT(spread, 100);
}

TEST(LaidOut, OnlyWhatCannotBeBrokenIsLonger) {
  RandomStream random(kSeed, "lines");
  for (int i = 0; i < 100; ++i) {
    std::istringstream lines(LaidOut(RandomJson(random, 5)));
    for (std::string line; std::getline(lines, line);) {
      if (line.size() <= 100) continue;
      EXPECT_EQ(line.find(", \""), std::string::npos) << line;
    }
  }
}

}  // namespace
}  // namespace assay::plan::json_layout_test
