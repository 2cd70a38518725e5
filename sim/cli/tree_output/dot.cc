#include "sim/cli/tree_output/dot.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "planner/contingent/plan_tree/tree_text.h"
#include "sim/cli/plan_output/plan_text.h"

namespace assay::cli {
namespace {

std::string Quoted(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + '"';
}

}  // namespace

std::string OrderingGraphToDot(const domain::Problem& problem, const plan::Plan& plan) {
  std::string text = fmt::format("digraph {} {{\n  node [shape=box];\n", Quoted(plan.problem));
  for (const plan::PlannedStep& step : plan.steps) {
    const std::string label = fmt::format("{} {}", step.executed, FullText(problem, step.action));
    text += fmt::format("  {} [label={}];\n", Quoted(step.name), Quoted(label));
  }
  for (const auto& [first, second] : plan.ordering) {
    text +=
        fmt::format("  {} -> {};\n", Quoted(plan.step(first).name), Quoted(plan.step(second).name));
  }
  return text + "}\n";
}

namespace {

// Returns the labels if they are few, and else their number.
std::string LabelsOf(const constraint_posting::PartialPlan& plan, domain::VariableId variable) {
  constexpr int kFew = 6;
  const network::LabelSet labels = plan.Labels(variable);
  if (labels.count() > kFew) return fmt::format("{} labels", labels.count());
  std::string text;
  for (int label : labels) {
    text += fmt::format("{}{}", text.empty() ? "" : " ",
                        domain::LabelName(plan.problem(), plan.variables()[variable], label));
  }
  return text;
}

}  // namespace

std::string ConstraintNetworkToDot(const constraint_posting::PartialPlan& plan) {
  std::string text =
      fmt::format("graph {} {{\n  node [shape=ellipse];\n", Quoted(plan.problem().name));
  for (const domain::ActionTemplate& action : plan.steps()) {
    for (const domain::InitialConstraint& initial : action.initial) {
      const std::string& name = plan.variables()[initial.variable].name;
      text += fmt::format("  {} [label={}];\n", Quoted(name),
                          Quoted(name + ": " + LabelsOf(plan, initial.variable)));
    }
  }
  for (const constraint_posting::GeometricGoalRef& goal : plan.satisfied_geometric()) {
    const domain::GeometricConstraint& constraint = plan.ConstraintOf(goal);
    if (constraint.grasp.IsNone() || constraint.position.IsNone()) continue;
    const auto name = [&](domain::VariableId id) {
      return Quoted(plan.variables()[plan.Resolve(id)].name);
    };
    text +=
        fmt::format("  {} -- {} [label={}];\n", name(constraint.grasp), name(constraint.position),
                    constraint.mating.IsNone() ? "reachable" : "mate_reachable");
  }
  return text + "}\n";
}

namespace {

// Returns the name of a contact state's node at a critical point.
std::string NodeOf(std::size_t point, std::size_t state) {
  return fmt::format("c{}s{}", point + 1, state);
}

std::string LabelOf(const finemotion::LocalTopology& topology, std::size_t i) {
  std::string label;
  for (const finemotion::ContactKey& contact : topology.ContactsOf(static_cast<int>(i)))
    label += Name(contact) + "\\n";
  if (label.empty()) label = "free\\n";
  const int to_goal = topology.graph.states[i].to_goal;
  return label + (to_goal < 0 ? "no way to a goal" : fmt::format("{} to a goal", to_goal));
}

// Returns the fill style of initial states and of goals.
const char* StyleOf(const finemotion::LocalTopology& topology, std::size_t i) {
  const auto has = [&](const std::vector<int>& states) {
    return std::ranges::count(states, static_cast<int>(i)) > 0;
  };
  if (has(topology.goals)) return ", style=filled, fillcolor=palegreen";
  return has(topology.initial) ? ", style=filled, fillcolor=lightblue" : "";
}

std::string ClusterOf(const finemotion::LocalTopology& topology, std::size_t point) {
  std::string text =
      fmt::format("  subgraph cluster{0} {{\n  label=\"critical point {0}\";\n", point + 1);
  std::map<int, std::string> rows;  // by dimension
  for (std::size_t i = 0; i < topology.graph.states.size(); ++i) {
    const finemotion::ContactState& state = topology.graph.states[i];
    const std::string node = NodeOf(point, i);
    text +=
        fmt::format("  {} [label=\"{}\"{}];\n", node, LabelOf(topology, i), StyleOf(topology, i));
    rows[state.dimension] += fmt::format(" {};", node);
    for (const int son : state.sons)
      text += fmt::format("  {} -- {};\n", node, NodeOf(point, static_cast<std::size_t>(son)));
  }
  for (const auto& [dimension, states] : rows)
    text += fmt::format("  {{ rank=same;{} }}  // {} dimensions\n", states, dimension);
  return text + "  }\n";
}

}  // namespace

std::string ContactChainToDot(const std::string& name, const finemotion::ContactChain& chain) {
  std::string text = fmt::format("graph {} {{\n  rankdir=TB;\n  node [shape=box];\n", Quoted(name));
  for (std::size_t point = 0; point < chain.points.size(); ++point)
    text += ClusterOf(chain.points[point], point);
  for (std::size_t point = 0; point < chain.shared.size(); ++point) {
    for (const finemotion::SharedState& state : chain.shared[point]) {
      text += fmt::format("  {} -- {} [style=bold, color=blue, constraint=false];\n",
                          NodeOf(point, static_cast<std::size_t>(state.earlier)),
                          NodeOf(point + 1, static_cast<std::size_t>(state.later)));
    }
  }
  return text + "}\n";
}

namespace {

std::string LabelOf(const contingent::GroundTask& task, const contingent::PlanNode& node) {
  switch (node.kind) {
    case contingent::PlanNode::Kind::kGoal:
      return "goal";
    case contingent::PlanNode::Kind::kAct:
      return TextOf(task.actions[node.action.index()]);
    case contingent::PlanNode::Kind::kWhether:
      return TextOf(task, task.formulas[node.formula.index()]) + "?";
    case contingent::PlanNode::Kind::kValue:
      return task.functions[node.function.index()].text + "?";
  }
  return "";
}

const char* ShapeOf(const contingent::PlanNode& node) {
  if (node.kind == contingent::PlanNode::Kind::kGoal) return "ellipse";
  return node.kind == contingent::PlanNode::Kind::kAct ? "box" : "diamond";
}

}  // namespace

std::string PlanTreeToDot(const contingent::GroundTask& task, const contingent::PlanTree& tree) {
  std::string text = "digraph plan {\n";
  for (std::size_t n = 0; n < tree.nodes.size(); ++n) {
    const contingent::PlanNode& node = tree.nodes[n];
    text +=
        fmt::format("  n{} [shape={}, label={}];\n", n, ShapeOf(node), Quoted(LabelOf(task, node)));
    for (std::size_t i = 0; i < node.children.size(); ++i) {
      const bool branches = node.kind != contingent::PlanNode::Kind::kAct;
      text += fmt::format("  n{} -> n{} [label={}{}];\n", n, node.children[i].index(),
                          Quoted(branches ? OutcomeText(task, node, i) : ""),
                          node.Repeats(i) ? ", style=dashed" : "");
    }
  }
  return text + "}\n";
}

}  // namespace assay::cli
