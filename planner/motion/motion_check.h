#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "planner/motion/collision_scene.h"

namespace assay::motion {

// Keeps what is carried upright: a direction of the tool leans at most so far from the vertical.
struct Upright {
  Vector3 up_Tool = -Vector3::UnitZ();  // unit, tool frame: what should point up
  double tilt = 0;                      // greatest angle from the world's z, radians
};

// What a motion must keep to, everywhere on its way.
struct MotionRules {
  // Of every pair of bodies, metres, >= 0; beyond their doubts (Body::doubt).
  double clearance = 0.01;
  std::optional<Upright> upright = {};
  // Each joint may be so far from where the motion has it, radians: the arm's links keep the
  // clearance all the same. What it carries may be so far from there, metres.
  JointVector sway = JointVector::Zero();
  double carried_sway = 0;
  // Postures that are given, as those where straight lines end: what the arm carries may come to
  // anything nearly as near as it is in one of these.
  std::vector<JointVector> given = {};
  enum class Bodies {
    kAll,
    kArm,     // not what the arm carries: that is held against its work elsewhere
    kRobots,  // arm and what it carries, but against the workcell's other robots alone
  };
  Bodies bodies = Bodies::kAll;
};

// What stands in the way of a motion.
struct Obstruction {
  enum class Kind {
    kLimits,  // a joint is out of its range
    kTilt,    // what is to be kept upright leans too far
    kPair,    // `pair` comes nearer than the clearance
  };
  Kind kind = Kind::kPair;
  BodyPair pair = {};    // of kPair
  double clearance = 0;  // that `pair` must keep, metres
  JointVector at = JointVector::Zero();
};

// "the hand and the brick are nearer than 10 mm"
std::string Describe(const CollisionScene& scene, const MotionRules& rules,
                     const Obstruction& obstruction);

// Whether straight motions in joint space keep to the rules, exactly: not only at samples. A pair
// whose distance in the middle of a motion is more than what its bodies can move on either half is
// free all along; the others are asked again on each half (Schwarzer, Saha and Latombe, "Adaptive
// Dynamic Collision Checking for Single and Multiple Articulated Robots", 2005). What comes so near
// the clearance that this does not end counts as obstructed: paths are refused for as little as
// kUndecided, never accepted wrongly.
class MotionCheck {
 public:
  MotionCheck(const CollisionScene& scene, const MotionRules& rules);

  // What is in the way; none if all of the motion is free, its ends included. From a posture to
  // itself: whether the arm may rest there.
  std::optional<Obstruction> FindObstruction(const JointVector& from, const JointVector& to);

  const CollisionScene& scene() const { return scene_; }
  const MotionRules& rules() const { return rules_; }
  std::int64_t postures() const { return postures_; }  // looked at until now

  static constexpr double kUndecided = 1e-4;  // metres, or radians of tilt

 private:
  struct WatchedPair {
    BodyPair pair;
    double clearance = 0;              // metres
    CollisionScene::Slabs slabs = {};  // of the posture that was looked at last
  };
  struct OpenPair {
    WatchedPair* watched;
    double motion = 0;  // of its bodies on the whole way, metres
  };
  // A part of a motion, and what is not yet known to be free on it.
  struct Interval {
    double middle = 0.5;  // shares of the way
    double half = 0.5;
    std::vector<OpenPair> pairs;
    bool tilt_is_open = false;
  };

  std::vector<WatchedPair> WatchedPairs() const;
  // By how much the pair may be nearer than it seems, metres.
  double ErrorsOf(const BodyPair& pair) const;
  double Tilt(const LinkPoses& X_BaseLink) const;  // radians
  std::vector<OpenPair> OpenPairs(const JointVector& turn);
  // Takes from the interval what the posture in its middle, q, shows to be free all along it.
  // `turn`: the sum of what all joints turn on the whole way.
  std::optional<Obstruction> Narrow(Interval& interval, const JointVector& q, double turn);

  const CollisionScene& scene_;
  MotionRules rules_;
  std::vector<WatchedPair> watched_;
  Vector3 up_Flange_ = Vector3::Zero();
  Vector3 up_Base_ = Vector3::Zero();
  std::int64_t postures_ = 0;
};

}  // namespace assay::motion
