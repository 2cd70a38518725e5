#include "planner/plan/json_layout.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "planner/base/random.h"

namespace assay::plan::json_layout_test {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::uint64_t kSeed = 29;

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

// The shortest decimal number that reads back as the same double has at most 17 digits; one digit
// less does not read back.
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
    EXPECT_LE(written, static_cast<std::ptrdiff_t>(digits) + 5) << text;  // and leading zeros
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
