#pragma once

#include <deque>
#include <functional>
#include <optional>
#include <vector>

#include "planner/uncertainty/preconditions/certify.h"

namespace assay::uncertainty {

using SnapshotId = Id<struct SnapshotTag>;

// The knowledge after each sequence of actions from the beginning of a problem, and the goals that
// are not proved on the way. Each result is computed when it is asked for, and only once: plan
// instances share their first actions, even if the instances differ in one remedy.
class WorldTree {
 public:
  // The problem must outlive the tree. `learn` adds what is observed at the beginning and after
  // each action, without any action of the plan. An empty `learn` adds nothing.
  WorldTree(const domain::Problem& problem, Propagation propagation,
            const algebra::BoundRequest& request, std::function<void(UncertainWorld&)> learn = {});

  SnapshotId Beginning() const { return SnapshotId(0); }
  // Returns the snapshot after one more action. `strategy` is null if no strategy executes the
  // action.
  SnapshotId After(SnapshotId before, const plan::Action& action, const plan::Strategy* strategy);

  const UncertainWorld& WorldAt(SnapshotId snapshot);
  // Returns the unproved preconditions of the action that leads to a snapshot. All of them are
  // found at once, since a caller that asks whether any precondition is unproved mostly asks for
  // the list next.
  const std::vector<Unproved>& UnprovedAt(SnapshotId snapshot);
  bool IsProved(SnapshotId snapshot) { return UnprovedAt(snapshot).empty(); }
  // Returns one of the preconditions of UnprovedAt, with the bound that the action's certificate
  // states.
  Unproved Certified(SnapshotId snapshot, const Unproved& unproved);

  // Returns the number of snapshots that were asked for.
  int size() const { return static_cast<int>(snapshots_.size()); }

 private:
  struct Snapshot {
    SnapshotId before = SnapshotId::None();
    plan::Action action = {};
    std::optional<plan::Strategy> strategy = {};
    std::vector<SnapshotId> next = {};
    std::optional<UncertainWorld> world = {};
    std::optional<std::vector<Unproved>> unproved = {};

    const plan::Strategy* way() const { return strategy ? &*strategy : nullptr; }
  };

  Snapshot& At(SnapshotId snapshot) { return snapshots_[snapshot.index()]; }
  void Keep(Snapshot& snapshot, UncertainWorld world);

  algebra::BoundRequest request_;
  std::function<void(UncertainWorld&)> learn_;
  std::deque<Snapshot> snapshots_;  // starts with the beginning of the problem
};

}  // namespace assay::uncertainty
