#include "planner/motion/collision/collision_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "planner/domain/workcell/floor.h"
#include "planner/geometry/box.h"
#include "planner/geometry/hull.h"
#include "planner/motion/collision/shape_hull.h"

namespace assay::motion {
namespace {

using geometry::Box;

constexpr int kFlange = 6;           // the last link
constexpr double kFloorReach = 3;    // half the side of the floor's square around the base, metres
constexpr double kFloorDepth = 0.1;  // metres

std::vector<RoundedHull> HullsOfLink(const kinematics::Link& link, const Pose& X_FrameLink) {
  std::vector<RoundedHull> hulls;
  for (const kinematics::Collision& collision : link.collisions) {
    hulls.push_back(HullAround(collision.shape, X_FrameLink * collision.X_LinkShape));
  }
  if (!hulls.empty()) return hulls;
  for (const kinematics::Visual& visual : link.visuals) {
    hulls.push_back(HullAround(visual.shape, X_FrameLink * visual.X_LinkShape));
  }
  return hulls;
}

template <class Measure>
double GreatestOverVertices(const std::vector<RoundedHull>& hulls, const Measure& measure) {
  double greatest = 0;
  for (const RoundedHull& hull : hulls) {
    for (const Vector3& vertex : hull.vertices()) greatest = std::max(greatest, measure(vertex));
  }
  return greatest;
}

double DistanceFromAxis(const Vector3& p, const Vector3& axis) { return p.cross(axis).norm(); }

// Returns, for each joint before the body's link, an upper bound on the distance of the body's
// points from the joint's axis. The loop goes from the body's link to the base. The axis of
// joints[k] passes through the origin of link k + 1. `offset` leads from there to the origin of
// link k + 2. `ball` is the radius of a ball that contains the body. At first, the centre of this
// ball is the origin of the body's link. The last line of a pass moves the centre to the origin of
// link k + 1.
std::array<double, 6> ReachOf(const Body& body, const kinematics::RobotModel& robot) {
  std::array<double, 6> reach = {};
  double ball = GreatestOverVertices(body.hulls, [](const Vector3& p) { return p.norm(); });
  for (int k = body.link - 1; k >= 0; --k) {
    const Vector3& axis = robot.joints[k].axis;
    if (k == body.link - 1) {
      reach[k] = GreatestOverVertices(body.hulls,
                                      [&](const Vector3& p) { return DistanceFromAxis(p, axis); });
      continue;
    }
    const Vector3 offset = robot.joints[k + 1].X_ParentJoint.translation();
    reach[k] = DistanceFromAxis(offset, axis) + ball;
    ball += offset.norm();
  }
  return reach;
}

Body BodyOf(std::string name, int link, std::vector<RoundedHull> hulls,
            const kinematics::RobotModel& robot) {
  Body body{.name = std::move(name), .link = link, .hulls = std::move(hulls)};
  body.reach = ReachOf(body, robot);
  Eigen::AlignedBox3d bounds;
  for (const RoundedHull& hull : body.hulls) {
    for (const Vector3& vertex : hull.vertices()) bounds.extend(vertex);
  }
  body.center = bounds.center();
  body.ball_radius =
      GreatestOverVertices(body.hulls, [&](const Vector3& p) { return (p - body.center).norm(); });
  return body;
}

RoundedHull TableHull(const domain::Table& table, const Pose& X_BaseWorld) {
  std::vector<Vector3> corners;
  for (const geometry::Vector2& corner : table.top) {
    corners.push_back(X_BaseWorld * Vector3(corner.x(), corner.y(), 0));
    corners.push_back(X_BaseWorld * Vector3(corner.x(), corner.y(), -table.thickness));
  }
  return RoundedHull(corners);
}

double BallGap(const Pose& X_BaseA, const Vector3& a, double a_radius, const Pose& X_BaseB,
               const Vector3& b, double b_radius) {
  return (X_BaseA * a - X_BaseB * b).norm() - a_radius - b_radius;
}

}  // namespace

std::vector<Body> ArmBodies(const kinematics::Arm& arm) {
  std::vector<Body> bodies;
  const std::vector<kinematics::Link>& links = arm.model().links;
  for (std::size_t i = 0; i < links.size(); ++i) {
    if (std::vector<RoundedHull> hulls = HullsOfLink(links[i], Pose::Identity()); !hulls.empty()) {
      bodies.push_back(BodyOf(links[i].name, static_cast<int>(i), std::move(hulls), arm.model()));
    }
  }
  return bodies;
}

CollisionScene::CollisionScene(const domain::Problem& problem, const Surroundings& surroundings,
                               std::vector<Body> arm)
    : workcell_(problem.workcell),
      bodies_(std::move(arm)),
      arm_bodies_(static_cast<int>(bodies_.size())) {
  const auto error_of = [&](PartId part) {
    return surroundings.errors.empty() ? PlaceError{} : surroundings.errors[part.index()];
  };
  for (Body& link : bodies_) link.identity = {.robot = workcell_->acting(), .piece = link.name};
  AddGripper(surroundings.opening);
  if (surroundings.held) {
    const domain::Part& part = problem.part(surroundings.held->part);
    const Pose X_FlangePart =
        workcell_->gripper().X_FlangeTool() * surroundings.held->X_PartTool.inverse();
    Add(part.name, kFlange, HullsOf(part.model->pieces(), X_FlangePart),
        {.part = surroundings.held->part})
        .error = error_of(surroundings.held->part);
  }
  AddStage();
  AddOtherRobots(surroundings.robots);
  const Pose X_BaseWorld = workcell_->X_WorldBase().inverse();
  for (const auto& [id, X_WorldPart] : surroundings.parts) {
    const domain::Part& part = problem.part(id);
    const Pose X_BasePart = X_BaseWorld * X_WorldPart;
    Body& body = Add(part.name, 0, HullsOf(part.model->pieces(), X_BasePart), {.part = id});
    body.error = error_of(id);
    body.origin = X_BasePart.translation();
  }
  ListPairs();
}

Body& CollisionScene::Add(std::string name, int link, std::vector<RoundedHull> hulls,
                          const plan::NamedBody& identity) {
  Body& added =
      bodies_.emplace_back(BodyOf(std::move(name), link, std::move(hulls), arm().model()));
  added.identity = identity;
  return added;
}

void CollisionScene::AddGripper(double opening) {
  const kinematics::Gripper& gripper = workcell_->gripper();
  const double width = std::clamp(opening, 0.0, gripper.max_opening());
  const domain::RobotId robot = workcell_->acting();
  Add("hand", kFlange, HullsOf(geometry::HullsOf(gripper.HandBoxes()), gripper.X_FlangeTool()),
      {.robot = robot, .piece = "hand"});
  Add("fingers", kFlange,
      HullsOf(geometry::HullsOf(gripper.FingerBoxes(width)), gripper.X_FlangeTool()),
      {.robot = robot, .piece = "fingers"});
}

void CollisionScene::AddStage() {
  const Pose X_BaseWorld = workcell_->X_WorldBase().inverse();
  for (const domain::Table& table : workcell_->tables()) {
    Add(table.name, 0, {TableHull(table, X_BaseWorld)});
  }
  const Vector3 base = workcell_->X_WorldBase().translation();
  const double height = domain::FloorHeight(*workcell_);
  const Box floor =
      Box::FromCorners({base.x() - kFloorReach, base.y() - kFloorReach, height - kFloorDepth},
                       {base.x() + kFloorReach, base.y() + kFloorReach, height});
  Add("floor", 0, HullsOf(geometry::HullsOf({&floor, 1}), X_BaseWorld));
}

void CollisionScene::AddOtherRobots(const std::vector<StandingRobot>& said) {
  others_begin_ = static_cast<int>(bodies_.size());
  const std::vector<domain::Robot>& robots = workcell_->robots();
  for (std::size_t i = 0; i < robots.size(); ++i) {
    const domain::RobotId id(i);
    if (id == workcell_->acting()) continue;
    const auto stands = std::ranges::find(said, id, &StandingRobot::robot);
    if (stands == said.end()) {
      AddOtherRobot(id, robots[i].home, robots[i].gripper->max_opening());
    } else {
      AddOtherRobot(id, stands->q, stands->opening);
    }
  }
  others_end_ = static_cast<int>(bodies_.size());
}

void CollisionScene::AddOtherRobot(domain::RobotId id, const JointVector& q, double opening) {
  const domain::Robot& robot = workcell_->robots()[id.index()];
  const Pose X_BaseOther = workcell_->X_WorldBase().inverse() * robot.X_WorldBase;
  const std::vector<kinematics::Link>& links = robot.arm->model().links;
  const LinkPoses X_OtherLink = robot.arm->LinkPoses(q);
  const auto add = [&](const std::string& name, std::vector<RoundedHull> hulls) {
    if (hulls.empty()) return;
    Add(fmt::format("{} of {}", name, robot.name), 0, std::move(hulls),
        {.robot = id, .piece = name});
  };
  for (std::size_t i = 0; i < links.size(); ++i) {
    add(links[i].name, HullsOfLink(links[i], X_BaseOther * X_OtherLink[i]));
  }
  const kinematics::Gripper& gripper = *robot.gripper;
  const Pose X_BaseTool = X_BaseOther * X_OtherLink.back() * gripper.X_FlangeTool();
  add("hand", HullsOf(geometry::HullsOf(gripper.HandBoxes()), X_BaseTool));
  const double width = std::clamp(opening, 0.0, gripper.max_opening());
  add("fingers", HullsOf(geometry::HullsOf(gripper.FingerBoxes(width)), X_BaseTool));
}

bool CollisionScene::AreNeighbours(int link, int later_link) const {
  if (later_link - link <= 1) return true;
  const auto& joint = arm().model().joints[static_cast<std::size_t>(later_link - 1)];
  return later_link - link == 2 && joint.X_ParentJoint.translation().isZero(1e-9);
}

void CollisionScene::ListPairs() {
  const int count = static_cast<int>(bodies_.size());
  for (int i = 0; i < count; ++i) {
    for (int k = i + 1; k < count; ++k) {
      const bool in_order = body(BodyId(i)).link <= body(BodyId(k)).link;
      const BodyPair pair =
          in_order ? BodyPair{BodyId(i), BodyId(k)} : BodyPair{BodyId(k), BodyId(i)};
      const int link = body(pair.first).link;
      const int later_link = body(pair.second).link;
      if (link == later_link) continue;
      if (k < arm_bodies_ && AreNeighbours(link, later_link)) continue;
      pairs_.push_back(pair);
    }
  }
}

bool CollisionScene::IsOfAnotherRobot(BodyId id) const {
  return others_begin_ <= id.index() && id.index() < others_end_;
}

bool CollisionScene::IsOfRobot(BodyId id) const {
  return IsOfArm(id) || (IsCarried(id) && body(id).identity.part.IsNone());
}

bool CollisionScene::IsCarried(BodyId id) const {
  return body(id).link == kFlange && id.index() >= arm_bodies_;
}

double CollisionScene::Separation(const BodyPair& pair, const LinkPoses& X_BaseLink,
                                  double enough) const {
  Slabs slabs;
  return Separation(pair, X_BaseLink, enough, slabs);
}

double CollisionScene::Separation(const BodyPair& pair, const LinkPoses& X_BaseLink, double enough,
                                  Slabs& slabs) const {
  const Body& a = body(pair.first);
  const Body& b = body(pair.second);
  const Pose& X_BaseA = X_BaseLink[a.link];
  const Pose& X_BaseB = X_BaseLink[b.link];
  const double apart = BallGap(X_BaseA, a.center, a.ball_radius, X_BaseB, b.center, b.ball_radius);
  if (apart >= enough) return apart;
  slabs.resize(a.hulls.size() * b.hulls.size(), Vector3::Zero());
  double least = enough;
  auto slab = slabs.begin();
  for (const RoundedHull& p : a.hulls) {
    for (const RoundedHull& q : b.hulls) {
      Vector3& last = *slab++;
      const double gap =
          BallGap(X_BaseA, p.center(), p.ball_radius(), X_BaseB, q.center(), q.ball_radius());
      if (gap >= least) continue;
      least = std::min(least, geometry::Separation(p, X_BaseA, q, X_BaseB, least, last));
      if (least == 0) return 0;
    }
  }
  return least;
}

Nearness CollisionScene::Nearest(const JointVector& q) const {
  const LinkPoses X_BaseLink = arm().LinkPoses(q);
  Nearness nearest{.distance = std::numeric_limits<double>::infinity()};
  for (const BodyPair& pair : pairs_) {
    const double distance = Separation(pair, X_BaseLink, nearest.distance);
    if (distance < nearest.distance) nearest = {pair, distance};
  }
  return nearest;
}

double CollisionScene::GreatestMotion(const BodyPair& pair, const JointVector& turn) const {
  const Body& b = body(pair.second);
  double motion = 0;
  for (int k = body(pair.first).link; k < b.link; ++k) motion += turn[k] * b.reach[k];
  return motion;
}

std::string CollisionScene::Describe(const BodyPair& pair) const {
  const auto text = [this](BodyId id) {
    const Body& described = body(id);
    return described.identity.part.IsNone() ? "the " + described.name : described.name;
  };
  return fmt::format("{} and {}", text(pair.second), text(pair.first));
}

}  // namespace assay::motion
