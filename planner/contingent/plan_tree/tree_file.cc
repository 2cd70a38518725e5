#include "planner/contingent/plan_tree/tree_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

namespace assay::contingent {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kFormat = "assay-tree/1";
constexpr std::string_view kAnd = " & ";

Json ArgumentsToJson(const GroundTask& task, const GroundAction& action) {
  Json arguments = Json::array();
  for (std::size_t i = 0; i < action.arguments.size(); ++i) {
    const FunctionId function = action.run_time_values[i];
    if (function.IsNone()) {
      arguments.push_back(action.arguments[i]);
    } else {
      arguments.push_back({{"value_of", task.functions[function.index()].text}});
    }
  }
  return arguments;
}

Json NodeToJson(const GroundTask& task, const PlanNode& node) {
  switch (node.kind) {
    case PlanNode::Kind::kGoal:
      return {{"goal", true}};
    case PlanNode::Kind::kAct: {
      const GroundAction& action = task.actions[node.action.index()];
      return {{"act", {{"name", action.name}, {"arguments", ArgumentsToJson(task, action)}}},
              {"then", node.children.front().index()}};
    }
    case PlanNode::Kind::kWhether:
      return {{"branch", TextOf(task, task.formulas[node.formula.index()])},
              {"true", node.children[0].index()},
              {"false", node.children[1].index()}};
    case PlanNode::Kind::kValue: {
      const GroundFunction& function = task.functions[node.function.index()];
      Json json = {{"branch", function.text}, {"values", Json::object()}};
      for (std::size_t i = 0; i < node.values.size(); ++i) {
        for (std::size_t v = 0; v < function.values.size(); ++v) {
          if (function.values[v] != node.values[i]) continue;
          json["values"][function.constants[v]] = node.children[i].index();
        }
      }
      return json;
    }
  }
  return {};
}

// Returns a and b for "a & b". Conjunctions are equal in whatever order they are written.
std::set<std::string> Conjuncts(std::string_view text) {
  std::set<std::string> conjuncts;
  while (true) {
    const std::size_t end = text.find(kAnd);
    conjuncts.emplace(text.substr(0, end));
    if (end == std::string_view::npos) return conjuncts;
    text.remove_prefix(end + kAnd.size());
  }
}

class TreeReader {
 public:
  explicit TreeReader(const GroundTask& task) : task_(task) {}

  PlanTree Read(const Value& json) {
    json.AllowOnly({"format", "root", "nodes"});
    json.At("format").OneOf({kFormat});
    const std::vector<Value> nodes = json.At("nodes").Items();
    count_ = static_cast<int>(nodes.size());
    PlanTree tree;
    tree.root = Number(json.At("root"));
    for (const Value& node : nodes) tree.nodes.push_back(ReadNode(node));
    RequireEnd(tree, nodes);
    RequireThatRepeatsGoBack(tree, nodes);
    return tree;
  }

 private:
  NodeId Number(const Value& value) const { return NodeId(value.Integer(0, count_ - 1)); }

  PlanNode ReadNode(const Value& json) const {
    PlanNode node;
    if (json.Find("act")) {
      json.AllowOnly({"act", "then", "repeats"});
      node.kind = PlanNode::Kind::kAct;
      node.action = ActionOf(json.At("act"));
      node.children = {Number(json.At("then"))};
    } else if (json.Find("values")) {
      json.AllowOnly({"branch", "values", "repeats"});
      ReadValues(json, node);
    } else if (json.Find("branch")) {
      json.AllowOnly({"branch", "true", "false", "repeats"});
      node.kind = PlanNode::Kind::kWhether;
      node.formula = FormulaOf(json.At("branch"));
      node.children = {Number(json.At("true")), Number(json.At("false"))};
    } else if (const auto goal = json.Find("goal")) {
      json.AllowOnly({"goal"});
      if (!goal->Flag()) goal->Fail("'goal' is false", "true");
    } else {
      json.AllowOnly({"act", "branch", "goal"});
      json.Fail("a node without act, branch or goal", "one of them");
    }
    ReadRepeats(json, node);
    return node;
  }

  ActionId ActionOf(const Value& json) const {
    json.AllowOnly({"name", "arguments"});
    GroundAction wanted;
    wanted.name = json.At("name").Text();
    for (const Value& argument : json.At("arguments").Items()) {
      if (argument.IsMap()) argument.AllowOnly({"value_of"});
      wanted.arguments.push_back(argument.IsMap() ? argument.At("value_of").Text()
                                                  : argument.Text());
    }
    for (std::size_t a = 0; a < task_.actions.size(); ++a) {
      const GroundAction& action = task_.actions[a];
      if (action.name == wanted.name && action.arguments == wanted.arguments) return ActionId(a);
    }
    RequireActionName(json.At("name"));
    json.Fail(fmt::format("no action {}", TextOf(wanted)),
              fmt::format("{} of other arguments", wanted.name));
  }

  void RequireActionName(const Value& name) const {
    std::set<std::string> names;
    for (const GroundAction& action : task_.actions) names.insert(action.name);
    name.OneOf({names.begin(), names.end()});
  }

  FormulaId FormulaOf(const Value& json) const {
    const std::set<std::string> conjuncts = Conjuncts(json.Text());
    for (std::size_t f = 0; f < task_.formulas.size(); ++f) {
      if (Conjuncts(TextOf(task_, task_.formulas[f])) == conjuncts) return FormulaId(f);
    }
    json.Fail(fmt::format("nothing senses '{}'", json.Text()), "what actions add to Kw");
  }

  void ReadValues(const Value& json, PlanNode& node) const {
    node.kind = PlanNode::Kind::kValue;
    const std::string text = json.At("branch").Text();
    const auto found = std::find_if(task_.functions.begin(), task_.functions.end(),
                                    [&](const GroundFunction& f) { return f.text == text; });
    if (found == task_.functions.end()) {
      json.At("branch").Fail(fmt::format("no function '{}'", text), "those of the domain");
    }
    node.function = FunctionId(static_cast<int>(found - task_.functions.begin()));
    for (const auto& [constant, child] : json.At("values").Entries()) {
      node.values.push_back(found->values[constant.OneOf(found->constants)]);
      node.children.push_back(Number(child));
    }
  }

  void ReadRepeats(const Value& json, PlanNode& node) const {
    const auto repeats = json.Find("repeats");
    if (!repeats) return;
    node.repeats.resize(node.children.size(), false);
    for (const Value& number : repeats->Items()) {
      const NodeId head = Number(number);
      if (std::ranges::count(node.children, head) == 0) {
        number.Fail("not a child of this node", "its children");
      }
      for (std::size_t i = 0; i < node.children.size(); ++i) {
        if (node.children[i] == head) node.repeats[i] = true;
      }
    }
  }

  // Returns the parents of each node. Repeats do not count.
  static std::vector<std::vector<NodeId>> ParentsOf(const PlanTree& tree) {
    std::vector<std::vector<NodeId>> parents(tree.nodes.size());
    for (std::size_t n = 0; n < tree.nodes.size(); ++n) {
      for (std::size_t i = 0; i < tree.nodes[n].children.size(); ++i) {
        if (!tree.nodes[n].Repeats(i))
          parents[tree.nodes[n].children[i].index()].push_back(NodeId(n));
      }
    }
    return parents;
  }

  // Checks that every path ends or comes to a repeat. Nodes are removed from the ends.
  static void RequireEnd(const PlanTree& tree, const std::vector<Value>& places) {
    const std::vector<std::vector<NodeId>> parents = ParentsOf(tree);
    std::vector<int> open(tree.nodes.size(), 0);
    for (const std::vector<NodeId>& of_node : parents) {
      for (const NodeId parent : of_node) ++open[parent.index()];
    }
    std::vector<NodeId> ended;
    for (std::size_t n = 0; n < tree.nodes.size(); ++n) {
      if (open[n] == 0) ended.push_back(NodeId(n));
    }
    for (std::size_t next = 0; next < ended.size(); ++next) {
      for (const NodeId parent : parents[ended[next].index()]) {
        if (--open[parent.index()] == 0) ended.push_back(parent);
      }
    }
    const auto endless = std::find_if(open.begin(), open.end(), [](int left) { return left > 0; });
    if (endless != open.end()) {
      places[endless - open.begin()].Fail("this leads back to itself", "repeats that are named");
    }
  }

  // Checks that every path to a repeating node has passed the node where the repeat begins. A
  // search from the repeating node back to the beginning, through the nodes of the repeat, must not
  // meet the root.
  static void RequireThatRepeatsGoBack(const PlanTree& tree, const std::vector<Value>& places) {
    std::map<NodeId, std::vector<NodeId>> ends;  // by the node where the repeat begins
    for (std::size_t n = 0; n < tree.nodes.size(); ++n) {
      for (std::size_t i = 0; i < tree.nodes[n].children.size(); ++i) {
        if (tree.nodes[n].Repeats(i)) ends[tree.nodes[n].children[i]].push_back(NodeId(n));
      }
    }
    const std::vector<std::vector<NodeId>> parents = ParentsOf(tree);
    // indexed by node: the last beginning whose search reached the node
    std::vector<NodeId> repeated_from(tree.nodes.size());
    for (const auto& [head, of_head] : ends) {
      for (const NodeId end : of_head) {
        std::vector<NodeId> open = {end};
        while (!open.empty()) {
          const NodeId id = open.back();
          open.pop_back();
          if (id == head || std::exchange(repeated_from[id.index()], head) == head) continue;
          if (id == tree.root) FailNotAbove(head, places[end.index()]);
          const std::vector<NodeId>& before = parents[id.index()];
          open.insert(open.end(), before.begin(), before.end());
        }
      }
    }
  }

  [[noreturn]] static void FailNotAbove(NodeId head, const Value& place) {
    place.Fail(
        fmt::format("a repeat of node {}, which is not an ancestor on every way to this node",
                    head.index()),
        "repeats of nodes that every way from the root to this node passes");
  }

  const GroundTask& task_;
  int count_ = 0;
};

}  // namespace

Json ToJson(const GroundTask& task, const PlanTree& tree) {
  Json nodes = Json::array();
  for (const PlanNode& node : tree.nodes) {
    Json json = NodeToJson(task, node);
    std::set<NodeId> heads;
    for (std::size_t i = 0; i < node.children.size(); ++i) {
      if (node.Repeats(i) && heads.insert(node.children[i]).second) {
        json["repeats"].push_back(node.children[i].index());
      }
    }
    nodes.push_back(std::move(json));
  }
  return {{"format", kFormat}, {"root", tree.root.index()}, {"nodes", std::move(nodes)}};
}

PlanTree ReadTree(const Value& tree, const GroundTask& task) { return TreeReader(task).Read(tree); }

}  // namespace assay::contingent
