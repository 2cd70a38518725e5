#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "planner/plan/data/plan.h"
#include "planner/posting/objection.h"
#include "planner/posting/uncertainty_phase/instances/augmentation.h"
#include "planner/posting/uncertainty_phase/subject.h"

namespace assay::posting {

// Steps of an instance that need not be proved.
struct Allowance {
  std::int64_t errors = 0;
  std::int64_t by_place = 0;           // of these, that fail because of where parts are
  std::vector<Subject> anywhere = {};  // of the others

  bool Covers(const domain::Problem& problem, std::span<const plan::Action> actions,
              const std::vector<Objection>& objections) const;
};

// Objects to instances as soon as more of their steps than are allowed cannot be proved. A search
// comes back to how instances begin, whatever partial plan they are of: each beginning is judged
// once.
class InstanceJudge {
 public:
  // The task must outlive it.
  InstanceJudge(UncertaintyTask& task, Allowance allowance, IfUnproved if_unproved);

  // As a Judge is asked (objection.h).
  Judgement operator()(std::span<const plan::Action> actions);

 private:
  // The first actions of instances, as they were judged.
  struct Beginning {
    plan::Action last = {};
    std::optional<Augmentation> augmentation = {};  // none: there are too many objections
    std::vector<Objection> objections = {};         // to steps that fail
    std::vector<std::size_t> longer = {};           // those by one action
  };

  std::size_t After(std::size_t before, std::span<const plan::Action> actions);
  Beginning Judged(const Beginning& before, std::span<const plan::Action> actions) const;

  UncertaintyTask& task_;
  Allowance allowance_;
  IfUnproved if_unproved_;
  std::deque<Beginning> beginnings_;    // without any action first
  std::vector<std::size_t> way_ = {0};  // to what was judged last, by how many actions
};

}  // namespace assay::posting
