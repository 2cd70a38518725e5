#pragma once

#include <fstream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "planner/base/check.h"
#include "planner/contingent/search/contingent_planner.h"
#include "sim/execution/interpretation/interpretation.h"
#include "sim/execution/interpretation/knowledge_scenario.h"
#include "tests/scratch_file.h"

namespace assay::execution {

inline const std::filesystem::path kRoot = ASSAY_SOURCE_DIR;

using Replacements = std::vector<std::pair<std::string, std::string>>;

// Returns the text of a scenario with two cans. It has absolute paths and a longer timestep. In
// each pair of `replacements`, the first text is replaced by the second one.
inline std::string TwoCansText(const Replacements& replacements = {},
                               const std::string& scenario = "two-cans") {
  std::ostringstream text;
  text << std::ifstream(kRoot / "scenarios" / (scenario + ".yaml")).rdbuf();
  std::string changed = text.str();
  Replacements all = {{"know/force-sensing", kRoot / "scenarios/know/force-sensing"},
                      {"know/two-cans", kRoot / "scenarios/know/two-cans"},
                      {"simulation: {", "simulation: {timestep: 0.001, "}};
  all.insert(all.end(), replacements.begin(), replacements.end());
  for (const auto& [from, to] : all) {
    const std::size_t at = changed.find(from);
    ASSAY_CHECK(at != std::string::npos, "'{}' is not in the scenario", from);
    changed.replace(at, from.size(), to);
  }
  return changed;
}

inline KnowledgeScenario TwoCans(const Replacements& replacements = {},
                                 const std::string& scenario = "two-cans") {
  const std::filesystem::path file = ScratchFile(scenario + ".yaml");
  std::ofstream(file) << TwoCansText(replacements, scenario);
  return Load(file, kRoot / "models");
}

// Returns the replacement of the scenario's problem file by a file with this text.
inline Replacements WithProblem(const std::string& text) {
  const std::filesystem::path file = ScratchFile("problem.pks");
  std::ofstream(file) << text;
  return {{kRoot / "scenarios/know/two-cans.pks", file}};
}

// Returns the replacement of the problem file by a file with further changes in its `init`.
inline Replacements WithInit(const std::string& changes) {
  std::ostringstream text;
  text << std::ifstream(kRoot / "scenarios/know/two-cans.pks").rdbuf();
  std::string problem = text.str();
  const std::size_t init = problem.find("init:");
  ASSAY_CHECK(init != std::string::npos);
  return WithProblem(problem.insert(init + 5, " " + changes + ","));
}

// Returns the replacement of the problem file by one with another goal.
inline Replacements WithGoal(const std::string& goal) {
  std::ostringstream text;
  text << std::ifstream(kRoot / "scenarios/know/two-cans.pks").rdbuf();
  const std::string problem = text.str();
  const std::size_t at = problem.find("goal:");
  ASSAY_CHECK(at != std::string::npos);
  return WithProblem(problem.substr(0, at) + "goal: " + goal + "\n");
}

inline contingent::PlanTree TreeOf(const KnowledgeScenario& scenario) {
  Budget budget(100'000);
  return MakePlan(scenario.interpretation.task, contingent::Wanted::kFirst, budget).tree;
}

}  // namespace assay::execution
