#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "planner/base/id.h"
#include "planner/domain/problem/problem.h"
#include "planner/geometry/rounded_hull.h"
#include "planner/kinematics/arm.h"
#include "planner/motion/collision/surroundings.h"
#include "planner/plan/data/reason.h"

namespace assay::motion {

using geometry::RoundedHull;
using geometry::Vector3;

using BodyId = Id<struct BodyTag>;
// Poses of the arm's links in its base, as from Arm::LinkPoses.
using LinkPoses = std::array<Pose, 7>;

// A union of convex polyhedra that moves with one link of the arm, or stands still.
struct Body {
  std::string name;                // "upper_arm", "hand", "table", or a part's
  plan::NamedBody identity = {};   // the piece of a robot, or the part, that it is
  int link = 0;                    // 0: the arm's base, and everything that stands still
  std::vector<RoundedHull> hulls;  // in the link's frame
  // reach[k] is an upper bound on the distance, in metres, of any point of the body from the axis
  // of joint k + 1. It is 0 for joints that do not move the body.
  std::array<double, 6> reach = {};
  Vector3 center = Vector3::Zero();  // center of a ball that contains the body, in the link's frame
  double ball_radius = 0;
  PlaceError error = {};
  Vector3 origin = Vector3::Zero();  // of a standing part: the place of its origin, in the base
};

// Two bodies that must not touch; the second is at least as far along the arm.
struct BodyPair {
  BodyId first;
  BodyId second;

  bool operator==(const BodyPair&) const = default;
};

struct Nearness {
  BodyPair pair = {};
  double distance = 0;  // metres, never more than the true distance; 0: they overlap or touch
};

// Returns the arm's links, each in its own frame. A link's shapes are its URDF's collisions, or its
// visuals if there are none. Round shapes are replaced by polyhedra that contain them (cylinders by
// prisms of 16 sides).
std::vector<Body> ArmBodies(const kinematics::Arm& arm);

// The workcell as bodies: the arm's links, hand, fingers, held part, table, floor
// (domain::FloorHeight), parts, and the workcell's other robots ("forearm of right").
//
// Some pairs are not tested, since they touch or are kept apart by construction. These are bodies
// fixed to the same link (for example the held part and a finger), and links of the arm that one
// joint connects. Two joints whose axes meet in a point count as one: base and upper arm, forearm
// and wrist.
class CollisionScene {
 public:
  CollisionScene(const domain::Problem& problem, const Surroundings& surroundings)
      : CollisionScene(problem, surroundings, ArmBodies(problem.workcell->arm())) {}
  // `arm` is the result of ArmBodies, computed once for many surroundings.
  CollisionScene(const domain::Problem& problem, const Surroundings& surroundings,
                 std::vector<Body> arm);

  const domain::Workcell& workcell() const { return *workcell_; }
  const kinematics::Arm& arm() const { return workcell_->arm(); }
  const std::vector<Body>& bodies() const { return bodies_; }
  const Body& body(BodyId id) const { return bodies_[static_cast<std::size_t>(id.index())]; }
  const std::vector<BodyPair>& pairs() const { return pairs_; }

  // Returns whether the body is a link of the acting robot's arm.
  bool IsOfArm(BodyId id) const { return id.index() < arm_bodies_; }
  // Returns whether the body is a link of that arm, its hand, or a finger.
  bool IsOfRobot(BodyId id) const;
  // Returns whether the body is the hand, the fingers or the held part.
  bool IsCarried(BodyId id) const;
  bool IsOfAnotherRobot(BodyId id) const;

  // Returns the distance of two bodies, in metres, never more than the true one. If the distance is
  // at least `enough`, any value from `enough` up may be returned.
  double Separation(const BodyPair& pair, const LinkPoses& X_BaseLink, double enough) const;
  // Returns the distance like the other overload, but faster for a posture near to the one of the
  // last call. `slabs` has the directions of the slabs that the last call found, one for each pair
  // of hulls (see geometry::Separation). Give an empty `slabs` to the first call.
  using Slabs = std::vector<Vector3>;
  double Separation(const BodyPair& pair, const LinkPoses& X_BaseLink, double enough,
                    Slabs& slabs) const;

  // Returns the pair that is nearest to touching.
  Nearness Nearest(const JointVector& q) const;

  // Returns how far any point of the pair's second body moves, seen from its first, while no joint
  // turns by more than `turn` (radians, >= 0) one way. In metres.
  double GreatestMotion(const BodyPair& pair, const JointVector& turn) const;

  // Returns a text such as "the hand and brick", where brick is the name of a part.
  std::string Describe(const BodyPair& pair) const;

 private:
  Body& Add(std::string name, int link, std::vector<RoundedHull> hulls,
            const plan::NamedBody& identity = {});
  void AddGripper(double opening);
  void AddStage();
  void AddOtherRobots(const std::vector<StandingRobot>& said);
  void AddOtherRobot(domain::RobotId id, const JointVector& q, double opening);
  void ListPairs();
  bool AreNeighbours(int link, int later_link) const;

  std::shared_ptr<const domain::Workcell> workcell_;
  std::vector<Body> bodies_;
  std::vector<BodyPair> pairs_;
  int arm_bodies_ = 0;  // number of the arm's own links, which come first
  // Bodies of other robots have the indices from others_begin_ up to, but without, others_end_.
  int others_begin_ = 0;
  int others_end_ = 0;
};

}  // namespace assay::motion
