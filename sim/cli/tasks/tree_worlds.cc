#include "sim/cli/tasks/tree_worlds.h"

#include <fmt/format.h>

#include <variant>

#include "sim/cli/command_line/usage_error.h"
#include "sim/cli/tree_output/contingent_report.h"
#include "sim/execution/interpretation/planned_worlds.h"

namespace assay::cli {
namespace {

constexpr std::size_t kMostLeaves = 10'000;

}  // namespace

ContingentAnswer TreeOf(const execution::Interpretation& interpretation, std::int64_t budget) {
  if (!interpretation.planned) {
    ContingentAnswer answer = PlanFor(interpretation.task, contingent::Wanted::kFirst, budget);
    answer.unserved = interpretation.unserved;
    return answer;
  }
  ContingentAnswer answer{.task = interpretation.task, .plan = {}};
  answer.plan.outcome = interpretation.planned->assembly.outcome;
  answer.plan.tree = interpretation.planned->assembly.tree;
  return answer;
}

TreeWorlds::TreeWorlds(const execution::KnowledgeScenario& scenario,
                       const contingent::PlanTree& tree, std::uint64_t seed, bool is_every_leaf)
    : scenario_(scenario),
      seed_(seed),
      leaves_(execution::LeavesOf(scenario.interpretation.task, tree, kMostLeaves)) {
  if (leaves_.size() == kMostLeaves) {
    throw UsageError(fmt::format("run: the tree has {} leaves or more", kMostLeaves));
  }
  if (is_every_leaf) FindReachable();
}

void TreeWorlds::FindReachable() {
  unreachable_.resize(leaves_.size());
  for (std::size_t i = 0; i < leaves_.size(); ++i) {
    RandomStream random(seed_, "reachable");
    const auto found = execution::FindWorld(leaves_[i], scenario_.interpretation,
                                            scenario_.scenario.problem, random);
    if (const auto* why = std::get_if<std::string>(&found)) {
      unreachable_[i] = *why;
    } else {
      reachable_.push_back(i);
    }
  }
  if (reachable_.empty()) {
    throw UsageError(
        fmt::format("run: no hidden world leads to a leaf of the tree: {}", unreachable_.front()));
  }
}

execution::HiddenWorld TreeWorlds::WorldOf(int number) const {
  RandomStream random(seed_, fmt::format("hidden world {}", number));
  if (reachable_.empty()) {
    return execution::DrawnWorld(scenario_.interpretation.hidden,
                                 scenario_.interpretation.WorldCount(), random);
  }
  const std::size_t leaf = reachable_[static_cast<std::size_t>(number - 1) % reachable_.size()];
  return execution::WorldFor(leaves_[leaf], scenario_.interpretation, scenario_.scenario.problem,
                             random)
      .value();
}

}  // namespace assay::cli
