#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "planner/posting/impossibility/relaxed_hand.h"

namespace assay::posting {

// A constraint of a problem that can be left out by itself.
struct Constraint {
  enum class Kind {
    kGraspCondition,    // index: in domain::kGraspConditions
    kGrasps,            // that a part has no grasps at all
    kStart,             // that a part starts where it does
    kInTheWay,          // that others keep clear of a part while it is where it starts
    kFeaturesOffPads,   // index: of a mating
    kFeaturesOffTable,  // likewise
    kFrictionCone,      // likewise
    kLocated            // index: of a goal
  };
  Kind kind;
  int index;

  bool operator==(const Constraint&) const = default;
};

// A hold that a robot has, or would have, of a part that rests or is mated.
struct HoldOption {
  int robot = 0;
  domain::PartId part;                                 // in the hand
  domain::MatingId mating = domain::MatingId::None();  // None: it is taken or put down
  int grasp = 0;
  int position = 0;  // label, of the part, or of the mating's fixed part

  bool operator==(const HoldOption&) const = default;
};

// What is left of a problem's constraints.
struct Relaxation {
  std::vector<Constraint> constraints;
  // This condition holds as well where it fails by less than `excess`, and for one hold more.
  struct Waiver {
    domain::GraspCondition condition;
    double excess = 0;  // metres or radians
    std::optional<HoldOption> also = {};
  };
  std::optional<Waiver> waiver = {};
  std::optional<int> robot = {};  // the only one that acts; none: all do
};

// What can at most come true.
struct Attainable {
  std::vector<std::vector<bool>> rests;              // by part, by position label
  std::vector<std::vector<std::vector<bool>>> held;  // by robot, by part, by grasp
  std::vector<bool> mated;                           // by mating
  PartSet moved;       // no longer, or not surely, where they were at the start
  PartSet unfollowed;  // with which everything is taken to be possible
};

// The delete relaxation of a problem (Bonet and Geffner 2001, section 4): what has come true once
// stays true, so that every part can be everywhere at once that it can get to at all. What no
// sequence of actions attains then, none attains in the problem itself. Each robot of the workcell
// acts. A part keeps the others from what it is in the way of until it can be moved.
//
// What the planner does not follow is taken to be possible, all of it: with parts that are mated or
// may have been (they can be carried together, and mated with others wherever they are), and with
// parts that start in none of their stable poses (they may fall).
class RelaxedProblem {
 public:
  enum class Grasps {
    kListed,     // the problem's
    kWithMisses  // those as well that are too wide for the gripper, or whose pads stick out
  };
  RelaxedProblem(const domain::Problem& problem, Grasps grasps);

  // All of them, from those that a person is least likely to change to those that are most easily
  // changed.
  std::vector<Constraint> Constraints() const;

  Attainable AttainableWith(const Relaxation& relaxation) const;
  // Whether the goals are attainable.
  bool IsPossibleWith(const Relaxation& relaxation) const;

  // In the scenario's words.
  std::string Describe(const Constraint& constraint) const;

  const std::vector<std::unique_ptr<RelaxedHand>>& hands() const { return hands_; }  // by robot
  const domain::Problem& problem() const { return problem_; }
  // The conditions that keep a hand from it.
  domain::GraspConditions Broken(const HoldOption& hold) const;
  // By how much a condition fails; none for conditions that are no matter of more or less.
  std::optional<domain::Limited> Measure(domain::GraspCondition condition,
                                         const HoldOption& hold) const;
  std::vector<HoldOption> Holds() const;  // all there are

 private:
  domain::Problem problem_;
  std::vector<std::unique_ptr<RelaxedHand>> hands_;
};

// The stable pose by its name, or by its label if it has none.
std::string PoseName(const domain::Part& part, domain::StablePoseId pose);

}  // namespace assay::posting
