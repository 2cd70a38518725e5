#include "planner/uncertainty/error_sets/world_tree.h"

#include <utility>

#include "planner/uncertainty/error_sets/tip_error.h"

namespace assay::uncertainty {
namespace {

bool IsSame(const Pose& a, const Pose& b) { return a.matrix() == b.matrix(); }

// Returns whether the two strategies are the same as far as errors are concerned: they absorb the
// same errors, and start and end in the same poses.
bool IsSame(const plan::Strategy* a, const plan::Strategy* b) {
  if (a == nullptr || b == nullptr) return a == b;
  const TipWay way = WayOf(*a);
  const TipWay other = WayOf(*b);
  return a->certificate.d == b->certificate.d && a->certificate.w == b->certificate.w &&
         IsSame(way.X_HeldTip, other.X_HeldTip) && IsSame(way.X_FixedStart, other.X_FixedStart) &&
         way.R_FixedEnd == other.R_FixedEnd;
}

}  // namespace

WorldTree::WorldTree(const domain::Problem& problem, Propagation propagation,
                     const algebra::BoundRequest& request,
                     std::function<void(UncertainWorld&)> learn)
    : request_(request), learn_(std::move(learn)) {
  snapshots_.emplace_back();
  Keep(snapshots_.front(), UncertainWorld(problem, propagation));
}

void WorldTree::Keep(Snapshot& snapshot, UncertainWorld world) {
  if (learn_) learn_(world);
  snapshot.world = std::move(world);
}

SnapshotId WorldTree::After(SnapshotId before, const plan::Action& action,
                            const plan::Strategy* strategy) {
  for (const SnapshotId known : At(before).next) {
    const Snapshot& snapshot = At(known);
    if (snapshot.action == action && IsSame(snapshot.way(), strategy)) {
      return known;
    }
  }
  const SnapshotId after(snapshots_.size());
  snapshots_.push_back({.before = before, .action = action});
  if (strategy != nullptr) At(after).strategy = *strategy;
  At(before).next.push_back(after);
  return after;
}

const UncertainWorld& WorldTree::WorldAt(SnapshotId id) {
  if (!At(id).world) {
    UncertainWorld world = WorldAt(At(id).before);
    Propagate(world, At(id).action, At(id).way());
    Keep(At(id), std::move(world));
  }
  return *At(id).world;
}

const std::vector<Unproved>& WorldTree::UnprovedAt(SnapshotId id) {
  if (!At(id).unproved) {
    UncertainWorld world = WorldAt(At(id).before);
    Snapshot& snapshot = At(id);
    snapshot.unproved =
        DecideStep(world, snapshot.action, request_, Wanted::kAllUnproved, snapshot.way());
    if (!snapshot.world) Keep(snapshot, std::move(world));
  }
  return *At(id).unproved;
}

Unproved WorldTree::Certified(SnapshotId snapshot, const Unproved& unproved) {
  return AsCertified(unproved, WorldAt(snapshot), request_);
}

}  // namespace assay::uncertainty
