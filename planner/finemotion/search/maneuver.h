#pragma once

#include <optional>
#include <vector>

#include "planner/finemotion/search/motion_checker.h"

namespace assay::finemotion {

// What is to be entered: a hole, a slot, a step further down.
struct Passage {
  Polyhedron moving;  // about the tip: the moving part's origin, in the stationary part's axes
  Polyhedron stationary;
  Pose X_StationaryEntry = Pose::Identity();  // of the tip at the first critical point, no errors
  Vector3 mating = -Vector3::UnitZ();         // unit, the way in
  std::vector<double> further = {};  // metres from there to the next critical points, ascending
  double depth = 0.003;              // metres from a critical point that are looked at for walls
  double seat = 0.003;               // metres from the last critical point to the end of the way in
  std::vector<ModelTolerance> tolerances = {};

  int critical_points() const { return 1 + static_cast<int>(further.size()); }
  // Of the tip at critical point i, without errors.
  Pose X_StationaryEntryAt(int i) const;
};

inline constexpr double kLinearTurn = 0.045;  // radians that one linearization is good for
inline constexpr double kAcross = 0.1;        // cosine, between the way in and what is across it

// What the tip can touch across the way in at a critical point: corners and faces.
std::vector<PrimitiveContact> WallsAt(const Passage& passage, int critical_point,
                                      const ContactFinder& finder);

// A way to move that means something wherever the part is: what strategies are made of.
struct Maneuver {
  enum class Kind {
    kMove,     // along `direction`, metres
    kTurn,     // about `direction`, radians
    kLetGo,    // of a contact, along its normal
    kCenter,   // to the middle of the entry, across the way in
    kUpright,  // to the entry's orientation
    kAdvance,  // straight on to the next critical point, in the crevice
  };
  Kind kind = Kind::kMove;
  Vector3 direction = Vector3::Zero();  // unit; of kMove and kTurn
  double amount = 0;                    // at most
  bool to_contact = false;              // a contact must come before that; else none may come
  ContactKey contact = {};              // of kLetGo
};

// The critical point that one at `critical_point` leads to.
int PointAfter(const Maneuver& maneuver, int critical_point);

// Where maneuvers start, and what can be touched there.
struct Situation {
  Belief belief;
  std::vector<PrimitiveContact> contacts;
};

// What became of a maneuver: its motions, the turns in steps that are small enough for contacts to
// be linear. Not certain: the last motion is the one that is not.
struct Maneuvered {
  bool certain = false;
  std::vector<CertainMotion> motions = {};
  Belief after = {};

  // Of what is unwanted in any of the motions, as far as they tell.
  double LeastScale() const;
  TestComparison Comparison() const;  // of all motions
};

// Maneuvers at one critical point of a passage. Kept contacts are complied with: a move goes along
// them, and a turn about the tip is made one about the contacts by moving as well.
class Maneuvering {
 public:
  // `reach`: metres that are looked ahead for what a maneuver may come to.
  Maneuvering(const Passage& passage, int critical_point, const MotionChecker& checker,
              double reach);

  // Normals of what the tip can touch across the way in, outward from the walls.
  const std::vector<Vector3>& laterals() const { return laterals_; }

  Situation At(const Belief& belief) const;
  Maneuvered Apply(const Situation& situation, const Maneuver& maneuver, Margins margins) const;
  // Straight along the way in, from outside, the part comes there without touching anything.
  SegmentCheck CheckReached(const Belief& belief) const;
  bool IsReached(const Belief& belief) const { return CheckReached(belief).certain; }
  // What strategies end in: upright, within the play, and the way in is free. Unwanted is a wall
  // that there are too great errors against, or what stands in the way on.
  SegmentCheck CheckThrough(const Belief& belief) const;
  bool IsThrough(const Belief& belief) const { return CheckThrough(belief).certain; }
  // The rotation that is left to the entry's orientation, as a vector.
  Vector3 ToUpright(const Pose& X_StationaryMoving) const;
  // How many independent directions there are in which the errors are greater than the play
  // between walls.
  int WideDirections(const Belief& belief) const;

 private:
  struct Direction;
  std::optional<Direction> DirectionOf(const Situation& situation, const Maneuver& maneuver) const;
  PoseChange Refined(const Pose& X, const Command& command) const;
  // Straight on along the way in, to shortly before the next critical point or the seat, nothing
  // stands against the part. Walls may be touched: they lead.
  SegmentCheck CheckWayOn(const Belief& belief) const;
  // Errors leave room to it.
  bool IsWithinPlay(const PrimitiveContact& wall, const Belief& belief) const;
  // Along the way in to the next critical point, or the seat, short of it by what errors may put
  // the part beyond where it is believed to be.
  double WayToNext(const Belief& belief) const;

  // Metres across the way in, from the tip to the part's farthest corner.
  double Breadth() const;

  const Passage& passage_;
  int critical_point_;
  Pose X_StationaryEntry_;
  MotionChecker checker_;
  double reach_;
  std::vector<PrimitiveContact> walls_;
  std::vector<Vector3> laterals_;
};

// At each critical point of a passage. `passage` is referred to.
std::vector<Maneuvering> ManeuveringThrough(const Passage& passage, const MotionChecker& checker,
                                            double reach);

}  // namespace assay::finemotion
