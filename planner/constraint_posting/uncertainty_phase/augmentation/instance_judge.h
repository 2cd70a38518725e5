#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "planner/constraint_posting/objection.h"
#include "planner/constraint_posting/uncertainty_phase/augmentation/augmentation.h"
#include "planner/constraint_posting/uncertainty_phase/subject.h"
#include "planner/plan/data/plan.h"

namespace assay::constraint_posting {

// The steps of an instance that need not be proved.
struct Allowance {
  std::int64_t errors = 0;
  // the number of these errors that may depend on the places of parts
  std::int64_t by_place = 0;
  std::vector<Subject> anywhere = {};  // the subjects of the steps that may fail wherever parts are

  bool Covers(const domain::Problem& problem, std::span<const plan::Action> actions,
              const std::vector<Objection>& objections) const;
};

// Objects to an instance as soon as it has more unproved steps than are allowed. Instances often
// have the same first actions, also in different partial plans. Each sequence of first actions is
// judged only once.
class InstanceJudge {
 public:
  // The task must outlive the judge.
  InstanceJudge(UncertaintyTask& task, Allowance allowance, IfUnproved if_unproved);

  // Judges the actions as described at Judge (objection.h).
  Judgement operator()(std::span<const plan::Action> actions);

 private:
  // A sequence of actions with which instances may begin, and the judgement on it. The sequence is
  // that of a shorter beginning, followed by `last`.
  struct Beginning {
    plan::Action last = {};
    std::optional<Augmentation> augmentation = {};  // none if there are too many objections
    std::vector<Objection> objections = {};         // objections to steps that fail
    std::vector<std::size_t> longer = {};           // the beginnings with one more action
  };

  std::size_t After(std::size_t before, std::span<const plan::Action> actions);
  Beginning Judged(const Beginning& before, std::span<const plan::Action> actions) const;

  UncertaintyTask& task_;
  Allowance allowance_;
  IfUnproved if_unproved_;
  std::deque<Beginning> beginnings_;  // the empty beginning first
  // indexed by number of actions: the beginnings from the empty one to the last judged one
  std::vector<std::size_t> way_ = {0};
};

}  // namespace assay::constraint_posting
