#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "planner/constraint_posting/impossibility/relaxed_hand.h"

namespace assay::constraint_posting {

// A condition or fact of a problem that a relaxation can leave out while it keeps the others.
struct Constraint {
  enum class Kind {
    kGraspCondition,    // a grasp condition; index in domain::kGraspConditions
    kGrasps,            // a part has no grasps at all
    kStart,             // a part starts where it does
    kInTheWay,          // a part blocks others as long as it is at its starting place
    kFeaturesOffPads,   // mating features keep off the pads; index of a mating
    kFeaturesOffTable,  // mating features keep off the table; index of a mating
    kFrictionCone,      // the mating vector is in the friction cone; index of a mating
    kLocated            // a part must end in certain poses; index of a goal
  };
  Kind kind;
  int index;

  bool operator==(const Constraint&) const = default;
};

// A hold that is considered: a robot takes a part, puts it down or mates it with this grasp and
// position. The hold need not be possible.
struct HoldOption {
  int robot = 0;
  domain::PartId part;                                 // the part in the hand
  domain::MatingId mating = domain::MatingId::None();  // None if the part is taken or put down
  int grasp = 0;
  int position = 0;  // the position label of the part, or of the mating's fixed part

  bool operator==(const HoldOption&) const = default;
};

// The constraints of a problem that are kept in a relaxation. All other constraints are dropped.
struct Relaxation {
  std::vector<Constraint> constraints;
  // Weakens one condition. The condition counts as satisfied if it fails by less than `excess`, and
  // it counts as satisfied for the hold `also`.
  struct Waiver {
    domain::GraspCondition condition;
    double excess = 0;  // metres or radians
    std::optional<HoldOption> also = {};
  };
  std::optional<Waiver> waiver = {};
  std::optional<int> robot = {};  // the only robot that acts, or none if all act
};

// The facts that could possibly come true. No other fact can come true.
struct Attainable {
  std::vector<std::vector<bool>> rests;              // indexed by part, by position label
  std::vector<std::vector<std::vector<bool>>> held;  // indexed by robot, by part, by grasp
  std::vector<bool> mated;                           // indexed by mating
  PartSet moved;       // parts that may not be where they were at the start
  PartSet unfollowed;  // parts for which everything counts as possible
};

// The delete relaxation of a problem (Bonet and Geffner 2001, section 4). A fact that has come true
// stays true, so every part is at once in all places that it can reach. A fact that cannot be
// attained in the relaxation cannot be attained in the problem itself. Each robot of the workcell
// acts. A part blocks others until it can be moved.
//
// The relaxation does not follow some parts, and assumes that everything is possible with them.
// Some of these parts are mated or may have been mated: they can be carried together and mated with
// others anywhere. The other parts start in none of their stable poses, and may fall.
class RelaxedProblem {
 public:
  enum class Grasps {
    kListed,  // the grasps of the problem
    // the grasps of the problem, and grasps that are too wide for the gripper or whose pads stick
    // out
    kWithMisses
  };
  RelaxedProblem(const domain::Problem& problem, Grasps grasps);

  // Returns all constraints. The assumptions that a person is least likely to change come first.
  std::vector<Constraint> Constraints() const;

  Attainable AttainableWith(const Relaxation& relaxation) const;
  // Returns true if the goals are attainable.
  bool IsPossibleWith(const Relaxation& relaxation) const;

  const std::vector<std::unique_ptr<RelaxedHand>>& hands() const {
    return hands_;
  }  // indexed by robot
  const domain::Problem& problem() const { return problem_; }
  // Returns the conditions that prevent the hold.
  domain::GraspConditions Broken(const HoldOption& hold) const;
  // Returns the amount by which a condition fails, or none for a condition that limits no quantity.
  std::optional<domain::Limited> Measure(domain::GraspCondition condition,
                                         const HoldOption& hold) const;
  std::vector<HoldOption> Holds() const;  // all possible holds

 private:
  domain::Problem problem_;
  std::vector<std::unique_ptr<RelaxedHand>> hands_;
};

}  // namespace assay::constraint_posting
