#include "planner/motion/collision/pair_errors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "planner/geometry/pose.h"

namespace assay::motion {
namespace {

constexpr int kFirstOfWrist = 4;  // link of the arm: seen from the tool, only two joints move it

// Returns a turn about the axis through `origin`.
Pose TurnAbout(const Vector3& origin, const Vector3& axis, double angle) {
  Pose turn = Pose::Identity();
  turn.linear() = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
  turn.translation() = origin - turn.linear() * origin;
  return turn;
}

Vector3 UpInBase(const domain::Workcell& workcell) {
  return workcell.X_WorldBase().linear().transpose() * Vector3::UnitZ();
}

// Returns a bound on the distance of any point of the body from the axis through `origin`, a unit
// vector.
double DistanceFromAxis(const Body& body, const Pose& X_BaseBody, const Vector3& origin,
                        const Vector3& axis) {
  return (X_BaseBody * body.center - origin).cross(axis).norm() + body.ball_radius;
}

// Turns of a body about two axes through one point, unit vectors, by at most these angles.
struct BoundedTurns {
  Vector3 origin;
  std::array<Vector3, 2> axes = {Vector3::Zero(), Vector3::Zero()};
  std::array<double, 2> angles = {};
};

// Returns how far the hull reaches along the direction, a unit vector, with all turns. The first
// order of a turn moves a point across its lever. All higher orders are at most half the square of
// the angles times the lever.
double ReachAlong(const Vector3& direction, const RoundedHull& hull, const Pose& X_BaseHull,
                  const BoundedTurns& turns) {
  const Vector3 by_first = turns.angles[0] * turns.axes[0].cross(direction);
  const Vector3 by_second = turns.angles[1] * turns.axes[1].cross(direction);
  const double angle = turns.angles[0] + turns.angles[1];
  double greatest = -std::numeric_limits<double>::infinity();
  for (const Vector3& vertex : hull.vertices()) {
    const Vector3 p = X_BaseHull * vertex;
    const Vector3 lever = p - turns.origin;
    const double turned = std::abs(by_first.dot(lever)) + std::abs(by_second.dot(lever)) +
                          angle * angle / 2 * (lever.norm() + hull.radius());
    greatest = std::max(greatest, direction.dot(p) + turned);
  }
  return greatest + hull.radius() * (1 + angle);
}

}  // namespace

PairErrors::PairErrors(const CollisionScene& scene, const BodyPair& pair, const JointVector& sway,
                       const plan::ToolErrorBox& tool)
    : scene_(&scene), pair_(pair) {
  const Body& first = scene.body(pair.first);
  const Body& second = scene.body(pair.second);
  is_seen_from_tool_ = first.link == 0 && second.link >= kFirstOfWrist;
  shift_ = first.error.shift + second.error.shift;
  if (first.error.turn > 0) {
    greatest_[kPartTurn] = first.error.turn;
    reach_[kPartTurn] =
        DistanceFromAxis(first, Pose::Identity(), first.origin, UpInBase(scene.workcell()));
  }
  if (!is_seen_from_tool_) {
    for (int k = first.link; k < second.link; ++k) {
      greatest_[k] = sway[k];
      reach_[k] = second.reach[k];
    }
    return;
  }
  shift_ += tool.shift.norm();
  greatest_[kToolTurn] = tool.turn;
  greatest_[kToolSpin] = tool.spin;
  greatest_.segment(second.link, kToolTurn - second.link) = sway.tail(kToolTurn - second.link);
  ReachFromTool(second);
}

// Goes from the body outwards. Every axis beyond the body passes through a point whose distance
// from the body is bounded. If the last axes meet, this point is the same for all of them.
// Otherwise it is the origin of the axis, which is as far from the axis before it as the file says.
void PairErrors::ReachFromTool(const Body& body) {
  const kinematics::Arm& arm = scene_->arm();
  const Vector3 tool = scene_->workcell().gripper().X_FlangeTool().translation();
  if (arm.HasSphericalWrist()) {
    const LinkPoses X_BaseLink = arm.LinkPoses(JointVector::Zero());
    const Vector3 center = X_BaseLink.back() * arm.p_FlangeCenter();
    const double from_center =
        (X_BaseLink[body.link] * body.center - center).norm() + body.ball_radius;
    reach_.segment(body.link, kToolTurn - body.link).setConstant(from_center);
    reach_[kToolTurn] = reach_[kToolSpin] = from_center + (tool - arm.p_FlangeCenter()).norm();
    return;
  }
  double reach = body.center.norm() + body.ball_radius;
  for (int k = body.link; k < kToolTurn; ++k) {
    const Vector3 next =
        arm.model().joints[static_cast<std::size_t>(k)].X_ParentJoint.translation();
    reach = k == body.link ? (body.center - next).norm() + body.ball_radius : reach + next.norm();
    reach_[k] = reach;
  }
  reach_[kToolTurn] = reach_[kToolSpin] = reach + tool.norm();
}

// An error also moves points that other errors have already moved away from the error's axis. The
// last factor covers these longer levers.
double PairErrors::GreatestDisplacement() const {
  return greatest_.dot(reach_) * (1 + greatest_[kToolTurn] + greatest_[kToolSpin]);
}

// Applies two errors in this order: first the spin about the tool's axis, then the turn about the
// vertical. Both axes go through the tool's origin, so neither error moves the origin.
Pose PairErrors::FlangeWith(const ErrorVector& errors, const Pose& X_BaseFlange) const {
  const domain::Workcell& workcell = scene_->workcell();
  const Pose X_BaseTool = X_BaseFlange * workcell.gripper().X_FlangeTool();
  const Vector3 origin = X_BaseTool.translation();
  return TurnAbout(origin, UpInBase(workcell), errors[kToolTurn]) *
         TurnAbout(origin, X_BaseTool.linear().col(2), errors[kToolSpin]) * X_BaseFlange;
}

LinkPoses PairErrors::PosesWith(const ErrorVector& errors, const JointVector& q,
                                const LinkPoses& X_BaseLink) const {
  LinkPoses poses = scene_->arm().LinkPoses(q + errors.head<6>());
  if (is_seen_from_tool_) {
    const Pose X_Base = FlangeWith(errors, X_BaseLink.back()) * poses.back().inverse();
    for (auto X = poses.begin() + kFirstOfWrist; X != poses.end(); ++X) *X = X_Base * *X;
  }
  if (errors[kPartTurn] != 0) {
    const Body& first = scene_->body(pair_.first);
    poses[0] = TurnAbout(first.origin, UpInBase(scene_->workcell()), errors[kPartTurn]);
  }
  return poses;
}

// The errors move the body one after another: first the joints within the tool's frame, then the
// spin, then the turn about the vertical. Each error therefore has levers that the errors before it
// have made longer.
ErrorVector PairErrors::DisplacementIn(const ErrorVector& half, const LinkPoses& X_BaseLink) const {
  ErrorVector displacement = half.cwiseProduct(reach_);
  if (half[kToolTurn] == 0 && half[kToolSpin] == 0) return displacement;
  const domain::Workcell& workcell = scene_->workcell();
  const Pose X_BaseTool = X_BaseLink.back() * workcell.gripper().X_FlangeTool();
  const Body& second = scene_->body(pair_.second);
  const auto distance_from = [&](const Vector3& axis) {
    return DistanceFromAxis(second, X_BaseLink[second.link], X_BaseTool.translation(), axis);
  };
  const double by_joints = displacement.head<6>().sum();
  displacement[kToolSpin] =
      half[kToolSpin] * (distance_from(X_BaseTool.linear().col(2)) + by_joints);
  displacement[kToolTurn] =
      half[kToolTurn] * (distance_from(UpInBase(workcell)) + by_joints + displacement[kToolSpin]);
  return displacement;
}

double PairErrors::DistanceIn(const ErrorVector& half, const LinkPoses& X_BaseLink,
                              const CollisionScene::Slabs& slabs, double enough) const {
  const domain::Workcell& workcell = scene_->workcell();
  const Body& first = scene_->body(pair_.first);
  const Body& second = scene_->body(pair_.second);
  const Pose& X_BaseFirst = X_BaseLink[first.link];
  const Pose& X_BaseSecond = X_BaseLink[second.link];
  const Pose X_BaseTool = X_BaseLink.back() * workcell.gripper().X_FlangeTool();
  const Vector3 up = UpInBase(workcell);
  const BoundedTurns of_part = {first.origin, {up}, {half[kPartTurn]}};
  const BoundedTurns of_tool = {X_BaseTool.translation(),
                                {up, X_BaseTool.linear().col(2)},
                                {half[kToolTurn], half[kToolSpin]}};
  double least = enough;
  auto slab = slabs.begin();
  for (const RoundedHull& p : first.hulls) {
    for (const RoundedHull& q : second.hulls) {
      const Vector3& known = *slab++;
      const Vector3 between = X_BaseSecond * q.center() - X_BaseFirst * p.center();
      if (between.norm() - p.ball_radius() - q.ball_radius() >= enough) continue;
      const Vector3 direction =
          known.isZero(0) ? between.normalized() : Vector3(X_BaseFirst.linear() * known);
      least = std::min(least, -ReachAlong(direction, p, X_BaseFirst, of_part) -
                                  ReachAlong(-direction, q, X_BaseSecond, of_tool));
    }
  }
  const double by_joints = half.head<6>().dot(reach_.head<6>());
  return least - by_joints * (1 + half[kToolTurn] + half[kToolSpin]);
}

// Seen from the tool, only the joints between the tool and the body move the body. Errors also
// rotate the direction of this motion. A rotated vector differs from the vector by at most twice
// the vector's length.
double PairErrors::GreatestMotion(const JointVector& turn) const {
  const double motion = scene_->GreatestMotion(pair_, turn);
  if (!is_seen_from_tool_ || greatest_.isZero(0)) return motion;
  return motion + 2 * turn.dot(reach_.head<6>());
}

}  // namespace assay::motion
