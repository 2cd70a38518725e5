#include "sim/cli/dot.h"

#include <fmt/format.h>

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

}  // namespace assay::cli
