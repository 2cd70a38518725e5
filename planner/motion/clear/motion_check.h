#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "planner/motion/clear/collision_scene.h"
#include "planner/plan/data/tool_doubt.h"

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
  // Each joint may be so far from where the motion has it, radians, and the tool so far, both at
  // once: everything keeps the clearance all the same. The tool keeps its orientation in a motion
  // that has such errors.
  JointVector sway = JointVector::Zero();
  plan::ToolDoubt tool = {};
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
// kUndecided (kUndecidedOfSway where joints may sway), never accepted wrongly.
//
// Where joints may sway, a pair is looked at in a box of those that move its bodies against each
// other, which is halved likewise. Of what stands, the links from the wrist on are seen from the
// tool, whose errors are small, and not from the arm's base: their box is of the joints beyond
// them.
class MotionCheck {
 public:
  MotionCheck(const CollisionScene& scene, const MotionRules& rules);

  // What is in the way; none if all of the motion is free, its ends included. From a posture to
  // itself: whether the arm may rest there.
  std::optional<Obstruction> FindObstruction(const JointVector& from, const JointVector& to);

  const CollisionScene& scene() const { return scene_; }
  const MotionRules& rules() const { return rules_; }
  std::int64_t postures() const { return postures_; }  // looked at until now

  static constexpr double kUndecided = 1e-4;        // metres, or radians of tilt
  static constexpr double kUndecidedOfSway = 1e-3;  // metres

 private:
  struct WatchedPair {
    BodyPair pair;
    double clearance = 0;  // metres
    double most = 0;       // with the tool's errors
    bool is_seen_from_tool = false;
    JointVector sway = JointVector::Zero();   // of the joints that move one body against the other
    JointVector reach = JointVector::Zero();  // of the second body from their axes, metres
    CollisionScene::Slabs slabs = {};         // of the posture that was looked at last
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

  enum class Verdict { kFree, kOpen, kObstructed };

  std::vector<WatchedPair> WatchedPairs() const;
  WatchedPair Watched(const BodyPair& pair) const;
  // How far the tool's errors move a body that moves with it, if that is within `near` of where it
  // is here: metres.
  double ErrorOfTool(const Body& body, const LinkPoses& X_BaseLink, double near) const;
  // At a posture, q, with all that errors may make of it, of a pair whose bodies move by `motion`.
  Verdict LookAt(const JointVector& q, const LinkPoses& X_BaseLink, double motion,
                 WatchedPair& watched) const;
  LinkPoses Swayed(const WatchedPair& watched, const JointVector& q, const LinkPoses& X_BaseLink,
                   const JointVector& offset) const;
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
