#include "planner/network/constraint_network/network_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "planner/network/labeling/count.h"

namespace assay::network::network_file_test {
namespace {

using testing::HasSubstr;

NamedNetwork Read(const std::string& text) { return ReadNetwork(Document::Parse(text, "net")); }

std::string ErrorOf(const std::string& text) {
  try {
    Read(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

LabelReport Label(const std::string& text, LabelRequest request) {
  Budget budget(std::numeric_limits<std::int64_t>::max());
  return LabelNetwork(Read(text), request, budget);
}

TEST(NetworkFile, ReadsNamesCountsAndBothKindsOfPairs) {
  const std::string text = R"({"nodes": {"v": ["a", "b"], "w": 3, "x": ["a", "c"]},
    "arcs": [{"between": ["v", "w"], "pairs": [["a", 0], ["b", 2], ["b", 1]]},
             {"between": ["x", "v"], "forbidden": [["a", "b"], ["c", "a"]]}]})";
  const NamedNetwork named = Read(text);
  EXPECT_THAT(named.nodes, testing::ElementsAre("v", "w", "x"));
  EXPECT_THAT(named.labels[1], testing::ElementsAre("0", "1", "2"));
  ASSERT_EQ(named.network.arcs().size(), 2u);
  EXPECT_EQ(*named.network.arcs()[1].relation,
            *Relation::Where(2, 2, [](int x, int v) { return x == v; }));

  const LabelReport all = Label(text, LabelRequest::kAll);
  EXPECT_EQ(all.outcome, Outcome::kFound);
  EXPECT_EQ(all.count, 3u);
  const NamedLabeling one = {{"v", "a"}, {"w", "0"}, {"x", "a"}};
  const NamedLabeling two = {{"v", "b"}, {"w", "1"}, {"x", "c"}};
  const NamedLabeling three = {{"v", "b"}, {"w", "2"}, {"x", "c"}};
  EXPECT_THAT(all.labelings, testing::UnorderedElementsAre(one, two, three));
  EXPECT_THAT(Label(text, LabelRequest::kFirst).labelings,
              testing::ElementsAre(testing::AnyOf(one, two, three)));
  EXPECT_EQ(Label(text, LabelRequest::kCount).count, 3u);
}

TEST(NetworkFile, ReportsThatThereIsNoLabeling) {
  const std::string text = "nodes: {v: 2, w: 2}\narcs: [{between: [v, w], pairs: []}]\n";
  EXPECT_EQ(Label(text, LabelRequest::kFirst).outcome, Outcome::kNone);
  EXPECT_EQ(Label(text, LabelRequest::kAll).count, 0u);
  EXPECT_EQ(Label(text, LabelRequest::kCount).count, 0u);
  EXPECT_EQ(Label("nodes: {v: []}", LabelRequest::kFirst).outcome, Outcome::kNone);
}

// A list of numbers restricts a node to these labels. Pairs with other labels have no effect.
TEST(NetworkFile, ListsOfNumbersChooseAmongMoreLabels) {
  const std::string text =
      "nodes: {v: [2, 5], w: 2}\narcs: [{between: [v, w], pairs: [[0, 0], [5, 1]]}]\n";
  EXPECT_EQ(Label(text, LabelRequest::kCount).count, 1u);
  const NamedLabeling only = {{"v", "5"}, {"w", "1"}};
  EXPECT_THAT(Label(text, LabelRequest::kFirst).labelings, testing::ElementsAre(only));
}

TEST(NetworkFile, ErrorsTellThePlace) {
  EXPECT_THAT(ErrorOf("nodes: {v: [a, b]}\narcs: [{between: [v, u], pairs: []}]\n"),
              HasSubstr("net:2:"));
  EXPECT_THAT(ErrorOf("nodes: {vase: [a, b]}\narcs: [{between: [vase, vasse], pairs: []}]\n"),
              HasSubstr("vase"));
  EXPECT_THAT(ErrorOf("nodes: {v: [a, b]}\narcs: [{between: [v, v], pairs: [[a, c]]}]\n"),
              HasSubstr("net:2:"));
  EXPECT_THAT(ErrorOf("nodes: {v: [a, b]}\narcs: [{between: [v, v], pairs: [[a, 1]]}]\n"),
              HasSubstr("net:2:"));
  EXPECT_THAT(ErrorOf("nodes: {v: 3}\narcs: [{between: [v, v], pairs: [[0, 3]]}]\n"),
              HasSubstr("net:2:"));
}

TEST(NetworkFile, RefusesWhatIsGivenTwiceOrNotAtAll) {
  EXPECT_THAT(ErrorOf("nodes: {v: [a, b, a]}"), HasSubstr("'a' is given twice"));
  EXPECT_THAT(ErrorOf("nodes: {v: 2, w: 3, v: 2}"), HasSubstr("twice"));
  EXPECT_THAT(ErrorOf("arcs: []"), HasSubstr("nodes"));
  EXPECT_THAT(ErrorOf("nodes: {v: 2}\narcs: [{between: [v, v]}]"), HasSubstr("'pairs'"));
  EXPECT_THAT(ErrorOf("nodes: {v: 2}\narcs: [{between: [v, v], pairs: [], forbidden: []}]"),
              HasSubstr("'forbidden'"));
  EXPECT_THAT(ErrorOf("nodes: {v: 2}\narcs: [{between: [v], pairs: []}]"),
              HasSubstr("exactly two"));
  EXPECT_THAT(ErrorOf("nodes: {v: 2}\narcs: [{between: [v, v], pairs: [[0]]}]"),
              HasSubstr("exactly two"));
  EXPECT_THAT(ErrorOf("nodes: {v: 2}\nedges: []"), HasSubstr("edges"));
}

TEST(NetworkFile, RefusesCountsOutOfRange) {
  EXPECT_THAT(ErrorOf("nodes: {v: -1}"), HasSubstr("net:1:"));
  EXPECT_THAT(ErrorOf("nodes: {v: 65537}"), HasSubstr("65536"));
  EXPECT_EQ(ErrorOf("nodes: {v: 65536}"), "no error");
}

}  // namespace
}  // namespace assay::network::network_file_test
