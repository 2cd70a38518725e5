#include "planner/contingent/pks_and_pddl/task_file.h"

#include <fmt/format.h>

#include "planner/contingent/pks_and_pddl/pddl_file.h"
#include "planner/contingent/pks_and_pddl/pks_file.h"

namespace assay::contingent {

Task LoadTask(const std::filesystem::path& domain, const std::filesystem::path& problem) {
  Task task;
  if (domain.extension() == ".pddl") {
    task.domain = ReadPddlDomain(TextOfFile(domain), domain.string());
    task.problem = ReadPddlProblem(TextOfFile(problem), problem.string(), task.domain);
    return task;
  }
  if (domain.extension() != ".pks") {
    throw InputError({domain.string()},
                     fmt::format("unknown ending '{}'", domain.extension().string()),
                     ".pks and .pddl");
  }
  task.domain = ReadPksDomain(TextOfFile(domain), domain.string());
  task.problem = ReadPksProblem(TextOfFile(problem), problem.string());
  if (task.problem.domain != task.domain.name) {
    const Place place = task.problem.domain_place;
    throw InputError({problem.string(), place.line, place.column},
                     fmt::format("a problem of '{}'", task.problem.domain),
                     fmt::format("problems of '{}'", task.domain.name));
  }
  return task;
}

}  // namespace assay::contingent
