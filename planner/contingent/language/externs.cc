#include "planner/contingent/language/externs.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <exception>

namespace assay::contingent {

void Externs::AddFacts(const Problem& problem) {
  for (const Literal& fact : problem.extern_facts) {
    std::vector<std::string> arguments;
    for (const Term& term : fact.arguments) arguments.push_back(term.name);
    has_facts_[fact.predicate] = true;
    if (!procedures_.contains(fact.predicate)) answers_[fact.predicate][arguments] = true;
  }
}

bool Externs::Call(const std::string& name, const std::vector<std::string>& arguments,
                   const FilePlace& place) {
  std::map<std::vector<std::string>, bool>& answers = answers_[name];
  const auto found = answers.find(arguments);
  if (found != answers.end()) return found->second;
  return answers[arguments] = CallProcedure(name, arguments, place);
}

bool Externs::CallProcedure(const std::string& name, const std::vector<std::string>& arguments,
                            const FilePlace& place) const {
  const auto procedure = procedures_.find(name);
  if (procedure == procedures_.end()) {
    if (has_facts_.contains(name)) return false;
    throw InputError(place, fmt::format("extern '{}' has no procedure", name),
                     "externs that the program knows, or facts in the problem's externs:");
  }
  try {
    return procedure->second(arguments);
  } catch (const std::exception& error) {
    throw InputError(
        place, fmt::format("{}({}) failed: {}", name, fmt::join(arguments, ", "), error.what()),
        "");
  }
}

}  // namespace assay::contingent
