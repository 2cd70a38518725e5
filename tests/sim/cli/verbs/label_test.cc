#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/sim/cli/program.h"

namespace assay::cli::label_test {
namespace {

using ::testing::IsEmpty;
using ::testing::StartsWith;
using Json = nlohmann::json;

// Returns a network that colours the corners of a triangle. It has 3 * 2 * 1 labelings with three
// colours and none with two.
std::string Triangle(int colors) {
  Json same = Json::array();
  for (int c = 0; c < colors; ++c) same.push_back({c, c});
  Json network = {{"nodes", {{"a", colors}, {"b", colors}, {"c", colors}}},
                  {"arcs", Json::array()}};
  for (const auto& [v, w] : {std::pair("a", "b"), std::pair("b", "c"), std::pair("a", "c")}) {
    network["arcs"].push_back({{"between", {v, w}}, {"forbidden", same}});
  }
  return network.dump();
}

class Label : public ::testing::Test {
 protected:
  Ended Run(int colors, const std::vector<std::string>& options) const {
    std::vector<std::string> arguments = {"label", folder_.Write("network.json", Triangle(colors))};
    arguments.insert(arguments.end(), options.begin(), options.end());
    Ended ended = Assay(arguments);
    EXPECT_THAT(SchemaErrors("sim/cli/verbs/label.schema.json", ended.Json()), IsEmpty());
    return ended;
  }

  const Folder folder_;
};

TEST_F(Label, First) {
  const Ended ended = Run(3, {});
  EXPECT_EQ(ended.code, 0) << ended.err;
  const Json labeling = ended.Json()["labeling"];
  EXPECT_EQ(ended.Json()["outcome"], "labeled");
  EXPECT_NE(labeling["a"], labeling["b"]);
  EXPECT_NE(labeling["b"], labeling["c"]);
  EXPECT_NE(labeling["a"], labeling["c"]);
}

TEST_F(Label, AllAndCountAgree) {
  EXPECT_EQ(Run(3, {"--all"}).Json()["labelings"].size(), 6);
  EXPECT_EQ(Run(3, {"--all"}).Json()["count"], 6);
  EXPECT_EQ(Run(3, {"--count", "--json"}).Json()["count"], 6);
}

TEST_F(Label, ProofOfNone) {
  for (const char* request : {"--first", "--all", "--count"}) {
    const Ended ended = Run(2, {request});
    EXPECT_EQ(ended.code, 10) << request;
    EXPECT_EQ(ended.Json()["outcome"], "none") << request;
    EXPECT_FALSE(ended.Json().contains("labeling")) << request;
  }
}

TEST_F(Label, SpentBudget) {
  const Ended ended = Run(3, {"--all", "--budget", "1"});
  EXPECT_EQ(ended.code, 11);
  EXPECT_EQ(ended.Json()["outcome"], "budget");
}

TEST_F(Label, WrongNetwork) {
  const std::string file = folder_.Write("wrong.json", "{\"nodes\": {\"v\": 2},\n \"arsc\": []}");
  const Ended ended = Assay({"label", file});
  EXPECT_EQ(ended.code, 3);
  EXPECT_THAT(ended.err, StartsWith("assay: " + file + ":2:"));
}

}  // namespace
}  // namespace assay::cli::label_test
