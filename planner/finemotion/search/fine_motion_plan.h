#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "planner/base/outcome.h"
#include "planner/domain/mating/mating_errors.h"
#include "planner/finemotion/replay/friction_limit.h"
#include "planner/finemotion/search/maneuver.h"

namespace assay::finemotion {

// Half widths of what is not known.
struct FineMotionErrors {
  Eigen::Matrix<double, kPoseDimensions, 1> pose;     // where the tip is at first: metres, radians
  double velocity = domain::MatingErrors().velocity;  // as SegmentModel
  Eigen::VectorXd tolerances = {};                    // of the passage's, metres
};

// Of poses and tolerances; velocities stay.
FineMotionErrors Enlarged(const FineMotionErrors& errors, double multiple);

struct StrategyOptions {
  // Weights of the three costs (Dakin and Popplestone, sections 2 and 4): of a motion, of how
  // likely another contact is, and of how alike its forces are.
  double transitions = 1;
  double deviation = 1;
  double confusion = 0.5;
  double friction = 0.2;  // of the parts, at most
  double reach = 0.012;   // metres that are looked ahead for contacts to come to
  double radius = 0.02;   // metres; what a radian comes to
  double tilt = 0.2;      // radians, that starts may be tilted by
  double twist = 0.08;    // radians, about the way in
  double offset = 0.006;  // metres, that they may be beside the entry
  int rounds = 4;         // searches from other starts, until all errors are absorbed
  int starts = 100;       // that are drawn for a search
  int tries = 400;        // at moving a start
  double greatest = 1.5;  // multiple of the errors that is worth being absorbed
  int nodes = 200;        // that a search may expand for each critical point
  // Likewise, where none of them finds anything: to know whether there is anything to be found. 0:
  // neither that is asked nor what is in the way.
  int thorough_nodes = 3000;
  int drawn = 32;  // errors that a plan is replayed with, from the box and from its surface
  MeetingTest test = MeetingTest::kExact;
  std::uint64_t seed = 1;
};

struct FineMotionPlan {
  // Found: with all the errors. None: the search has looked through all that it can think of, from
  // the starts that it has drawn. Budget: there was more, or it was not asked to.
  Outcome outcome = Outcome::kBudget;
  Pose X_StationaryStart = Pose::Identity();  // of the tip, in free space
  std::vector<Maneuver> maneuvers = {};
  std::vector<CertainMotion> motions = {};
  // The greatest multiple of the errors for which all motions are certain to first order, as far as
  // was looked, and with which no replay in exact geometry went otherwise.
  double absorbed = 0;
  int exact_replays = 0;  // of errors within that, if it is found
  // No motion can be held by less friction in what it keeps.
  double friction_limit = kGreatestFriction;
  // If all the errors are too much: what happens first with a little more than is absorbed, at its
  // multiple of the errors; if nothing is absorbed, what stands against the sequence that came
  // nearest to the goal with the least multiple that was tried.
  std::optional<Unwanted> obstacle = {};
  int expanded = 0;                // nodes
  int replayed = 0;                // sequences, from other starts
  TestComparison comparison = {};  // with the paper's edge test, if that was asked for

  bool found() const { return outcome == Outcome::kFound; }
};

MotionChecker CheckerFor(const Passage& passage, const FineMotionErrors& errors,
                         const StrategyOptions& options);

// What is believed where errors are so many times as great.
Belief BeliefIn(const Pose& X_StationaryMoving, const FineMotionErrors& errors, double multiple);

}  // namespace assay::finemotion
