#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "planner/base/outcome.h"
#include "planner/domain/matings/mating_errors.h"
#include "planner/finemotion/forces/friction_limit.h"
#include "planner/finemotion/strategy_search/maneuver.h"

namespace assay::finemotion {

// Half widths of the intervals that hold the unknown errors.
struct FineMotionErrors {
  // The errors of the tip's pose at the start, in metres and radians.
  Eigen::Matrix<double, kPoseDimensions, 1> pose;
  double velocity = domain::MatingErrors().velocity;  // velocity error as in SegmentModel
  Eigen::VectorXd tolerances = {};  // half widths of the passage's tolerances, metres
};

// Returns the errors with the errors of poses and tolerances multiplied by `multiple`. The velocity
// error is unchanged.
FineMotionErrors Enlarged(const FineMotionErrors& errors, double multiple);

struct StrategyOptions {
  // Weights of the three costs (Dakin and Popplestone, sections 2 and 4): the cost of a motion, the
  // likelihood that another contact than the planned one is made, and the similarity of the forces
  // of these two contacts.
  double transitions = 1;
  double deviation = 1;
  double confusion = 0.5;
  double friction = 0.2;  // the greatest coefficient of friction between the parts
  double reach = 0.012;   // metres within which contacts to move to are searched for
  double radius = 0.02;   // metres; a rotation times this radius counts as a length
  double tilt = 0.2;      // radians by which starts may be tilted
  double twist = 0.08;    // radians by which starts may be turned about the way in
  double offset = 0.006;  // metres by which starts may be beside the entry
  int rounds = 4;         // number of searches from other starts, until all errors are absorbed
  // Number of further, more diverse searches, if those do not absorb all errors. The distances of
  // their starts are in proportion to the size of the tip.
  int diverse_rounds = 8;
  int diverse_nodes = 400;  // number of nodes that one of them may expand for each critical point
  int starts = 100;         // number of starts that are drawn for one search
  int tries = 400;          // number of attempts at moving a start
  double greatest = 1.5;    // starts are moved until this multiple of the errors is absorbed
  int nodes = 200;          // number of nodes that one search may expand for each critical point
  // Nodes that a thorough search may expand for each critical point. The thorough search is made
  // when no other search finds a strategy, to learn whether there is one. With 0, neither the
  // thorough search nor the search for an obstacle is made.
  int thorough_nodes = 3000;
  // Number of errors that are drawn for exact replays from the whole box, and again from its
  // surface.
  int drawn = 32;
  MeetingTest test = MeetingTest::kExact;
  std::uint64_t seed = 1;
};

struct FineMotionPlan {
  // kFound: the plan absorbs all the errors. kNone: the search has examined all sequences that it
  // considers, from the starts that it has drawn, and found none. kBudget: there were more
  // sequences, or a thorough search was not wanted.
  Outcome outcome = Outcome::kBudget;
  Pose X_StationaryStart = Pose::Identity();  // the tip's pose at the start, in free space
  std::vector<Maneuver> maneuvers = {};
  std::vector<CertainMotion> motions = {};
  // The greatest multiple of the errors for which all motions are certain to first order and no
  // replay in exact geometry deviated, as far as the search has looked.
  double absorbed = 0;
  // Number of errors of that multiple that were replayed exactly, if a plan is found.
  int exact_replays = 0;
  // The least coefficient of friction with which its kept contacts could hold a motion.
  double friction_limit = kGreatestFriction;
  // The contact or loss that stands in the way if not all of the errors are absorbed. If a part of
  // the errors is absorbed, the obstacle is the first contact or loss that happens with slightly
  // greater errors; its scale is the multiple at which it happens. If nothing is absorbed, the
  // obstacle is what stopped the sequence that came nearest to the goal, at the least multiple that
  // was tried.
  std::optional<Unwanted> obstacle = {};
  int expanded = 0;  // number of expanded nodes
  int replayed = 0;  // number of sequences replayed from other starts
  // Comparison with the paper's edge test, if options.test asks for it.
  TestComparison comparison = {};

  bool found() const { return outcome == Outcome::kFound; }
};

MotionChecker CheckerFor(const Passage& passage, const FineMotionErrors& errors,
                         const StrategyOptions& options);

// Returns the believed pose at X_StationaryMoving, free of contact, with the errors multiplied by
// `multiple`.
BelievedPose BelievedPoseIn(const Pose& X_StationaryMoving, const FineMotionErrors& errors,
                            double multiple);

}  // namespace assay::finemotion
