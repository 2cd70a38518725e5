#include "sim/execution/robots/firm_grip.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace assay::execution {
namespace {

using geometry::Vector3;
using mujoco::Contact;
using Contacts = std::vector<Contact>;

// The share that a firm grip may use of the friction, and of the way from the middle of the area
// that touches to its border.
constexpr double kShare = 0.5;
constexpr double kLine = 1e-4;  // metres; the area that touches is a line if it is narrower

double PressureOf(const Contact& contact) { return contact.force_on_b.dot(contact.normal); }

// The load on the friction of some contacts in the plane of the pads.
struct FrictionLoad {
  Vector3 force = Vector3::Zero();  // newtons
  double torque = 0;                // about the normal through the centre, N m
  double most_force = 0;            // the force that friction can bear, newtons
  double most_torque = 0;           // the torque that friction can bear, N m

  // Forces and torques that friction bears together are a convex set, so it holds the line between
  // the greatest force and the greatest torque. A single point bears no torque and is never light.
  bool IsLight() const {
    return force.norm() * most_torque + std::abs(torque) * most_force <
           kShare * most_force * most_torque;
  }
};

Vector3 CenterOf(const Contacts& contacts) {
  Vector3 moment = Vector3::Zero();
  double pressure = 0;
  for (const Contact& contact : contacts) {
    moment += PressureOf(contact) * contact.position;
    pressure += PressureOf(contact);
  }
  return moment / pressure;
}

FrictionLoad LoadOf(const Contacts& contacts, const Vector3& normal) {
  const Vector3 center = CenterOf(contacts);
  FrictionLoad load;
  for (const Contact& contact : contacts) {
    const Vector3 lever = contact.position - center;
    const double friction = contact.friction * PressureOf(contact);
    load.force += contact.force_on_b - normal.dot(contact.force_on_b) * normal;
    load.torque += lever.cross(contact.force_on_b).dot(normal);
    load.most_force += friction;
    load.most_torque += friction * lever.cross(normal).norm();
  }
  return load;
}

// Where a pad touches along an axis of its plane, metres.
struct Extent {
  double least = INFINITY;
  double greatest = -INFINITY;
  double center = 0;  // of pressure

  double length() const { return greatest - least; }
  bool HasCenterInMiddle() const {
    return std::abs(center - (least + greatest) / 2) <= std::max(kLine, kShare * length() / 2);
  }
};

Extent ExtentAlong(const Vector3& axis, const Contacts& contacts) {
  Extent extent{.center = CenterOf(contacts).dot(axis)};
  for (const Contact& contact : contacts) {
    extent.least = std::min(extent.least, contact.position.dot(axis));
    extent.greatest = std::max(extent.greatest, contact.position.dot(axis));
  }
  return extent;
}

// Returns the direction from the pressure's centre to the farthest contact.
Vector3 LongAxisOf(const Contacts& contacts) {
  const Vector3 center = CenterOf(contacts);
  Vector3 farthest = Vector3::Zero();
  for (const Contact& contact : contacts) {
    const Vector3 lever = contact.position - center;
    if (lever.norm() > farthest.norm()) farthest = lever;
  }
  return farthest.normalized();
}

// A part that touches a pad along a line rolls on the pad, unless friction keeps it from that.
bool IsFirmOn(const Contacts& pad, const Vector3& normal) {
  const Vector3 axis = LongAxisOf(pad);
  const Extent along = ExtentAlong(axis, pad);
  const Extent across = ExtentAlong(normal.cross(axis), pad);
  const bool is_line = across.length() < kLine;
  return along.HasCenterInMiddle() && across.HasCenterInMiddle() &&
         (!is_line || LoadOf(pad, normal).IsLight());
}

}  // namespace

bool IsFirm(const scene::Scene& scene, const mujoco::Data& data, domain::PartId part) {
  const Contacts left = ContactsBetween(data, scene.left_finger(), scene.Body(part));
  const Contacts right = ContactsBetween(data, scene.right_finger(), scene.Body(part));
  if (left.empty() || right.empty()) return false;
  const Vector3 normal = left.front().normal;
  Contacts both = left;
  both.insert(both.end(), right.begin(), right.end());
  return LoadOf(both, normal).IsLight() && IsFirmOn(left, normal) && IsFirmOn(right, normal);
}

}  // namespace assay::execution
