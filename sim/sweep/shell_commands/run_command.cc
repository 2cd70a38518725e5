#include "sim/sweep/shell_commands/run_command.h"

#include <fmt/ranges.h>

#include "sim/sweep/shell_commands/shell.h"

namespace assay::sweep {

RunCommand RunCommand::Again(std::uint64_t seed_of_trials, std::optional<int> number) const {
  RunCommand again = *this;
  again.seed = seed_of_trials;
  again.trial = number;
  return again;
}

RunCommand RunCommand::OfPlan() const {
  return {.input = input,
          .scatter = scatter,
          .tree = tree,
          .propagation = propagation,
          .resolvers = resolvers,
          .error_scale = error_scale,
          .grasp = grasp,
          .models = models};
}

RunCommand RunCommand::WithErrors(const std::string& errors_of_trial) const {
  RunCommand with_errors = OfPlan();
  with_errors.errors = errors_of_trial;
  return with_errors;
}

std::string RunCommand::Text() const {
  const RunCommand usual;
  CommandLine line("run", input);
  line.AddFlag("--scatter", scatter);
  line.AddFlag("--tree", tree);
  line.AddUnless(usual.propagation, "--propagation", propagation);
  line.AddUnless(std::string(), "--resolvers", fmt::format("{}", fmt::join(resolvers, ",")));
  line.AddUnless(usual.error_scale, "--error-scale", error_scale);
  if (grasp) line.Add("--grasp", scene::Name(*grasp));
  line.AddModels(models);
  line.AddUnless(usual.worlds, "--worlds", worlds);
  line.AddUnless(usual.sensing_errors, "--sensing-errors", sensing_errors);
  line.AddIfGiven("--noise", noise);
  line.AddUnless(usual.sensing, "--sensing", sensing);
  line.AddIfGiven("--errors", errors);
  line.AddIfGiven("--seed", seed);
  line.AddIfGiven("--trial", trial);
  return line.text();
}

}  // namespace assay::sweep
