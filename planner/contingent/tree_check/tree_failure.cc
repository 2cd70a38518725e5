#include "planner/contingent/tree_check/tree_failure.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace assay::contingent {
namespace {

std::string NumberText(const Number& number) {
  if (number.beside == 0) return fmt::format("= {}", number.value);
  return fmt::format("just {} {}", number.beside < 0 ? "below" : "above", number.value);
}

}  // namespace

bool TreeFailure::HasHappened() const {
  return !failure_.empty() || progression_.HasMadeTooMany() || progression_.CouldNotTell() ||
         progression_.IsRestless();
}

std::string TreeFailure::Text() const {
  if (!failure_.empty()) return failure_;
  if (progression_.HasMadeTooMany()) {
    return fmt::format("more than {} worlds on one way", most_worlds_);
  }
  if (progression_.IsRestless()) {
    return fmt::format("the update rules still change knowledge after {} rounds",
                       MostRoundsOf(task_));
  }
  if (!progression_.CouldNotTell()) return "";
  return fmt::format("an effect requires that something is unknown; {} cannot decide this",
                     were_drawn_ ? "worlds that are drawn" : "a sample of numbers");
}

void TreeFailure::Fail(const std::string& what, const History& history, const World* world) {
  if (HasHappened()) return;
  failure_ = fmt::format("{} after {}", what,
                         steps_.empty() ? "no step" : fmt::format("{}", fmt::join(steps_, "; ")));
  if (world == nullptr && !history.worlds.empty()) world = &history.worlds.front();
  if (world != nullptr) failure_ += fmt::format(", in the world with {}", TextOf(*world));
}

void TreeFailure::FailIfTwoValued(const History& history) {
  const FunctionId function = progression_.TwoValued();
  if (function.IsNone()) return;
  Fail(fmt::format("{} gets two values at once", task_.functions[function.index()].text), history);
}

std::string TreeFailure::TextOf(const World& world) const {
  std::vector<std::string> texts;
  for (std::size_t a = 0; a < task_.atoms.size(); ++a) {
    if (world.atoms[a] == Truth::kTrue) texts.push_back(task_.atoms[a]);
  }
  for (std::size_t slot = 0; slot < world.numbers.size(); ++slot) {
    const FunctionId function = task_.function_of_slot[slot];
    texts.push_back(fmt::format("{} {}", task_.functions[function.index()].text,
                                NumberText(world.numbers[slot])));
  }
  return fmt::format("{}", fmt::join(texts, ", "));
}

}  // namespace assay::contingent
