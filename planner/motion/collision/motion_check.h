#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "planner/motion/collision/collision_scene.h"
#include "planner/motion/collision/pair_errors.h"
#include "planner/plan/data/tool_error_box.h"

namespace assay::motion {

// Keeps a held object upright: a direction of the tool has a greatest angle from the vertical.
struct Upright {
  Vector3 up_Tool = -Vector3::UnitZ();  // unit, tool frame: the direction that should point up
  double tilt = 0;                      // greatest angle from the world's z, radians
};

// The clearance of the arm's links, the hand and the fingers from each other, metres. The links of
// some wrists are never farther from each other than a few millimetres.
inline constexpr double kOwnClearance = 0.005;

// The rules that a motion must obey everywhere on its way.
struct MotionRules {
  // Least distance of every pair of bodies beyond their errors (Body::error), metres, >= 0. The
  // arm's links, and the hand, need no more than kOwnClearance from each other.
  double clearance = 0.01;
  std::optional<Upright> upright = {};
  // Errors of the joints, in radians, and of the tool, which may occur at once. Everything keeps
  // the clearance in spite of them. The tool keeps its orientation in a motion that has these
  // errors.
  JointVector sway = JointVector::Zero();
  plan::ToolErrorBox tool = {};
  // Postures that are prescribed, such as the ends of straight lines. In these postures, the load
  // of the arm may be nearer to a body than the clearance. In the rest of the motion, the load
  // keeps at least nine tenths of its least distance from this body in these postures. If errors
  // may bring the load to the body in these postures, the errors of this pair are left out in the
  // rest of the motion, too.
  std::vector<JointVector> given = {};
  // If this is set, the load keeps at least this distance, in metres, from every body in spite of
  // all errors, in the given postures too. A body that may come nearer in a given posture obstructs
  // the motion. The parts in `at_work` are excepted, since the robot works on them there, and
  // conditions about this work keep the load clear of them.
  std::optional<double> certain_clearance = {};
  std::vector<domain::PartId> at_work = {};
  enum class Bodies {
    kAll,
    kArm,     // the arm, and what it carries against the arm; the rest is tested at its work
    kRobots,  // arm and what it carries, but only against the workcell's other robots
  };
  Bodies bodies = Bodies::kAll;
};

// The obstruction of a motion.
struct Obstruction {
  enum class Kind {
    kLimits,  // a joint is out of its range
    kTilt,    // the upright object leans too far
    kPair,    // `pair` comes nearer than its clearance
  };
  Kind kind = Kind::kPair;
  BodyPair pair = {};    // the bodies, only for kPair
  double clearance = 0;  // clearance that `pair` must keep, metres
  JointVector at = JointVector::Zero();
};

// Returns a text such as "the hand and brick are nearer than 10.0 mm".
std::string Describe(const CollisionScene& scene, const MotionRules& rules,
                     const Obstruction& obstruction);

// Decides whether straight motions in joint space obey the rules at every point, not only at
// samples. A pair is free all along a motion if its distance in the middle is more than its bodies
// can move on either half. All other pairs are tested again on each half (Schwarzer, Saha and
// Latombe, "Adaptive Dynamic Collision Checking for Single and Multiple Articulated Robots", 2005).
// A pair that comes so near to the clearance that the halving does not end counts as obstructed. A
// path may be refused wrongly if it keeps the clearance by less than kUndecided (kUndecidedOfErrors
// if the pair has errors). A path is never accepted wrongly.
//
// A pair with errors is tested in the box of these errors (PairErrors), which is halved until the
// pair is decided.
class MotionCheck {
 public:
  MotionCheck(const CollisionScene& scene, const MotionRules& rules);

  // Returns the obstruction; none if all of the motion is free, its ends included. A motion from a
  // posture to itself tells whether the arm may rest there.
  std::optional<Obstruction> FindObstruction(const JointVector& from, const JointVector& to);

  const CollisionScene& scene() const { return scene_; }
  const MotionRules& rules() const { return rules_; }
  std::int64_t postures() const { return postures_; }  // number of postures tested

  static constexpr double kUndecided = 1e-4;          // metres, or radians of tilt
  static constexpr double kUndecidedOfErrors = 1e-3;  // metres

 private:
  struct WatchedPair {
    BodyPair pair;
    PairErrors errors;
    double clearance = 0;  // with the errors that have no direction, metres
    // In postures without errors, the bodies never need a greater distance than this, metres. It is
    // infinite unless the second body is a load to which errors may bring the first body in a given
    // posture (MotionRules::given).
    double most = 0;
    CollisionScene::Slabs slabs = {};  // slabs of the posture that was tested last
  };
  struct OpenPair {
    WatchedPair* watched;
    double motion = 0;  // movement of its bodies on the whole way, metres
  };
  // A part of a motion, with the pairs that are not yet known to be free on it.
  struct Interval {
    double middle = 0.5;  // shares of the way
    double half = 0.5;
    std::vector<OpenPair> pairs;
    bool tilt_is_open = false;
  };

  enum class Verdict { kFree, kOpen, kObstructed };

  std::vector<WatchedPair> WatchedPairs();
  // Lowers the distance that a pair with the load must keep to what it has in the given postures.
  void HeedGivenPostures(WatchedPair& watched);
  // Lowers the clearance of the pair to the distance that remains in the given postures for all
  // errors. Returns false, and changes nothing, if hardly any remains.
  bool LowerToCertainClearance(WatchedPair& watched) const;
  bool IsAtWork(const BodyPair& pair) const;
  // Tests a pair whose bodies move by `motion` metres, at the posture q with all errors.
  Verdict LookAt(const JointVector& q, const LinkPoses& X_BaseLink, double motion,
                 WatchedPair& watched) const;
  double Tilt(const LinkPoses& X_BaseLink) const;  // radians
  std::vector<OpenPair> OpenPairs(const JointVector& turn);
  // Removes from the interval all that the posture in its middle, q, shows to be free all along it.
  // `turn` is the sum of the turns of all joints on the whole way.
  std::optional<Obstruction> Narrow(Interval& interval, const JointVector& q, double turn);

  const CollisionScene& scene_;
  MotionRules rules_;
  std::vector<LinkPoses> given_;  // of rules_.given
  // The obstruction in a given posture if rules_.certain_clearance does not hold there.
  std::optional<Obstruction> in_given_posture_;
  std::vector<WatchedPair> watched_;
  Vector3 up_Flange_ = Vector3::Zero();
  Vector3 up_Base_ = Vector3::Zero();
  std::int64_t postures_ = 0;
};

}  // namespace assay::motion
