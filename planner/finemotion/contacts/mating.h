#pragma once

#include "planner/domain/problem/problem.h"
#include "planner/finemotion/graph/critical_points.h"
#include "planner/finemotion/search/strategy_search.h"
#include "planner/plan/data/strategy.h"

namespace assay::finemotion {

// What a part's boxes are outside.
Polyhedron OutsideOf(const domain::PartModel& model);

// A mating as fine motion sees it. The tip is the frame in the middle of the held feature that goes
// in first (Mating::features), with the fixed part's axes when it is mated.
struct MatingGeometry {
  Pose X_HeldTip = Pose::Identity();
  // The moving part about its tip, with clearance; not where it only lands. If the problem
  // tolerates errors of the clearance, each wall may be displaced by so much.
  Passage passage;
  Eigen::VectorXd tolerances;                  // half widths of the passage's, metres
  Pose X_FixedSeat = Pose::Identity();         // of the tip, at the end
  std::vector<CriticalPoint> critical_points;  // of the parts without clearance
};
MatingGeometry GeometryOf(const domain::Problem& problem, const domain::Mating& mating);

// What a strategy with this certificate is to be certain for.
FineMotionErrors ErrorsOf(const plan::StrategyCertificate& certificate,
                          const MatingGeometry& geometry);

// The plan for hybrid control: its motions, then the way on to the seat in the crevice between the
// walls. `options`: with which it was searched for.
plan::Strategy StrategyOf(const MatingGeometry& geometry, const FineMotionPlan& plan,
                          const StrategyOptions& options = {});

}  // namespace assay::finemotion
