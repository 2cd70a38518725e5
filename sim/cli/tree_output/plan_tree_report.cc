#include "sim/cli/tree_output/plan_tree_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "planner/contingent/plan_tree/tree_file.h"
#include "planner/contingent/plan_tree/tree_text.h"
#include "planner/plan/plan_files/plan_file.h"
#include "sim/cli/plan_output/plan_text.h"

namespace assay::cli {
namespace {

using Json = nlohmann::ordered_json;
using assembly::ContingentAssembly;
using assembly::KnowledgeAction;

// Returns an action in the words of plans: "verify assemble(peg, block, ...)".
std::string Words(const std::vector<domain::Problem>& worlds, const ContingentAssembly& assembly,
                  const KnowledgeAction& action) {
  using Kind = KnowledgeAction::Kind;
  if (action.kind == Kind::kLook) {
    return fmt::format("look({}, {})", worlds.front().part(action.part).name, action.sensor);
  }
  const assembly::PlanOfWorlds& of = assembly.plans[action.plan];
  const domain::Problem& world = worlds[of.worlds.front()];
  const std::string step = FullText(world, of.plan.step(action.step).action);
  switch (action.kind) {
    case Kind::kVerify:
      return fmt::format("verify {}", step);
    case Kind::kDiagnose:
      return fmt::format("is it {}?", action.error);
    case Kind::kRecover:
      return fmt::format("recover from {}", action.error);
    case Kind::kOperator:
      return fmt::format("call the operator: {}", action.error);
    default:
      return step;
  }
}

// Returns the tree with its actions in the words of plans.
std::string TreeText(const std::vector<domain::Problem>& worlds,
                     const ContingentAssembly& assembly) {
  const contingent::GroundTask& task = assembly.knowledge.task;
  const std::map<std::string, std::string> words = ActionWords(worlds, assembly);
  std::istringstream lines(TextOf(task, assembly.tree, contingent::Sharing::kOnce));
  std::string text;
  for (std::string line; std::getline(lines, line);) {
    if (line.ends_with("()")) {
      const std::size_t space = line.rfind(' ');
      const std::size_t start = space == std::string::npos ? 0 : space + 1;
      line.replace(start, std::string::npos, words.at(line.substr(start)));
    }
    text += line + "\n";
  }
  return text;
}

std::string WorldsText(const std::vector<domain::Problem>& worlds, const std::vector<int>& of) {
  std::vector<std::string> names;
  for (const int world : of) names.push_back(assembly::NameOf(worlds[world]));
  return fmt::format("{}", fmt::join(names, "; "));
}

Json WorldToJson(const domain::Problem& world) {
  Json poses = Json::object();
  for (const domain::OpenPose& open : world.open_poses) {
    poses[world.part(open.part).name] = open.names[open.chosen];
  }
  return poses;
}

}  // namespace

std::map<std::string, std::string> ActionWords(const std::vector<domain::Problem>& worlds,
                                               const ContingentAssembly& assembly) {
  std::map<std::string, std::string> words;
  for (const auto& [name, action] : assembly.knowledge.actions) {
    words[name + "()"] = Words(worlds, assembly, action);
  }
  return words;
}

std::string Text(const std::vector<domain::Problem>& worlds, const ContingentAssembly& assembly) {
  if (assembly.outcome != Outcome::kFound) return Text(worlds.front(), assembly.unplanned);
  std::string text = TreeText(worlds, assembly);
  for (std::size_t p = 0; p < assembly.plans.size(); ++p) {
    const auto& [of, plan] = assembly.plans[p];
    text += fmt::format("\nplan {}", p + 1);
    if (worlds.size() > 1) text += fmt::format(", for the worlds with: {}", WorldsText(worlds, of));
    text += "\n" + Text(worlds[of.front()], {Outcome::kFound, plan, {}, {}});
  }
  return text;
}

Json ToJson(const std::vector<domain::Problem>& worlds, const ContingentAssembly& assembly) {
  if (assembly.outcome != Outcome::kFound) {
    return plan::ToJson(assembly.unplanned, worlds.front(), "");
  }
  Json json = {{"outcome", "planned"}};
  json["tree"] = contingent::ToJson(assembly.knowledge.task, assembly.tree);
  for (const auto& [of, plan] : assembly.plans) {
    Json whole = plan::ToJson({Outcome::kFound, plan, {}, {}}, worlds[of.front()], "");
    Json one = {{"worlds", Json::array()}};
    for (const int world : of) one["worlds"].push_back(WorldToJson(worlds[world]));
    for (const char* key : {"actions", "ordering", "verifications", "recoveries", "errors"}) {
      one[key] = whole[key];
    }
    json["plans"].push_back(std::move(one));
  }
  return json;
}

}  // namespace assay::cli
