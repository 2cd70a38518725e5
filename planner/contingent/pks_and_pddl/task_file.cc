#include "planner/contingent/pks_and_pddl/task_file.h"

#include <fmt/format.h>

#include "planner/contingent/pks_and_pddl/pddl_file.h"
#include "planner/contingent/pks_and_pddl/pks_file.h"

namespace assay::contingent {
namespace {

Language LanguageOf(const std::filesystem::path& domain) {
  if (domain.extension() == ".pddl") return Language::kPddl;
  if (domain.extension() == ".pks") return Language::kPks;
  throw InputError({domain.string()},
                   fmt::format("unknown ending '{}'", domain.extension().string()),
                   ".pks and .pddl");
}

}  // namespace

Task ReadTask(Language language, const NamedText& domain, const NamedText& problem) {
  Task task;
  if (language == Language::kPddl) {
    task.domain = ReadPddlDomain(domain.text, domain.name);
    task.problem = ReadPddlProblem(problem.text, problem.name, task.domain);
    return task;
  }
  task.domain = ReadPksDomain(domain.text, domain.name);
  task.problem = ReadPksProblem(problem.text, problem.name);
  if (task.problem.domain != task.domain.name) {
    const Place place = task.problem.domain_place;
    throw InputError({problem.name, place.line, place.column},
                     fmt::format("a problem of '{}'", task.problem.domain),
                     fmt::format("problems of '{}'", task.domain.name));
  }
  return task;
}

Task LoadTask(const std::filesystem::path& domain, const std::filesystem::path& problem) {
  const Language language = LanguageOf(domain);
  return ReadTask(language, {TextOfFile(domain), domain.string()},
                  {TextOfFile(problem), problem.string()});
}

}  // namespace assay::contingent
