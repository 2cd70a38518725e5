#pragma once

#include <memory>
#include <vector>

#include "planner/domain/reachability/known_reachability.h"
#include "planner/network/constraint_network/relation.h"

namespace assay::constraint_posting {

// The pairs of labels that the geometric constraints allow: the semantic part of the constraint
// network (Spar, "Reachability of Grasps"). A relation depends on the part or on the mating alone,
// not on the plan variables between which it is posted. So each relation is computed once for a
// problem.
class GeometricRelations {
 public:
  explicit GeometricRelations(const domain::Problem& problem);

  // Returns reachable(Grasp, Position). Rows are the grasps of the part, columns its position
  // labels.
  std::shared_ptr<const network::Relation> Reachable(domain::PartId part) const;
  // Returns mate_reachable(Grasp, Position, Ta). Rows are the grasps of the held part, columns the
  // position labels of the fixed part.
  std::shared_ptr<const network::Relation> MateReachable(domain::MatingId mating) const;

  // Returns the same tests for single places.
  domain::KnownReachability& reachability() const { return reachability_; }

 private:
  const domain::Problem& problem_;
  mutable domain::KnownReachability reachability_;
  mutable std::vector<std::shared_ptr<const network::Relation>> reachable_;
  mutable std::vector<std::shared_ptr<const network::Relation>> mate_reachable_;
};

}  // namespace assay::constraint_posting
