#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "planner/domain/problem/problem.h"
#include "planner/network/network/relation.h"

namespace assay::posting {

// The geometry of a problem as sets of labels, each part and each mating by itself.
struct LabelGeometry {
  // By part: reachable(grasp, position), the positions that it may start in, whether it can be
  // taken from there (mated parts cannot), and those that the goals want it to end in.
  std::vector<std::shared_ptr<const network::Relation>> reachable;
  std::vector<std::vector<int>> start;
  std::vector<bool> movable;
  std::vector<std::vector<int>> located;  // empty: any
  // By mating: mate_reachable(grasp, position), GraspList and PositionList.
  std::vector<std::shared_ptr<const network::Relation>> mate_reachable;
  std::vector<std::vector<int>> grasp_list;
  std::vector<std::vector<int>> position_list;
};

// A lower bound on the number of actions of any of this planner's plans; nothing if it can find
// none. That is no proof that none exists: of parts that are mated it knows less than a plan could
// do with them (impossibility.h).
//
// A part gets from one position to the next only by a grasp that is reachable in both, so its ways
// are the paths of a graph over positions: its regrasp graph (Tournassoud, Lozano-Perez and Mazer
// 1987). What other parts do cannot shorten them. A part that something is mated with stays, so
// that it ends in a position that all its goals allow. The bound adds the shortest paths.
std::optional<int> LeastActions(const domain::Problem& problem, const LabelGeometry& geometry);

// The positions that a located goal allows; the one at the start if the part rests so there.
std::vector<int> LocatedLabels(const domain::Problem& problem, const domain::LocatedGoal& goal);

}  // namespace assay::posting
