#include "sim/execution/robots/kinematic_motion.h"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <span>

#include "sim/execution/robots/firm_grip.h"

namespace assay::execution {
namespace {

// Speeds in m/s and rad/s. A body that is slower rests.
struct RestSpeeds {
  double linear = 0;
  double angular = 0;

  bool Include(const scene::Twist& twist) const {
    return twist.linear.norm() < linear && twist.angular.norm() < angular;
  }
};

constexpr RestSpeeds kRest = {.linear = 1e-4, .angular = 1e-3};
// Speeds relative to the hand. The engine leaves out the centripetal acceleration of the hand and
// makes up for it a timestep later, so that parts in a fast hand seem to move.
constexpr RestSpeeds kRestInHand = {.linear = 2e-3, .angular = 2e-2};
// Held parts creep in the engine by up to 100 microradians a second, although friction bears them.
constexpr RestSpeeds kStandstill = {.linear = 1e-5, .angular = 2e-4};
constexpr double kFingersStand = 1e-4;  // m/s of the opening
// Where the robot may touch something, it is looked whether it does each time it may have moved by
// this length, metres. Contacts are found if they last longer.
constexpr double kShortestLook = 5e-4;

// The bodies of each group may touch each other: what rests, the links of the arm, and the hand
// with the part that it holds.
constexpr int kRests = 0;
constexpr int kArm = 1;
constexpr int kHand = 2;

std::size_t IndexOf(mujoco::BodyId body) { return static_cast<std::size_t>(body.index()); }

double Length(const mjtNum* vector) { return mju_norm3(vector); }

// Returns a length in metres that no point of the body's geoms exceeds from the body's origin.
double ReachOfBody(const mjModel& m, int body) {
  double reach = 0;
  for (int i = 0; i < m.body_geomnum[body]; ++i) {
    const int geom = m.body_geomadr[body] + i;
    reach = std::max(reach, Length(m.geom_pos + 3 * geom) + m.geom_rbound[geom]);
  }
  return reach;
}

}  // namespace

KinematicMotion::KinematicMotion(const scene::Scene& scene) : scene_(scene) {
  const mjModel& m = *scene.model().get();
  const int robot = m.body_rootid[scene.hand().index()];
  for (int body = 0; body < m.nbody; ++body) {
    const bool is_hand = scene.KindOf(mujoco::BodyId(body)) == scene::BodyKind::kHand;
    // The base of the arm stands on the floor, and touches it.
    const bool rests = m.body_rootid[body] != robot || m.body_weldid[body] == 0;
    groups_.push_back(rests ? kRests : is_hand ? kHand : kArm);
    if (rests) continue;
    links_.push_back({mujoco::BodyId(body), ReachOfBody(m, body)});
    length_ += Length(m.body_pos + 3 * body) + links_.back().reach;
  }
}

void KinematicMotion::SeeForces(const mujoco::Data& data, PartId held) {
  is_firm_ = held.IsNone() || scene_.IsAttached(data, held) || IsFirm(scene_, data, held);
}

bool KinematicMotion::Begin(const mujoco::Data& data, PartId held, const RobotCommand& last) {
  if (!is_firm_) return false;
  if (held != held_ || movers_.empty()) Take(held);
  if (!held.IsNone()) {
    X_HandPart_ = data.BodyPose(scene_.hand()).inverse() * scene_.TruePose(data, held);
  }
  last_ = last;
  room_ -= GreatestWay(data);
  const bool may_begin = !TouchesAnything(data) && IsQuiet(data);
  if (!may_begin) room_ = 0;
  return may_begin;
}

void KinematicMotion::Take(PartId held) {
  if (!held_.IsNone()) groups_[IndexOf(scene_.Body(held_))] = kRests;
  held_ = held;
  movers_ = links_;
  room_ = 0;
  if (held.IsNone()) return;
  const mujoco::BodyId body = scene_.Body(held);
  groups_[IndexOf(body)] = kHand;
  movers_.push_back({body, ReachOfBody(*scene_.model().get(), body.index())});
}

bool KinematicMotion::EverythingStands(const mujoco::Data& data) const {
  if (scene_.ArmVelocity(data).lpNorm<Eigen::Infinity>() > kStandstill.angular) return false;
  if (std::abs(scene_.OpeningSpeed(data)) > kFingersStand) return false;
  for (int i = 0; i < scene_.part_count(); ++i) {
    if (!kStandstill.Include(scene_.TrueTwist(data, PartId(i)))) return false;
  }
  return true;
}

// Returns whether the held part rests in the hand, and all other parts rest.
bool KinematicMotion::IsQuiet(const mujoco::Data& data) const {
  for (int i = 0; i < scene_.part_count(); ++i) {
    const PartId part(i);
    const scene::Twist twist = scene_.TrueTwist(data, part);
    if (part == held_) {
      const geometry::Vector3 at = scene_.TruePose(data, part).translation();
      const scene::Twist hand = scene_.TwistWithHand(data, at);
      if (!kRestInHand.Include({twist.linear - hand.linear, twist.angular - hand.angular})) {
        return false;
      }
    } else if (!kRest.Include(twist)) {
      return false;
    }
  }
  return true;
}

bool KinematicMotion::TouchesAnything(const mujoco::Data& data) const {
  const mjModel& m = *data.own_model();
  const std::span<const mjContact> contacts(data.get()->contact,
                                            static_cast<std::size_t>(data.get()->ncon));
  const auto group = [&](int geom) {
    return groups_[static_cast<std::size_t>(m.geom_bodyid[geom])];
  };
  return std::ranges::any_of(contacts, [&](const mjContact& contact) {
    return group(contact.geom1) != group(contact.geom2);
  });
}

void KinematicMotion::Move(const RobotCommand& to, mujoco::Data& data) {
  scene_.MoveFingers(data, to.opening - last_.opening);
  scene_.MoveArm(data, to.arm.q);
  if (!held_.IsNone()) {
    scene_.MovePart(data, held_, data.BodyPose(scene_.hand()) * X_HandPart_);
    data.MoveBodies();
  }
  last_ = to;
}

// The chord of a point's way is almost as long as the way between two states.
double KinematicMotion::GreatestWay(const mujoco::Data& data) {
  double greatest = 0;
  for (Mover& mover : movers_) {
    const geometry::Pose X = data.BodyPose(mover.body);
    const double turn = (X.linear() - mover.X_WorldBody.linear()).norm();
    const double shift = (X.translation() - mover.X_WorldBody.translation()).norm();
    greatest = std::max(greatest, shift + turn * mover.reach);
    mover.X_WorldBody = X;
  }
  return greatest;
}

// Half of the room is for a robot that becomes faster.
double KinematicMotion::MayGoOn(const RobotCommand& command) const {
  const double speed = length_ * command.arm.qd.lpNorm<1>() + std::abs(command.opening_rate);
  const double in_room = room_ > 0 && speed_ > 0 ? room_ / 2 / speed_ : 0;
  return std::max(kShortestLook / std::max(speed, 1e-9), in_room);
}

bool KinematicMotion::IsClear(mujoco::Data& data) {
  if (room_ > 0) {
    data.ForgetContacts();
    return true;
  }
  data.FindContacts(groups_);
  if (TouchesAnything(data)) return false;
  room_ = data.LeastSeparation(groups_);
  return true;
}

bool KinematicMotion::MoveTo(const RobotCommand& next, double time, mujoco::Data& data) {
  const RobotCommand before = last_;
  Move(next, data);
  const double way = GreatestWay(data);
  room_ -= way;
  speed_ = way / (time - data.time());
  const bool is_clear = IsClear(data);
  if (is_clear) {
    data.SetTime(time);
  } else {
    Move(before, data);
  }
  return is_clear;
}

void KinematicMotion::End(mujoco::Data& data) const {
  scene_.SetVelocity(data, last_.arm.qd, last_.opening_rate);
  if (!held_.IsNone()) {
    const geometry::Vector3 at = scene_.TruePose(data, held_).translation();
    scene_.SetPartTwist(data, held_, scene_.TwistWithHand(data, at));
  }
  data.Resume();
}

}  // namespace assay::execution
