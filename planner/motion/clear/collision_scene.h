#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "planner/base/id.h"
#include "planner/domain/problem/problem.h"
#include "planner/domain/reach/reachability.h"
#include "planner/geometry/rounded_hull.h"
#include "planner/kinematics/arm.h"

namespace assay::motion {

using domain::PartId;
using geometry::Pose;
using geometry::RoundedHull;
using geometry::Vector3;
using kinematics::JointVector;

using BodyId = Id<struct BodyTag>;
using LinkPoses = std::array<Pose, 7>;  // of the arm's links in its base, as Arm::LinkPoses

// A union of convex polyhedra that moves with one link of the arm, or stands.
struct Body {
  std::string name;                // "upper_arm", "hand", "table", or a part's
  int link = 0;                    // 0: the arm's base, and what stands with it
  std::vector<RoundedHull> hulls;  // in the link's frame
  // reach[k]: no point of the body is ever farther from the axis of joint k + 1 than this, metres;
  // 0 for joints that do not move it.
  std::array<double, 6> reach = {};
  Vector3 center = Vector3::Zero();  // of a ball that holds the body, in the link's frame
  double ball_radius = 0;
  double doubt = 0;  // a point of it may be so far from where it is here, metres
};

// Two bodies that must not touch; the second is at least as far along the arm.
struct BodyPair {
  BodyId first;
  BodyId second;

  bool operator==(const BodyPair&) const = default;
};

struct Nearness {
  BodyPair pair = {};
  double distance = 0;  // metres, never more than the truth; 0: they overlap or touch
};

struct HeldPart {
  PartId part;
  Pose X_PartTool;
};

// Another robot of the workcell, which stands still.
struct StandingRobot {
  domain::RobotId robot;
  JointVector q = JointVector::Zero();
  double opening = 0;  // between its pads, metres
};

// What is where while the arm moves.
struct Surroundings {
  std::vector<domain::PlacedPart> parts = {};  // that stand still; others are not there
  std::optional<HeldPart> held = {};
  std::vector<double> doubts = {};  // of the parts by PartId, metres (Body::doubt); empty: none
  double opening = 0;               // between the pads, metres
  // Robots that are not named stand at their homes with open grippers.
  std::vector<StandingRobot> robots = {};
};

// The arm's links, each in its own frame. A link's shapes are its URDF's collisions, or its visuals
// if there are none; round ones are replaced by polyhedra that hold them (cylinders by prisms of 16
// sides).
std::vector<Body> ArmBodies(const kinematics::Arm& arm);

// The workcell as bodies: the arm's links, hand, fingers, held part, table, floor
// (domain::FloorHeight), parts, and the workcell's other robots ("forearm of right").
//
// Not tested, since they touch or are kept apart by construction: what is fixed to the same link
// (so the held part against fingers and hand), and links of the arm that one joint connects. Two
// joints whose axes meet in a point count as one: base and upper arm, forearm and wrist.
class CollisionScene {
 public:
  CollisionScene(const domain::Problem& problem, const Surroundings& surroundings)
      : CollisionScene(problem, surroundings, ArmBodies(problem.workcell->arm())) {}
  // `arm`: ArmBodies, worked out once for many surroundings.
  CollisionScene(const domain::Problem& problem, const Surroundings& surroundings,
                 std::vector<Body> arm);

  const domain::Workcell& workcell() const { return *workcell_; }
  const kinematics::Arm& arm() const { return workcell_->arm(); }
  const std::vector<Body>& bodies() const { return bodies_; }
  const Body& body(BodyId id) const { return bodies_[static_cast<std::size_t>(id.index())]; }
  const std::vector<BodyPair>& pairs() const { return pairs_; }

  // Hand, fingers or held part.
  bool IsCarried(BodyId id) const;
  bool IsOfAnotherRobot(BodyId id) const;

  // The distance of two bodies, never more than the truth. From `enough` on, anything that is at
  // least `enough` may be told.
  double Separation(const BodyPair& pair, const LinkPoses& X_BaseLink, double enough) const;
  // The same for a posture that is near to the last one, for which `slabs` was filled
  // (geometry::Separation, by pair of hulls); empty at first.
  using Slabs = std::vector<Vector3>;
  double Separation(const BodyPair& pair, const LinkPoses& X_BaseLink, double enough,
                    Slabs& slabs) const;

  // The pair that is nearest to touching.
  Nearness Nearest(const JointVector& q) const;

  // How far any point of the pair's second body moves, seen from its first, while no joint turns
  // by more than `turn` (radians, >= 0) one way: metres.
  double GreatestMotion(const BodyPair& pair, const JointVector& turn) const;

  // "the hand and the brick"
  std::string Describe(const BodyPair& pair) const;

 private:
  Body& Add(std::string name, int link, std::vector<RoundedHull> hulls);
  void AddGripper(double opening);
  void AddStage();
  void AddOtherRobots(const std::vector<StandingRobot>& said);
  void AddOtherRobot(const domain::Robot& robot, const JointVector& q, double opening);
  void ListPairs();
  bool AreNeighbours(int link, int later_link) const;

  std::shared_ptr<const domain::Workcell> workcell_;
  std::vector<Body> bodies_;
  std::vector<BodyPair> pairs_;
  int arm_bodies_ = 0;  // the first so many are the arm's own links
  // Of the other robots are the bodies from this index on, up to that one.
  int others_begin_ = 0;
  int others_end_ = 0;
};

}  // namespace assay::motion
