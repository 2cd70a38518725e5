#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "planner/constraint_posting/uncertainty_phase/shortfall.h"
#include "planner/uncertainty/error_sets/world_tree.h"

namespace assay::constraint_posting {

// The worlds of a plan instance with the best possible knowledge. Between any two actions, all
// quantities that remedies can measure or set are known: x, y and theta of every resting part, by
// squeezing or sensing, and z if an available sensor measures it. Whatever remedies are inserted,
// these worlds are among the worlds that remain possible. If a goal is unproved in these worlds,
// only a remedy that absorbs the goal can help.
class BestKnown {
 public:
  // Returns true if these worlds bound all remedies. They do not bound all remedies if the bounds
  // of an error exclude 0, or if errors of different actions may cancel (paper propagation).
  static bool Bounds(const domain::Problem& problem, uncertainty::Propagation propagation);

  // The problem must outlive the object.
  BestKnown(const domain::Problem& problem, uncertainty::Propagation propagation,
            const algebra::BoundRequest& bound);

  uncertainty::SnapshotId Beginning() const { return worlds_.Beginning(); }
  uncertainty::SnapshotId After(uncertainty::SnapshotId before, const plan::Action& action,
                                const plan::Strategy* strategy);

  const uncertainty::UncertainWorld& WorldAt(uncertainty::SnapshotId snapshot) {
    return worlds_.WorldAt(snapshot);
  }
  // the number of snapshots that were computed
  std::int64_t snapshots() const { return worlds_.size(); }

  // Returns the unproved goals of the action that leads to the snapshot, without `absorbable`
  // conditions.
  std::vector<uncertainty::Unproved> UnprovedAt(uncertainty::SnapshotId after,
                                                const std::vector<plan::Condition>& absorbable);
  // Returns a lower bound on the shortfall with any remedies.
  Shortfall LeastShortfall(uncertainty::SnapshotId after,
                           const std::vector<plan::Condition>& absorbable);

 private:
  // Returns the first equal snapshot. If the hand is empty and everything is known, two snapshots
  // in which all parts have the same poses are equal, whatever was done before.
  uncertainty::SnapshotId FirstAlike(uncertainty::SnapshotId snapshot);
  uncertainty::SnapshotId FindAlike(uncertainty::SnapshotId snapshot);

  const domain::Problem& problem_;
  uncertainty::WorldTree worlds_;
  // pairwise different snapshots with an empty hand
  std::vector<uncertainty::SnapshotId> with_empty_hand_;
  std::map<uncertainty::SnapshotId, uncertainty::SnapshotId> first_alike_;
};

}  // namespace assay::constraint_posting
