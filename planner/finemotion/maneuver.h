#pragma once

#include <optional>
#include <vector>

#include "planner/finemotion/contact_finder.h"
#include "planner/finemotion/segment.h"

namespace assay::finemotion {

// What is to be entered: a hole, a slot, a step further down.
struct Passage {
  Polyhedron moving;  // about the tip: the moving part's origin, in the stationary part's axes
  Polyhedron stationary;
  Pose X_StationaryEntry = Pose::Identity();  // of the tip at the critical point, without errors
  Vector3 mating = -Vector3::UnitZ();         // unit, the way in
  double depth = 0.003;                       // metres from there that count as in
  std::vector<ModelTolerance> tolerances = {};
};

// A way to move that means something wherever the part is: what strategies are made of.
struct Maneuver {
  enum class Kind {
    kMove,     // along `direction`, metres
    kTurn,     // about `direction`, radians
    kLetGo,    // of a contact, along its normal
    kCenter,   // to the middle of the entry, across the way in
    kUpright,  // to the entry's orientation
  };
  Kind kind = Kind::kMove;
  Vector3 direction = Vector3::Zero();  // unit; of kMove and kTurn
  double amount = 0;                    // at most
  bool to_contact = false;              // a contact must come before that; else none may come
  ContactKey contact = {};              // of kLetGo
};

// A motion of a strategy and what is certain of it.
struct CertainMotion {
  Command command;
  Pose X_StationaryAfter = Pose::Identity();  // of the tip, if there are no errors
  SegmentCheck check;
  std::vector<PrimitiveContact> contacts;  // of the command, kept and made, as they are then; told
                                           // with the margins
};

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
};

// Maneuvers at one passage. Kept contacts are complied with: a move goes along them, and a turn
// about the tip is made one about the contacts by moving as well.
class Maneuvering {
 public:
  struct Options {
    double velocity_error = 0.002;
    double turn_error = 0.02;  // radians: about how far the part may be turned against its belief
    double reach = 0.012;      // metres within which contacts are looked for
    double radius = 0.02;
    MeetingTest test = MeetingTest::kExact;
  };
  enum class Margins {
    kNone,  // only whether motions are certain
    kAll,   // all that is unwanted is told, with its scale, and contacts
  };

  Maneuvering(const Passage& passage, const Options& options);

  const Passage& passage() const { return passage_; }
  // Normals of what the tip can touch across the way in, outward from the walls.
  const std::vector<Vector3>& laterals() const { return laterals_; }

  Situation At(const Belief& belief) const;
  Maneuvered Apply(const Situation& situation, const Maneuver& maneuver, Margins margins) const;
  std::vector<PrimitiveContact> ContactsAt(const Pose& X_StationaryMoving) const;
  // Straight on along the way in, the tip comes as deep as it should, and nothing stands against
  // it. Walls may be touched: they lead.
  bool ComesThrough(const Belief& belief) const;
  // The rotation that is left to the entry's orientation, as a vector.
  Vector3 ToUpright(const Pose& X_StationaryMoving) const;
  // How many independent directions there are in which the errors are greater than the play
  // between walls.
  int WideDirections(const Belief& belief) const;

 private:
  struct Direction;

  std::optional<Direction> DirectionOf(const Situation& situation, const Maneuver& maneuver) const;
  PoseChange Refined(const Pose& X, const Command& command) const;

  const Passage& passage_;
  Options options_;
  ContactFinder finder_;
  std::vector<Vector3> laterals_;
  std::vector<PrimitiveContact> walls_;
};

}  // namespace assay::finemotion
