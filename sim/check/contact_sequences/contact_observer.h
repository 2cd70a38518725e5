#pragma once

#include <map>
#include <string>
#include <vector>

#include "planner/finemotion/contacts/contact_finder.h"
#include "planner/finemotion/strategy_search/mating.h"
#include "sim/check/contact_sequences/contact_sequence.h"
#include "sim/scene/scene.h"

namespace assay::check {

using geometry::Pose;
using geometry::Vector3;

// A point at which the engine lets two parts press on each other.
struct ContactPoint {
  Vector3 at = Vector3::Zero();      // metres, in the fixed part's frame
  Vector3 normal = Vector3::Zero();  // unit vector from the fixed part to the held one
  double force = 0;                  // newtons, along the normal
};

// A primitive contact and the force that it bears.
struct ContactLoad {
  ContactKey contact;
  double force = 0;  // newtons, along the contact's normal
};

// Returns the primitive contacts that bear a point's force, with the share of each. `contacts` are
// the contacts at the true pose X_FixedTip, with their rows linearized there. A contact that
// touches at the point, with the point's normal, bears all of the force. Where features meet, at a
// corner or at an edge's end, several contacts are at one place, and no engine can distinguish
// them. If one of them is in `wanted`, it is taken, and otherwise the nearest one is taken. Where
// an edge or a face lies on another one, the engine may press anywhere between the contacts at its
// ends, which share the force by the law of the lever. The result is empty if the point belongs to
// no contact of the model.
std::vector<ContactLoad> LoadsOf(const ContactPoint& point,
                                 const std::vector<finemotion::PrimitiveContact>& contacts,
                                 const Pose& X_FixedTip, const PlannedContacts::Motion& wanted);

// The contacts of a trial over time, with counts of the engine's contact points.
struct ObservedContacts {
  std::vector<ContactSpan> spans = {};
  int points = 0;    // contact points of the engine, over all samples
  int unmapped = 0;  // points that belong to no contact of the model
  std::string first_unmapped = {};
};

// Observes which contacts a mating makes, from the engine's contact points (see
// execution::MotionObserver). Stiff parts that slide on each other do not press all the time: the
// engine lets them rebound by less than a micrometre, so most samples find no force. A contact
// therefore begins when a force presses on it, and lasts as long as its gap stays below kApart. The
// last slide in the hole, which follows the motions of the fine-motion plan, is not observed. All
// arguments of the constructor must outlive the observer.
class ContactObserver {
 public:
  static constexpr double kInterval = 0.002;   // seconds between samples
  static constexpr double kLeastForce = 0.05;  // newtons; the least force that counts as pressing
  static constexpr double kApart = 2e-5;       // metres; the slack that plans give kept contacts

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
  mujoco::Data scratch_;  // for forces, which the engine has after a forward pass only
  double next_ = 0;
  ContactSet touching_;  // at the last sample
  ObservedContacts seen_;
};

}  // namespace assay::check
