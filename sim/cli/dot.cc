#include "sim/cli/dot.h"

#include <fmt/format.h>

#include <map>
#include <tuple>

#include "planner/contingent/tree_text.h"
#include "sim/cli/plan_text.h"

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
    const std::string label = fmt::format("{} {}", step.executed, Text(problem, step.action));
    text += fmt::format("  {} [label={}];\n", Quoted(step.name), Quoted(label));
  }
  for (const auto& [first, second] : plan.ordering) {
    text +=
        fmt::format("  {} -> {};\n", Quoted(plan.step(first).name), Quoted(plan.step(second).name));
  }
  return text + "}\n";
}

namespace {

// The labels themselves where they are few, else how many.
std::string LabelsOf(const posting::PartialPlan& plan, domain::VariableId variable) {
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

std::string ConstraintNetworkToDot(const posting::PartialPlan& plan) {
  std::string text =
      fmt::format("graph {} {{\n  node [shape=ellipse];\n", Quoted(plan.problem().name));
  for (const domain::ActionTemplate& action : plan.steps()) {
    for (const domain::InitialConstraint& initial : action.initial) {
      const std::string& name = plan.variables()[initial.variable].name;
      text += fmt::format("  {} [label={}];\n", Quoted(name),
                          Quoted(name + ": " + LabelsOf(plan, initial.variable)));
    }
  }
  for (const posting::GeometricGoalRef& goal : plan.satisfied_geometric()) {
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

std::string ContactGraphToDot(const std::string& name, const finemotion::LocalTopology& topology) {
  const auto& [contacts, graph] = std::tie(topology.space.contacts, topology.graph);
  std::string text = fmt::format("graph {} {{\n  rankdir=TB;\n  node [shape=box];\n", Quoted(name));
  std::map<int, std::string> rows;  // by dimension
  for (std::size_t i = 0; i < graph.states.size(); ++i) {
    const finemotion::ContactState& state = graph.states[i];
    std::string label = state.contacts.empty() ? "free" : "";
    for (const int contact : state.contacts) {
      label += fmt::format("{}{}", label.empty() ? "" : "\\n",
                           Name(contacts[static_cast<std::size_t>(contact)]));
    }
    text += fmt::format("  s{} [label=\"{}\"];\n", i, label);
    rows[state.dimension] += fmt::format(" s{};", i);
    for (const int son : state.sons) text += fmt::format("  s{} -- s{};\n", i, son);
  }
  for (const auto& [dimension, states] : rows) {
    text += fmt::format("  {{ rank=same;{} }}  // {} dimensions\n", states, dimension);
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
