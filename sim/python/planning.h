#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "sim/cli/tasks/planned_problem.h"
#include "sim/execution/interpretation/knowledge_scenario.h"
#include "sim/sweep/shell_commands/run_command.h"

namespace assay::python {

// What decides which plan is made for a scenario.
struct PlanSettings {
  std::filesystem::path scenario;
  std::vector<std::filesystem::path> models = {};          // more folders of models
  std::optional<double> clearance = {};                    // metres; none: the scenario's
  double error_scale = 1;                                  // factor on the errors of parts and hand
  std::optional<std::vector<std::string>> resolvers = {};  // none or empty: the scenario's
  std::string propagation = "sound";
  // The greatest number of partial plans in the first phase. If the goal is about knowledge, it is
  // the greatest number of knowledge states. If it is empty, the default is used.
  std::optional<std::int64_t> budget = {};
};

// Throws UsageError if a setting has no meaning.
void RequireSettings(const PlanSettings& settings);
// Reads the scenario file and applies the changes of the settings to it.
Document LoadScenario(const PlanSettings& settings);
domain::ModelPath ModelPathOf(const std::vector<std::filesystem::path>& folders);
execution::WorldPlanning WorldPlanningFrom(const PlanSettings& settings);

// A plan with the problem that it is for.
class PlanHandle {
 public:
  // Plans for a scenario whose plan is no tree. Throws Refused if there is no plan, and InputError
  // and UsageError as the program does.
  static std::shared_ptr<const PlanHandle> Make(const PlanSettings& settings);
  // Reads a plan file.
  static std::shared_ptr<const PlanHandle> Read(const std::filesystem::path& plan_file,
                                                const std::vector<std::filesystem::path>& models);
  // Returns the plan for one world of a plan tree. No command of the program makes such a plan by
  // itself.
  static std::shared_ptr<const PlanHandle> OfWorld(cli::PlannedProblem planned);

  const cli::PlannedProblem& planned() const { return planned_; }
  const plan::Plan& plan() const { return planned_.result.plan; }
  // The command that makes the same plan; none if the program has no options for it.
  const std::optional<sweep::RunCommand>& command() const { return command_; }

  nlohmann::ordered_json ToJson() const;  // plan.json
  std::string FileText() const;           // its text
  std::string Text() const;               // for people
  // Explains the step with this place in the order of execution, from 1.
  std::string Explanation(int executed) const;
  // Returns the cost of each variable to each precondition, in the order of execution.
  nlohmann::ordered_json Proofs() const;
  // Returns the errors that the plan can bear. `front` names the groups of a Pareto front, or
  // nothing.
  nlohmann::ordered_json Budget(const std::vector<std::string>& front) const;
  // Checks the plan, once.
  const plan::CheckReport& Checked() const;
  nlohmann::ordered_json CheckedToJson() const;  // with a text for people

 private:
  PlanHandle(cli::PlannedProblem planned, std::optional<sweep::RunCommand> command);

  const cli::PlannedProblem planned_;
  const std::optional<sweep::RunCommand> command_;
  mutable std::mutex mutex_;  // guards the report
  mutable std::optional<plan::CheckReport> report_;
};

// Returns what a scenario file says: names of parts, sensors, resolvers, clearance, and whether its
// plan is a tree.
nlohmann::ordered_json Described(const PlanSettings& settings);

}  // namespace assay::python
