#pragma once

#include <deque>
#include <functional>
#include <optional>
#include <vector>

#include "planner/uncertainty/preconditions/certify.h"

namespace assay::uncertainty {

using MomentId = Id<struct MomentTag>;

// The knowledge after each sequence of actions from the beginning of a problem, and the goals that
// are not proved on the way. Each result is computed when it is asked for, and only once: plan
// instances share their first actions, and so do instances that differ in one remedy.
class WorldTree {
 public:
  // The problem must outlive the tree. `learn` adds what is observed at the beginning and after
  // each action, without any action of the plan. An empty `learn` adds nothing.
  WorldTree(const domain::Problem& problem, Propagation propagation,
            const algebra::BoundRequest& request, std::function<void(UncertainWorld&)> learn = {});

  MomentId Beginning() const { return MomentId(0); }
  // Returns the snapshot after one more action. `strategy` is null if no strategy executes the
  // action.
  MomentId After(MomentId before, const plan::Action& action, const plan::Strategy* strategy);

  const UncertainWorld& WorldAt(MomentId moment);
  // Returns the unproved preconditions of the action that leads to a snapshot. All of them are
  // found at once, since a caller that asks whether any precondition is unproved mostly asks for
  // the list next.
  const std::vector<Unproved>& UnprovedAt(MomentId moment);
  bool IsProved(MomentId moment) { return UnprovedAt(moment).empty(); }
  // Returns one of the preconditions of UnprovedAt, with the bound that the action's certificate
  // states.
  Unproved Told(MomentId moment, const Unproved& unproved);

  // Returns the number of snapshots that were asked for.
  int size() const { return static_cast<int>(moments_.size()); }

 private:
  struct Moment {
    MomentId before = MomentId::None();
    plan::Action action = {};
    std::optional<plan::Strategy> strategy = {};
    std::vector<MomentId> next = {};
    std::optional<UncertainWorld> world = {};
    std::optional<std::vector<Unproved>> unproved = {};

    const plan::Strategy* way() const { return strategy ? &*strategy : nullptr; }
  };

  Moment& At(MomentId moment) { return moments_[moment.index()]; }
  void Keep(Moment& moment, UncertainWorld world);

  algebra::BoundRequest request_;
  std::function<void(UncertainWorld&)> learn_;
  std::deque<Moment> moments_;  // starts with the beginning of the problem
};

}  // namespace assay::uncertainty
