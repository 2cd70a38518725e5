#include "planner/constraint_posting/geometric_relations.h"

#include "planner/domain/actions/condition.h"
#include "planner/domain/reachability/reachability.h"

namespace assay::constraint_posting {

using domain::GraspId;
using domain::MatingId;
using domain::Part;
using domain::PartId;
using domain::StablePoseId;
using network::Relation;

GeometricRelations::GeometricRelations(const domain::Problem& problem)
    : problem_(problem),
      reachability_(problem),
      reachable_(problem.parts.size()),
      mate_reachable_(problem.matings.size()) {}

std::shared_ptr<const Relation> GeometricRelations::Reachable(PartId id) const {
  auto& relation = reachable_[id.index()];
  if (relation) return relation;
  const Part& part = problem_.part(id);
  relation = Relation::Where(
      domain::GraspLabelCount(part), domain::PositionLabelCount(part), [&](int g, int position) {
        return position == domain::InitialLabel(part)
                   ? reachability_.IsReachableAt(id, GraspId(g), part.X_WorldPart)
                   : IsReachableIn(problem_, id, GraspId(g), StablePoseId(position));
      });
  return relation;
}

std::shared_ptr<const Relation> GeometricRelations::MateReachable(MatingId id) const {
  auto& relation = mate_reachable_[id.index()];
  if (relation) return relation;
  const Part& held = problem_.part(problem_.mating(id).held);
  const Part& fixed = problem_.part(problem_.mating(id).fixed);
  relation = Relation::Where(
      domain::GraspLabelCount(held), domain::PositionLabelCount(fixed), [&](int g, int position) {
        return position == domain::InitialLabel(fixed)
                   ? reachability_.IsMateReachableAt(id, GraspId(g), fixed.X_WorldPart)
                   : reachability_.IsMateReachableIn(id, GraspId(g), StablePoseId(position));
      });
  return relation;
}

}  // namespace assay::constraint_posting
