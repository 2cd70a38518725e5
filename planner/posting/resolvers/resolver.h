#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "planner/domain/problem/problem.h"
#include "planner/plan/data/plan.h"
#include "planner/uncertainty/preconditions/certify.h"

namespace assay::posting {

// Uncertainty-reduction goals of one step of a plan instance that could not be proved.
struct UnmetGoals {
  const domain::Problem& problem;
  std::span<const plan::Action> actions;  // of the instance, in the order of execution
  int step = 0;                           // whose goals they are: index in `actions`
  std::vector<uncertainty::Unproved> goals;
  std::vector<domain::PartId> parts = {};  // whose errors occur in the goals, in increasing order
  // By which fine motion executes them; by index in `actions`. Empty: none has any.
  std::vector<std::optional<plan::Strategy>> strategies = {};
};

// An action to be executed right before actions[before].
struct Insertion {
  int before = 0;
  plan::Action action;
};

// One thing to do about unmet goals, as far as one part is concerned: actions to insert, whose own
// preconditions are then proved like any other's; or a way to execute the step that needs certain
// conditions no longer, because it absorbs the error itself (fine motion) or finds out at run time
// (contingent plans). What a strategy takes for granted of the errors is proved instead.
struct Remedy {
  domain::PartId part;
  std::vector<Insertion> insertions = {};       // in the order of execution
  std::vector<std::string> absorbs = {};        // conditions of the step (Precondition::condition)
  std::optional<plan::Strategy> strategy = {};  // by which the step is then executed
};

// A way to reduce uncertainty. The uncertainty phase knows nothing else of it.
class Resolver {
 public:
  virtual ~Resolver() = default;

  virtual std::string_view name() const = 0;  // "sensing"
  // Whether what it inserts may move parts. What does not is also inserted where it proves nothing
  // but brings a step nearer to being proved.
  virtual bool disturbs() const { return true; }
  // The conditions that its remedies may absorb. A step that fails in others even when all is known
  // that remedies could tell fails whatever is tried.
  virtual std::vector<std::string> absorbs() const { return {}; }
  // Remedies worth trying, alone or together with others for other parts, best first. Operational
  // and geometric preconditions of what they insert hold; uncertainty-reduction preconditions need
  // not.
  virtual std::vector<Remedy> Propose(const UnmetGoals& unmet) = 0;
  // Parts that would have to be elsewhere, so that there were more remedies to propose.
  virtual std::vector<domain::PartId> Obstacles(const UnmetGoals&) const { return {}; }
};

}  // namespace assay::posting
