#pragma once

#include <optional>
#include <vector>

#include "planner/finemotion/motions/motion_checker.h"
#include "planner/finemotion/strategy_search/passage.h"

namespace assay::finemotion {

inline constexpr double kLinearTurn = 0.045;  // radians within which one linearization is accurate

// A kind of motion that has a meaning wherever the part is. Strategies are made of maneuvers.
struct Maneuver {
  enum class Kind {
    kMove,     // a move along `direction`, in metres
    kTurn,     // a turn about `direction`, in radians
    kLetGo,    // a move away from a contact, along its normal
    kCenter,   // a move to the middle of the entry, across the way in
    kUpright,  // a turn to the entry's orientation
    kAdvance,  // a straight move to the next critical point, in the crevice
  };
  Kind kind = Kind::kMove;
  Vector3 direction = Vector3::Zero();  // unit vector for kMove and kTurn
  double amount = 0;                    // the greatest amount, in metres or radians
  bool to_contact = false;  // true: a contact must come before that amount; false: none may come
  ContactKey contact = {};  // the contact that kLetGo leaves
};

// Returns the critical point at which a maneuver from `critical_point` ends.
int PointAfter(const Maneuver& maneuver, int critical_point);

// The believed pose before a maneuver, and the contacts that can be made there.
struct Situation {
  BelievedPose believed;
  std::vector<PrimitiveContact> contacts;
};

// The result of a maneuver. Turns are divided into motions that are small enough for contacts to be
// linear. If the maneuver is not certain, the motion that is not certain is the last one.
struct Maneuvered {
  bool certain = false;
  std::vector<CertainMotion> motions = {};
  BelievedPose after = {};

  // Returns the least scale at which anything unwanted happens in the motions, as far as their
  // checks report it.
  double LeastScale() const;
  TestComparison Comparison() const;  // sums over all motions
};

// Maneuvers at one critical point of a passage. Maneuvers comply with kept contacts. A move goes
// along these contacts. A turn about the tip becomes a turn about the contacts, because the part is
// moved at the same time.
class Maneuvering {
 public:
  // `reach` is the distance in metres within which contacts that a maneuver can come to are
  // searched for.
  Maneuvering(const Passage& passage, int critical_point, const MotionChecker& checker,
              double reach);

  // Returns the normals, outward from the walls, of the faces that the tip can touch across the way
  // in.
  const std::vector<Vector3>& laterals() const { return laterals_; }

  Situation At(const BelievedPose& believed) const;
  Maneuvered Apply(const Situation& situation, const Maneuver& maneuver, Margins margins) const;
  // Checks that the part comes to the believed pose straight along the way in, from outside,
  // without touching anything.
  SegmentCheck CheckReached(const BelievedPose& believed) const;
  bool IsReached(const BelievedPose& believed) const { return CheckReached(believed).certain; }
  // Checks that a strategy may end at the believed pose: it is upright, its errors are within the
  // play, and the way in is free. The unwanted contact is a wall against which the errors are too
  // great, or whatever stands in the way.
  SegmentCheck CheckThrough(const BelievedPose& believed) const;
  bool IsThrough(const BelievedPose& believed) const { return CheckThrough(believed).certain; }
  // Returns the rotation, as a vector, from this pose to the entry's orientation.
  Vector3 ToUpright(const Pose& X_StationaryMoving) const;
  // Returns the number of independent directions in which the errors are greater than the play
  // between walls.
  int WideDirections(const BelievedPose& believed) const;
  // Returns how many times the errors must be halved until they are within the play between walls,
  // summed over independent directions.
  double Halvings(const BelievedPose& believed) const;

 private:
  struct Direction;
  std::optional<Direction> DirectionOf(const Situation& situation, const Maneuver& maneuver) const;
  PoseChange Refined(const Pose& X, const Command& command) const;
  // Checks that nothing blocks the part if it goes straight along the way in, until shortly before
  // the next critical point or the seat. The part may touch walls, because walls guide the part.
  SegmentCheck CheckWayOn(const BelievedPose& believed) const;
  // Returns whether the errors leave room between the part and the wall.
  bool IsWithinPlay(const PrimitiveContact& wall, const BelievedPose& believed) const;
  // Returns the length of the way in to the next critical point or the seat, in metres. It is
  // shortened by the distance that errors may put the part ahead of its believed pose.
  double WayToNext(const BelievedPose& believed) const;

  // Returns the distance in metres, across the way in, from the tip to the part's farthest corner.
  double Breadth() const;

  const Passage& passage_;
  int critical_point_;
  Pose X_StationaryEntry_;
  MotionChecker checker_;
  double reach_;
  std::vector<PrimitiveContact> walls_;
  std::vector<Vector3> laterals_;
};

// Returns the maneuvers at each critical point of a passage. The result refers to `passage`.
std::vector<Maneuvering> ManeuveringThrough(const Passage& passage, const MotionChecker& checker,
                                            double reach);

}  // namespace assay::finemotion
