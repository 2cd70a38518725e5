#include "sim/film/captions.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>

#include "planner/base/check.h"

namespace assay::film {
namespace {

// Returns the steps of the plan in the order of execution.
std::vector<Walked> StepsOf(const Subject& subject) {
  const auto ends = subject.trace.All<execution::StepEnd>();
  std::vector<Walked> steps;
  for (const plan::StepId id : subject.plan.ExecutionOrder()) {
    const std::size_t i = steps.size();
    steps.push_back({plan::ShortText(subject.problem, subject.plan.step(id).action),
                     i < ends.size() ? std::optional(ends[i]->snapshot.time) : std::nullopt});
  }
  return steps;
}

}  // namespace

std::vector<Caption> CaptionsOf(const Subject& subject) {
  std::vector<Caption> captions;
  std::optional<double> from = 0;
  int number = 0;
  for (const Walked& step : subject.walked ? *subject.walked : StepsOf(subject)) {
    if (!from) break;
    const std::string text = fmt::format("{} {}", ++number, step.action);
    if (!captions.empty() && captions.back().from == *from) {
      captions.back().text += ", " + text;
    } else {
      captions.push_back({*from, text});
    }
    from = step.end;
  }
  captions.push_back({from.value_or(subject.trace.end().snapshot.time), subject.end});
  return captions;
}

const std::string& TextAt(const std::vector<Caption>& captions, double time) {
  const auto next = std::ranges::upper_bound(captions, time, {}, &Caption::from);
  ASSAY_CHECK(next != captions.begin(), "no caption at {} s", time);
  return std::prev(next)->text;
}

}  // namespace assay::film
