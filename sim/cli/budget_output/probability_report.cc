#include "sim/cli/budget_output/probability_report.h"

#include <fmt/format.h>

#include <algorithm>

#include "sim/cli/plan_output/table.h"

namespace assay::cli {
namespace {

using Json = nlohmann::ordered_json;

// The way home belongs to no step.
std::string NameOfStep(plan::StepId step, const plan::Plan& plan) {
  return step.IsNone() ? "home" : plan.step(step).name;
}

std::string AtLeastText(double probability) {
  return probability > 0 ? fmt::format("{:.3g}", probability) : "0";
}

// Rounds up, because the number is an upper bound.
std::string AtMostText(double probability) {
  return probability > 0 ? fmt::format("{:.3g}", std::min(1., 1.004 * probability)) : "0";
}

Json ToJson(const Interval& probability) {
  return {{"least", probability.low}, {"most", probability.high}};
}

}  // namespace

std::string Text(const probability::FailureProbabilities& failures, const plan::Plan& plan) {
  Table steps({{"step"}, {"at least", Align::kRight}, {"at most", Align::kRight}});
  const auto add = [&](const std::string& what, const Interval& probability) {
    steps.Add({what, AtLeastText(probability.low), AtMostText(probability.high)});
  };
  for (const plan::StepId id : plan.ExecutionOrder())
    add(plan.step(id).name, failures.steps[id.index()]);
  add("the whole plan", failures.plan);
  std::string text = fmt::format(
      "probability that a precondition fails, with the distributions of the scenario\n\n{}",
      steps.Text());
  if (failures.preconditions.empty()) return text;
  Table preconditions(
      {{"step"}, {"precondition"}, {"at least", Align::kRight}, {"at most", Align::kRight}});
  for (const probability::PreconditionFailure& failure : failures.preconditions) {
    preconditions.Add({NameOfStep(failure.step, plan), failure.meaning,
                       AtLeastText(failure.probability.low), AtMostText(failure.probability.high)});
  }
  return text + "\nwhat may fail\n\n" + preconditions.Text();
}

Json ToJson(const probability::FailureProbabilities& failures, const plan::Plan& plan) {
  Json json = {
      {"plan", ToJson(failures.plan)}, {"steps", Json::array()}, {"preconditions", Json::array()}};
  const auto with_bounds = [](Json entry, const Interval& probability) {
    entry.update(ToJson(probability));
    return entry;
  };
  for (const plan::StepId id : plan.ExecutionOrder()) {
    json["steps"].push_back(
        with_bounds({{"step", plan.step(id).name}}, failures.steps[id.index()]));
  }
  for (const probability::PreconditionFailure& failure : failures.preconditions) {
    json["preconditions"].push_back(
        with_bounds({{"step", NameOfStep(failure.step, plan)}, {"meaning", failure.meaning}},
                    failure.probability));
  }
  return json;
}

}  // namespace assay::cli
