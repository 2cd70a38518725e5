#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "planner/domain/problem/problem.h"
#include "planner/network/constraint_network/relation.h"

namespace assay::constraint_posting {

// The geometry of a problem as sets of labels, separately for each part and each mating.
struct LabelGeometry {
  // Indexed by part: reachable(grasp, position), the positions in which the part may start, and
  // whether it can be taken from there. Mated parts cannot be taken.
  std::vector<std::shared_ptr<const network::Relation>> reachable;
  std::vector<std::vector<int>> start;
  std::vector<bool> movable;
  // Indexed by part: the positions in which the goals want the part to end; empty if any position
  // will do.
  std::vector<std::vector<int>> located;
  // Indexed by mating: mate_reachable(grasp, position), GraspList and PositionList.
  std::vector<std::shared_ptr<const network::Relation>> mate_reachable;
  std::vector<std::vector<int>> grasp_list;
  std::vector<std::vector<int>> position_list;
};

// Returns a lower bound on the number of actions of this planner's plans. Returns none if the
// planner can find no plan. That does not prove that no plan exists, because the bound ignores some
// actions that a plan could do with mated parts (impossibility.h).
//
// A part gets from one position to the next only by a grasp that is reachable in both. So its
// motions are paths of a graph over positions, its regrasp graph (Tournassoud, Lozano-Perez and
// Mazer 1987). Other parts cannot shorten these paths. A part into which another part is mated
// stays where it is, so it ends in a position that all its goals allow. The bound is the sum of the
// shortest paths.
std::optional<int> LeastActions(const domain::Problem& problem, const LabelGeometry& geometry);

// Returns the positions that a located goal allows. The start position is among them if the part
// rests in an allowed stable pose there.
std::vector<int> LocatedLabels(const domain::Problem& problem, const domain::LocatedGoal& goal);

}  // namespace assay::constraint_posting
