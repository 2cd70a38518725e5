#pragma once

#include "planner/domain/problem/problem.h"
#include "planner/finemotion/contact_graph/critical_points.h"
#include "planner/finemotion/strategy_search/strategy_search.h"
#include "planner/plan/data/strategy.h"

namespace assay::finemotion {

// Returns the outer surface of the union of the part's boxes.
Polyhedron OutsideOf(const domain::PartModel& model);

// A mating as fine motion sees it. The tip is a frame at the front end of that mating feature of
// the held part (Mating::features) which is farthest ahead: in the middle of the end of a shaft, or
// in the middle of the mouth of a hole. In the mated pose, its axes are the axes of the fixed part.
struct MatingGeometry {
  Pose X_HeldTip = Pose::Identity();
  // The moving part about its tip, the fixed part, and the critical points between them. Both parts
  // have the clearance of the problem. A further critical point at the seat, where the part lands,
  // is left out. If the problem tolerates errors of the clearance, each wall may be displaced by
  // that error.
  Passage passage;
  Eigen::VectorXd tolerances;                  // half widths of the passage's tolerances, metres
  Pose X_FixedSeat = Pose::Identity();         // the tip's pose at the end
  std::vector<CriticalPoint> critical_points;  // critical points of the parts without clearance
};
MatingGeometry GeometryOf(const domain::Problem& problem, const domain::Mating& mating);

// Returns the errors for which a strategy with this certificate must be certain.
FineMotionErrors ErrorsOf(const plan::StrategyCertificate& certificate,
                          const MatingGeometry& geometry);

// Returns the plan for hybrid control: the plan's motions, followed by the slide to the seat in the
// crevice between the walls. `options` are the options of the search that found the plan.
plan::Strategy StrategyOf(const MatingGeometry& geometry, const FineMotionPlan& plan,
                          const StrategyOptions& options = {});

}  // namespace assay::finemotion
