#include "sim/film/captions.h"

#include <fmt/format.h>

#include <algorithm>

#include "planner/base/check.h"

namespace assay::film {
namespace {

std::string EndText(const execution::ExecutionEnd& end) {
  if (end.outcome == execution::TrialOutcome::kSucceeded) return "done";
  return fmt::format("{}: {}", execution::NameOfEnd(end.outcome), end.reason);
}

}  // namespace

std::vector<Caption> CaptionsOf(const Subject& subject) {
  const std::vector<plan::StepId> order = subject.plan.ExecutionOrder();
  const auto ends = subject.trace.All<execution::StepEnd>();
  std::vector<Caption> captions;
  double from = 0;
  for (std::size_t i = 0; i < order.size() && i <= ends.size(); ++i) {
    captions.push_back(
        {from, fmt::format("{} {}", i + 1,
                           plan::ShortText(subject.problem, subject.plan.step(order[i]).action))});
    if (i < ends.size()) from = ends[i]->snapshot.time;
  }
  const execution::ExecutionEnd& end = subject.trace.end();
  const bool all_ended = ends.size() >= order.size();
  captions.push_back({all_ended ? from : end.snapshot.time, EndText(end)});
  return captions;
}

const std::string& TextAt(const std::vector<Caption>& captions, double time) {
  const auto next = std::ranges::upper_bound(captions, time, {}, &Caption::from);
  ASSAY_CHECK(next != captions.begin(), "no caption at {} s", time);
  return std::prev(next)->text;
}

}  // namespace assay::film
