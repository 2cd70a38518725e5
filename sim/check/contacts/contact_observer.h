#pragma once

#include <map>
#include <string>
#include <vector>

#include "planner/finemotion/contacts/contact_finder.h"
#include "planner/finemotion/contacts/mating.h"
#include "sim/check/contacts/contact_sequence.h"
#include "sim/scene/scene.h"

namespace assay::check {

using geometry::Pose;
using geometry::Vector3;

// A point at which the engine lets two parts press on each other.
struct ContactPoint {
  Vector3 at = Vector3::Zero();      // fixed part's frame, metres
  Vector3 normal = Vector3::Zero();  // from the fixed part to the held one, unit
  double force = 0;                  // newtons, along the normal
};

// A force that a primitive contact bears.
struct ContactLoad {
  ContactKey contact;
  double force = 0;  // newtons, along its normal
};

// What bears a point's force, of the contacts of the true pose (their rows linearized there): what
// touches, with this normal. That is the contact at this point; where features meet, at a corner or
// at an edge's end, several are there and no engine tells them apart: then one that is wanted, and
// else the nearest. Where an edge or a face lies on another one, the engine may press anywhere
// between the contacts at its ends: they share the force as a lever would have it. Empty: the point
// is of no contact of the model.
std::vector<ContactLoad> LoadsOf(const ContactPoint& point,
                                 const std::vector<finemotion::PrimitiveContact>& contacts,
                                 const Pose& X_FixedTip, const PlannedContacts::Motion& wanted);

struct ObservedContacts {
  std::vector<ContactSpan> spans = {};
  int points = 0;    // of the engine, over all samples
  int unmapped = 0;  // of these: of no contact of the model
  std::string first_unmapped = {};
};

// Tells by the engine's contacts what touches in a mating (an exec::MotionObserver). Stiff parts
// that slide on each other do not press all the time: the engine lets them rebound by less than a
// micrometre, so that most samples find no force. A contact is made when it is pressed on, and
// lasts as long as its gap stays below kApart. The way on in the crevice is not looked at. All that
// it is given must outlive it.
class ContactObserver {
 public:
  static constexpr double kInterval = 0.002;   // seconds between samples
  static constexpr double kLeastForce = 0.05;  // newtons, that count as pressing
  static constexpr double kApart = 2e-5;       // metres; what planned contacts may be off, too

  ContactObserver(const scene::Scene& scene, const domain::Mating& mating,
                  const finemotion::MatingGeometry& geometry, const PlannedContacts& planned);

  void operator()(const mujoco::Data& data, int motion);
  const ObservedContacts& seen() const { return seen_; }

 private:
  std::vector<ContactPoint> PointsOf(const mujoco::Data& data);
  ContactSet ContactsOf(const mujoco::Data& data, int motion);
  std::map<ContactKey, double> ForcesOf(const std::vector<ContactPoint>& points,
                                        const std::vector<finemotion::PrimitiveContact>& contacts,
                                        const Pose& X_FixedTip, int motion);

  const scene::Scene& scene_;
  const domain::Mating& mating_;
  const finemotion::MatingGeometry& geometry_;
  const PlannedContacts& planned_;
  finemotion::ContactFinder finder_;
  mujoco::Data scratch_;  // forces of the present are to be had by a forward pass only
  double next_ = 0;
  ContactSet touching_;  // at the last sample
  ObservedContacts seen_;
};

}  // namespace assay::check
