#include "sim/check/contact_sequences/contact_observer.h"

#include <fmt/format.h>

#include <algorithm>

#include "planner/numeric/nonnegative_least_squares.h"
#include "sim/mujoco/contact.h"

namespace assay::check {
namespace {

using finemotion::PrimitiveContact;

// Parts that touch overlap by less than a micrometre. The engine's contact points are in the middle
// of the overlap.
constexpr double kTouching = 2e-5;  // metres of gap
constexpr double kNear = 1e-4;      // metres between the points
constexpr double kAlike = 0.99;     // cosine of the angle between the normals
constexpr double kReach = 2e-4;     // metres; contacts within this gap are considered
// The angle in radians by which a feature that lies on another one may have turned because it
// penetrates the other one.
constexpr double kSunkTurn = 2e-3;

// A primitive contact that may bear a point's force.
struct Candidate {
  ContactKey key;
  Vector3 at;           // position relative to the point
  double distance = 0;  // metres; reduced by kNear for wanted contacts
};

// Returns the candidates with the nearest first. If several are at one place, only the first is
// kept.
std::vector<Candidate> CandidatesFor(const ContactPoint& point,
                                     const std::vector<PrimitiveContact>& contacts,
                                     const Pose& X_FixedTip,
                                     const PlannedContacts::Motion& wanted) {
  std::vector<Candidate> all;
  for (const PrimitiveContact& contact : contacts) {
    if (std::abs(contact.offset) > kTouching || contact.normal.dot(point.normal) < kAlike) continue;
    const ContactKey key = finemotion::KeyOf(contact);
    const Vector3 at = X_FixedTip.translation() + contact.at - point.at;
    all.push_back({key, at, at.norm() - (wanted.Wants(key) ? kNear : 0)});
  }
  std::ranges::stable_sort(all, {}, &Candidate::distance);
  std::vector<Candidate> apart;
  for (const Candidate& candidate : all) {
    const auto is_near = [&](const Candidate& other) {
      return (other.at - candidate.at).norm() < kNear;
    };
    if (std::ranges::none_of(apart, is_near)) apart.push_back(candidate);
  }
  return apart;
}

// Returns nonnegative weights that add up to 1 and make the point the mean of the candidates'
// places.
Eigen::VectorXd Shares(const std::vector<Candidate>& candidates) {
  // An error in the sum of the weights counts as this many metres, which is more than parts are
  // long.
  constexpr double kSum = 1;
  Eigen::MatrixXd a(4, std::ssize(candidates));
  for (Eigen::Index i = 0; i < a.cols(); ++i)
    a.col(i) << candidates[static_cast<std::size_t>(i)].at, kSum;
  return numeric::NonnegativeLeastSquares(a, Eigen::Vector4d(0, 0, 0, kSum));
}

// Returns whether the contact exists with a gap of at most `most` metres, and lies past none of its
// ends by more than `most` metres.
bool StillTouches(const PrimitiveContact* contact, double most) {
  if (contact == nullptr || contact->offset > most) return false;
  return std::ranges::all_of(contact->limits, [&](const finemotion::HalfSpace& limit) {
    return limit.a.head<3>().isZero(0) || limit.b > -most;
  });
}

}  // namespace

std::vector<ContactLoad> LoadsOf(const ContactPoint& point,
                                 const std::vector<PrimitiveContact>& contacts,
                                 const Pose& X_FixedTip, const PlannedContacts::Motion& wanted) {
  const std::vector<Candidate> candidates = CandidatesFor(point, contacts, X_FixedTip, wanted);
  if (candidates.empty()) return {};
  if (candidates.front().at.norm() < kNear) return {{candidates.front().key, point.force}};
  const Eigen::VectorXd shares = Shares(candidates);
  Vector3 mean = Vector3::Zero();
  std::vector<ContactLoad> loads;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const double share = shares[static_cast<Eigen::Index>(i)];
    mean += share * candidates[i].at;
    if (share > 0) loads.push_back({candidates[i].key, share * point.force});
  }
  if (mean.norm() > kNear) return {};
  return loads;
}

ContactObserver::ContactObserver(const scene::Scene& scene, const domain::Mating& mating,
                                 const finemotion::MatingGeometry& geometry,
                                 const PlannedContacts& planned)
    : scene_(scene),
      mating_(mating),
      geometry_(geometry),
      planned_(planned),
      finder_(geometry.passage.moving, geometry.passage.stationary),
      scratch_(scene.model()) {}

void ContactObserver::operator()(const mujoco::Data& data, int motion) {
  if (motion >= std::ssize(planned_.motions)) return;
  const double time = data.time();
  if (time < next_ - data.timestep() / 2) return;
  next_ = time + kInterval;
  ContactSet contacts = ContactsOf(data, motion);
  if (!seen_.spans.empty()) seen_.spans.back().end = time;
  if (seen_.spans.empty() || seen_.spans.back().motion != motion ||
      seen_.spans.back().contacts != contacts) {
    seen_.spans.push_back({motion, time, next_, std::move(contacts)});
  } else {
    seen_.spans.back().end = next_;
  }
}

// Returns the present contact points that bear a force.
std::vector<ContactPoint> ContactObserver::PointsOf(const mujoco::Data& data) {
  const mujoco::BodyId fixed = scene_.Body(mating_.fixed);
  const mujoco::BodyId held = scene_.Body(mating_.held);
  if (mujoco::ContactsBetween(data, fixed, held).empty()) return {};
  scratch_.Restore(data.Save());
  const Pose X_FixedWorld = scene_.TruePose(data, mating_.fixed).inverse();
  std::vector<ContactPoint> points;
  for (const mujoco::Contact& contact : mujoco::ContactsBetween(scratch_, fixed, held)) {
    const double force = contact.force_on_b.dot(contact.normal);
    if (force < kLeastForce) continue;
    points.push_back(
        {X_FixedWorld * contact.position, X_FixedWorld.linear() * contact.normal, force});
  }
  return points;
}

ContactSet ContactObserver::ContactsOf(const mujoco::Data& data, int motion) {
  const std::vector<ContactPoint> points = PointsOf(data);
  if (points.empty() && touching_.empty()) return {};
  const Pose X_FixedTip = scene_.TruePose(data, mating_.fixed).inverse() *
                          scene_.TruePose(data, mating_.held) * geometry_.X_HeldTip;
  const std::vector<PrimitiveContact> contacts =
      finder_.Near(X_FixedTip, {.reach = kReach, .turn = kSunkTurn});
  ContactSet touching;
  for (const ContactKey& key : touching_) {
    if (StillTouches(finemotion::Find(contacts, key), kApart)) touching.push_back(key);
  }
  for (const auto& [key, force] : ForcesOf(points, contacts, X_FixedTip, motion)) {
    if (force >= kLeastForce) touching.push_back(key);
  }
  std::ranges::sort(touching);
  const auto rest = std::ranges::unique(touching);
  touching.erase(rest.begin(), rest.end());
  touching_ = touching;
  return touching;
}

std::map<ContactKey, double> ContactObserver::ForcesOf(
    const std::vector<ContactPoint>& points, const std::vector<PrimitiveContact>& contacts,
    const Pose& X_FixedTip, int motion) {
  const auto& wanted = planned_.motions[static_cast<std::size_t>(motion)];
  std::map<ContactKey, double> forces;
  for (const ContactPoint& point : points) {
    ++seen_.points;
    const std::vector<ContactLoad> loads = LoadsOf(point, contacts, X_FixedTip, wanted);
    for (const ContactLoad& load : loads) forces[load.contact] += load.force;
    if (!loads.empty() || seen_.unmapped++ > 0) continue;
    seen_.first_unmapped = fmt::format(
        "{:.1f} N at ({:.5f}, {:.5f}, {:.5f}), normal ({:.3f}, {:.3f}, {:.3f}), in motion {}",
        point.force, point.at.x(), point.at.y(), point.at.z(), point.normal.x(), point.normal.y(),
        point.normal.z(), motion + 1);
  }
  return forces;
}

}  // namespace assay::check
