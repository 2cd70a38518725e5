#include "planner/network/labeling/nodes_by_count.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "planner/base/random.h"

namespace assay::network::nodes_by_count_test {
namespace {

// The answers must agree with a plain list of the nodes in the order in which they were added.
TEST(NodesByCount, FindsTheLastAddedOfTheFewestLabels) {
  struct Node {
    int node, count;
  };
  constexpr int kNodes = 12;
  RandomStream random(1, "nodes-by-count");
  NodesByCount nodes(kNodes);
  std::vector<Node> added;
  for (int step = 0; step < 5000; ++step) {
    const int node = random.Index(kNodes);
    const auto known = std::ranges::find(added, node, &Node::node);
    if (known != added.end()) {
      nodes.Remove(node);
      added.erase(known);
    } else {
      added.push_back({.node = node, .count = 1 + random.Index(random.Index(2) ? 3 : kWordBits)});
      nodes.Add(node, added.back().count);
    }
    ASSERT_EQ(nodes.empty(), added.empty());
    if (added.empty()) continue;
    const auto fewest = std::ranges::min_element(added.rbegin(), added.rend(), {}, &Node::count);
    ASSERT_EQ(nodes.First(), fewest->node) << "step " << step;
  }
}

}  // namespace
}  // namespace assay::network::nodes_by_count_test
