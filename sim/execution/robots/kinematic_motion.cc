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

// The bodies of each group may touch each other: what rests, the links of the arm, and the hand
// with the part that it holds.
constexpr int kRests = 0;
constexpr int kArm = 1;
constexpr int kHand = 2;

std::size_t IndexOf(mujoco::BodyId body) { return static_cast<std::size_t>(body.index()); }

}  // namespace

KinematicMotion::KinematicMotion(const scene::Scene& scene) : scene_(scene) {
  const mjModel& m = *scene.model().get();
  const int robot = m.body_rootid[scene.hand().index()];
  for (int body = 0; body < m.nbody; ++body) {
    const bool is_hand = scene.KindOf(mujoco::BodyId(body)) == scene::BodyKind::kHand;
    // The base of the arm stands on the floor, and touches it.
    const bool rests = m.body_rootid[body] != robot || m.body_weldid[body] == 0;
    groups_.push_back(rests ? kRests : is_hand ? kHand : kArm);
  }
}

void KinematicMotion::SeeForces(const mujoco::Data& data, PartId held) {
  is_firm_ = held.IsNone() || scene_.IsAttached(data, held) || IsFirm(scene_, data, held);
}

bool KinematicMotion::Begin(const mujoco::Data& data, PartId held, const RobotCommand& last) {
  if (!is_firm_) return false;
  if (!held_.IsNone()) groups_[IndexOf(scene_.Body(held_))] = kRests;
  if (!held.IsNone()) {
    groups_[IndexOf(scene_.Body(held))] = kHand;
    X_HandPart_ = data.BodyPose(scene_.hand()).inverse() * scene_.TruePose(data, held);
  }
  held_ = held;
  last_ = last;
  return !TouchesAnything(data) && IsQuiet(data);
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
  data.FindContacts(groups_);
  last_ = to;
}

bool KinematicMotion::MoveTo(const RobotCommand& next, double time, mujoco::Data& data) {
  const RobotCommand before = last_;
  Move(next, data);
  const bool is_clear = !TouchesAnything(data);
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
