#include "planner/contingent/tree_file.h"

#include <nlohmann/json.hpp>

namespace assay::contingent {
namespace {

using Json = nlohmann::ordered_json;

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

Json ToJson(const GroundTask& task, const PlanNode& node) {
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

}  // namespace

Json ToJson(const GroundTask& task, const PlanTree& tree) {
  Json nodes = Json::array();
  for (const PlanNode& node : tree.nodes) {
    Json json = ToJson(task, node);
    for (std::size_t i = 0; i < node.children.size(); ++i) {
      if (node.Repeats(i)) json["repeats"].push_back(node.children[i].index());
    }
    nodes.push_back(std::move(json));
  }
  return {{"format", "assay-tree/1"}, {"root", tree.root.index()}, {"nodes", std::move(nodes)}};
}

}  // namespace assay::contingent
