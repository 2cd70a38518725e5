#include "planner/constraint_posting/uncertainty_phase/augmentation/instance_judge.h"

#include <algorithm>
#include <utility>

#include "planner/constraint_posting/step_geometry.h"

namespace assay::constraint_posting {

bool Allowance::Covers(const domain::Problem& problem, std::span<const plan::Action> actions,
                       const std::vector<Objection>& objections) const {
  const auto may_fail = [&](const Objection& objection) {
    const Subject subject = SubjectOf(problem, actions[objection.action]);
    return objection.place || std::ranges::count(anywhere, subject) > 0;
  };
  return std::ssize(objections) <= errors &&
         std::ranges::count_if(objections, &Objection::place) <= by_place &&
         std::ranges::all_of(objections, may_fail);
}

InstanceJudge::InstanceJudge(UncertaintyTask& task, Allowance allowance, IfUnproved if_unproved)
    : task_(task), allowance_(std::move(allowance)), if_unproved_(if_unproved) {
  beginnings_.push_back({.augmentation = Augmentation(task, kMostSteps)});
}

Judgement InstanceJudge::operator()(std::span<const plan::Action> actions) {
  const std::int64_t snapshots = task_.snapshots();
  way_.resize(actions.size());
  way_.push_back(After(way_.back(), actions));
  const Beginning& judged = beginnings_[way_.back()];
  return {.objections = judged.augmentation ? std::vector<Objection>{} : judged.objections,
          .snapshots = 1 + task_.snapshots() - snapshots};
}

std::size_t InstanceJudge::After(std::size_t before, std::span<const plan::Action> actions) {
  for (const std::size_t known : beginnings_[before].longer) {
    if (beginnings_[known].last == actions.back()) return known;
  }
  beginnings_[before].longer.push_back(beginnings_.size());
  beginnings_.push_back(Judged(beginnings_[before], actions));
  return beginnings_.size() - 1;
}

InstanceJudge::Beginning InstanceJudge::Judged(const Beginning& before,
                                               std::span<const plan::Action> actions) const {
  Beginning longer = {actions.back(), before.augmentation, before.objections};
  Augmentation& augmentation = *longer.augmentation;
  if (!augmentation.Add(plan::StepId(actions.size() - 1), actions.back(), if_unproved_)) {
    longer.objections.push_back(augmentation.ObjectionToLast());
  }
  if (!allowance_.Covers(task_.problem, actions, longer.objections)) longer.augmentation.reset();
  return longer;
}

}  // namespace assay::constraint_posting
