#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "planner/domain/problem/problem.h"
#include "planner/plan/data/plan.h"
#include "planner/uncertainty/preconditions/certify.h"

namespace assay::constraint_posting {

// A step of a plan instance, with those of its uncertainty-reduction goals that could not be
// proved.
struct UnmetGoals {
  const domain::Problem& problem;
  std::span<const plan::Action> actions;  // the instance's actions, in the order of execution
  int step = 0;                           // index in `actions` of the step that has the goals
  std::vector<uncertainty::Unproved> goals;
  // the parts whose errors occur in the goals, in increasing order
  std::vector<domain::PartId> parts = {};
  // For each action in `actions`: the fine motion strategy that executes it, if there is one. The
  // vector is empty if no action has a strategy.
  std::vector<std::optional<plan::Strategy>> strategies = {};
};

// An action to be executed right before actions[before].
struct Insertion {
  int before = 0;
  plan::Action action;
};

// One way to treat unmet goals, as far as one part is concerned. A remedy of the first kind inserts
// actions, whose own preconditions are proved like those of any other action. A remedy of the
// second kind is another way to execute the step. Certain conditions need not hold for it, because
// it absorbs the error (fine motion) or resolves it at run time (contingent plans). A strategy's
// assumptions about the errors are proved instead of these conditions.
struct Remedy {
  domain::PartId part;
  std::vector<Insertion> insertions = {};       // in the order of execution
  std::vector<plan::Condition> absorbs = {};    // conditions that the remedy makes unnecessary
  std::optional<plan::Strategy> strategy = {};  // the strategy that then executes the step
};

// A way to reduce uncertainty. The uncertainty phase uses resolvers only through this interface.
class Resolver {
 public:
  virtual ~Resolver() = default;

  virtual std::string_view name() const = 0;  // such as "sensing"
  // Returns true if the inserted actions may move parts. Actions that move no part are inserted
  // even if they prove nothing, as long as they bring a step nearer to a proof.
  virtual bool disturbs() const { return true; }
  // Returns the conditions that the remedies of this resolver may absorb. If other conditions of a
  // step fail even with all knowledge that remedies could give, no remedy can prove the step.
  virtual std::vector<plan::Condition> absorbs() const { return {}; }
  // Returns remedies that are worth trying, alone or together with remedies for other parts, best
  // first. The operational and geometric preconditions of their inserted actions hold. Their
  // uncertainty-reduction preconditions need not hold.
  virtual std::vector<Remedy> Propose(const UnmetGoals& unmet) = 0;
  // Returns the parts that would have to be elsewhere for more remedies to be possible.
  virtual std::vector<domain::PartId> Obstacles(const UnmetGoals&) const { return {}; }
};

}  // namespace assay::constraint_posting
