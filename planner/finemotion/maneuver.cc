#include "planner/finemotion/maneuver.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

namespace assay::finemotion {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kAcross = 0.1;       // cosine, between a wall's normal and the way in
constexpr double kAgainst = 0.3;      // of the way in, that a contact must take back to oppose it
constexpr double kStep = 0.045;       // radians that one linearization is good for
constexpr double kBefore = 0.9;       // of the way to a contact that must not be made
constexpr double kRoom = 0.6;         // of the play, that errors across it may take
constexpr double kLeast = 1e-6;       // metres and radians that are worth a motion
constexpr double kBlocked = 0.2;      // what contacts must leave of a direction
constexpr double kCorrection = 2e-3;  // metres; more is no correction

bool IsOneOf(const std::vector<ContactKey>& keys, const PrimitiveContact& contact) {
  return std::ranges::find(keys, KeyOf(contact)) != keys.end();
}

std::vector<const PrimitiveContact*> Those(const std::vector<PrimitiveContact>& contacts,
                                           const std::vector<ContactKey>& keys) {
  std::vector<const PrimitiveContact*> those;
  for (const ContactKey& key : keys) {
    if (const PrimitiveContact* contact = Find(contacts, key)) those.push_back(contact);
  }
  return those;
}

Vector3 RotationBetween(const Pose& from, const Pose& to) {
  const Eigen::AngleAxisd turn(Eigen::Matrix3d(to.linear() * from.linear().transpose()));
  return turn.angle() * turn.axis();
}

GeneralizedPoint Between(const Pose& from, const Pose& to, Eigen::Index dimensions) {
  GeneralizedPoint z = GeneralizedPoint::Zero(dimensions);
  z.head<3>() = to.translation() - from.translation();
  z.segment<3>(3) = RotationBetween(from, to);
  return z;
}

// What is touched first along a direction, and how far away.
struct Hit {
  const PrimitiveContact* contact = nullptr;
  double distance = kInfinity;
};

Hit FirstHit(const std::vector<PrimitiveContact>& contacts, const std::vector<ContactKey>& without,
             const GeneralizedPoint& direction) {
  Hit hit;
  for (const PrimitiveContact& contact : contacts) {
    const double rate = contact.row.dot(direction);
    if (rate > -1e-9 || IsOneOf(without, contact)) continue;
    const double distance = -contact.offset / rate;
    if (distance < 0 || distance >= hit.distance) continue;
    const bool inside = std::ranges::all_of(contact.limits, [&](const HalfSpace& limit) {
      return distance * limit.a.dot(direction) <= limit.b + 1e-9;
    });
    if (inside) hit = {&contact, distance};
  }
  return hit;
}

// d and w so that kept contacts neither close nor open: w as it is, d as little changed as can be.
std::optional<GeneralizedPoint> Complied(const std::vector<const PrimitiveContact*>& kept,
                                         Vector3 d, const Vector3& w, Eigen::Index dimensions) {
  if (!kept.empty()) {
    Eigen::MatrixX3d normals(std::ssize(kept), 3);
    Eigen::VectorXd rates(std::ssize(kept));
    for (Eigen::Index i = 0; i < rates.size(); ++i) {
      const PrimitiveContact& contact = *kept[static_cast<std::size_t>(i)];
      normals.row(i) = contact.normal;
      rates[i] = contact.normal.dot(d) + contact.row.segment<3>(3).dot(w);
    }
    const Vector3 change = normals.completeOrthogonalDecomposition().solve(-rates);
    if ((normals * change + rates).norm() > 1e-9) return std::nullopt;
    d += change;
  }
  if (w.isZero(1e-12) && d.norm() < kBlocked) return std::nullopt;
  GeneralizedPoint z = GeneralizedPoint::Zero(dimensions);
  z.head<3>() = d;
  z.segment<3>(3) = w;
  return z;
}

std::vector<PrimitiveContact> ContactsOf(const Command& command,
                                         const std::vector<PrimitiveContact>& contacts) {
  std::vector<ContactKey> keys = command.kept;
  if (command.until) keys.push_back(*command.until);
  std::vector<PrimitiveContact> those;
  for (const PrimitiveContact* contact : Those(contacts, keys)) those.push_back(*contact);
  return those;
}

double LeastScale(const SegmentCheck& check) {
  return check.unwanted.empty() ? kBeyondLadder : check.unwanted.front().scale;
}

}  // namespace

// Per metre or radian of the amount.
struct Maneuvering::Direction {
  GeneralizedPoint along;
  double amount = 0;
  std::vector<ContactKey> kept;
};

Maneuvering::Maneuvering(const Passage& passage, const Options& options)
    : passage_(passage), options_(options) {
  for (const PrimitiveContact& contact : PrimitiveContacts(
           passage.moving, passage.stationary, passage.X_StationaryEntry, passage.depth)) {
    if (contact.kind == ContactKind::kEdgeEdge) continue;
    if (std::abs(contact.normal.dot(passage.mating)) > kAcross) continue;
    walls_.push_back(contact);
    const bool known = std::ranges::any_of(
        laterals_, [&](const Vector3& n) { return n.dot(contact.normal) > 1 - kAcross; });
    if (!known) laterals_.push_back(contact.normal);
  }
}

std::vector<PrimitiveContact> Maneuvering::ContactsAt(const Pose& X) const {
  return PrimitiveContacts(passage_.moving, passage_.stationary, X, options_.reach, {},
                           options_.turn_error);
}

Vector3 Maneuvering::ToUpright(const Pose& X_StationaryMoving) const {
  return RotationBetween(X_StationaryMoving, passage_.X_StationaryEntry);
}

std::optional<Maneuvering::Direction> Maneuvering::DirectionOf(
    const Belief& belief, const Maneuver& maneuver,
    const std::vector<PrimitiveContact>& contacts) const {
  Vector3 d = Vector3::Zero();
  Vector3 w = Vector3::Zero();
  Direction direction{.along = {}, .amount = maneuver.amount, .kept = belief.kept};
  const Pose& X = belief.X_StationaryMoving;
  switch (maneuver.kind) {
    case Maneuver::Kind::kMove:
      d = maneuver.direction;
      break;
    case Maneuver::Kind::kTurn:
      w = maneuver.direction;
      break;
    case Maneuver::Kind::kLetGo: {
      std::erase(direction.kept, maneuver.contact);
      const PrimitiveContact* contact = Find(contacts, maneuver.contact);
      if (contact == nullptr || direction.kept.size() == belief.kept.size()) return std::nullopt;
      d = contact->normal;
      break;
    }
    case Maneuver::Kind::kCenter: {
      d = passage_.X_StationaryEntry.translation() - X.translation();
      d -= d.dot(passage_.mating) * passage_.mating;
      direction.amount = d.norm();
      if (direction.amount < kLeast) return std::nullopt;
      d /= direction.amount;
      std::erase_if(direction.kept, [&](const ContactKey& key) {
        const PrimitiveContact* contact = Find(contacts, key);
        return contact != nullptr && contact->normal.dot(d) > 1e-9;
      });
      break;
    }
    case Maneuver::Kind::kUpright:
      w = ToUpright(X);
      direction.amount = w.norm();
      if (direction.amount < kLeast) return std::nullopt;
      w /= direction.amount;
      break;
  }
  const auto kept = Those(contacts, direction.kept);
  if (kept.size() != direction.kept.size()) return std::nullopt;
  auto along = Complied(kept, d, w, belief.errors.rows());
  if (!along) return std::nullopt;
  direction.along = std::move(*along);
  return direction;
}

// Where contacts that touch at the end do so to second order, too.
GeneralizedPoint Maneuvering::Refined(const Pose& X, const Command& command) const {
  const GeneralizedPoint& z = command.displacement;
  std::vector<ContactKey> touching = command.kept;
  if (command.until) touching.push_back(*command.until);
  if (touching.empty() || z.segment<3>(3).isZero(1e-9)) return z;
  Pose end = Displaced(X, z);
  for (int round = 0; round < 2; ++round) {
    const std::vector<PrimitiveContact> contacts = ContactsAt(end);
    const auto those = Those(contacts, touching);
    if (those.size() != touching.size()) return z;
    const GeneralizedPoint closing =
        Closing(those, GeneralizedPoint::Zero(z.size()), options_.radius);
    if (closing.head<3>().norm() > kCorrection) return z;
    end = Displaced(end, closing);
  }
  return Between(X, end, z.size());
}

Maneuvered Maneuvering::Apply(const Belief& belief, const Maneuver& maneuver, bool margins) const {
  Maneuvered result{.after = belief};
  double done = 0;
  while (true) {
    const std::vector<PrimitiveContact> contacts = ContactsAt(result.after.X_StationaryMoving);
    const auto direction = DirectionOf(result.after, maneuver, contacts);
    if (!direction) return result;
    const bool anew = maneuver.kind == Maneuver::Kind::kUpright;  // what is left, each time
    const double left = direction->amount - (anew ? 0 : done);
    const double turn = direction->along.segment<3>(3).norm();
    const double most = turn > 0 ? std::min(left, kStep / turn) : left;
    const Hit hit = FirstHit(contacts, result.after.kept, direction->along);
    const bool touches = hit.contact != nullptr && hit.distance <= most;
    if (touches && !maneuver.to_contact && hit.distance < most / kBefore) return result;
    const double length = touches ? hit.distance : most;
    if (length < kLeast) return result;
    Command command{length * direction->along, direction->kept, {}};
    if (touches) command.until = KeyOf(*hit.contact);
    command.displacement = Refined(result.after.X_StationaryMoving, command);
    const std::vector<PrimitiveContact> at_end =
        ContactsAt(Displaced(result.after.X_StationaryMoving, command.displacement));
    const SegmentModel model{at_end, options_.velocity_error, options_.radius};
    SegmentCheck check = Check(model, result.after, command, false);
    if (check.certain && margins) check = Check(model, result.after, command, true);
    result.least_scale = std::min(result.least_scale, LeastScale(check));
    const bool certain = check.certain;
    if (certain) result.after = check.after;
    result.motions.push_back(
        {command, result.after.X_StationaryMoving, std::move(check), ContactsOf(command, at_end)});
    done += length;
    if (!certain) return result;
    const bool complete = touches || left - length < kLeast;
    if (!complete) continue;
    result.certain = touches == maneuver.to_contact;
    return result;
  }
}

bool Maneuvering::ComesThrough(const Belief& belief) const {
  const Pose& X = belief.X_StationaryMoving;
  const Vector3 above = passage_.X_StationaryEntry.translation() - X.translation();
  const double way = passage_.depth + above.dot(passage_.mating);
  if (way <= 0) return true;
  GeneralizedPoint in = GeneralizedPoint::Zero(belief.errors.rows());
  in.head<3>() = way * passage_.mating;
  const Pose end = Displaced(X, in);
  std::vector<PrimitiveContact> opposing = PrimitiveContacts(
      passage_.moving, passage_.stationary, end, options_.reach + way, {}, options_.turn_error);
  std::erase_if(opposing, [&](const PrimitiveContact& contact) {
    return contact.row.dot(in) > -kAgainst * way;
  });
  const Belief free{X, belief.errors, {}};
  return Check({opposing, options_.velocity_error, options_.radius}, free, {in, {}, {}}, false)
      .certain;
}

int Maneuvering::WideDirections(const Belief& belief) const {
  Eigen::MatrixXd basis(kPoseDimensions, kPoseDimensions);
  Eigen::Index count = 0;
  for (const PrimitiveContact& wall : walls_) {
    if ((belief.errors.transpose() * wall.row).lpNorm<1>() <= kRoom * wall.offset) continue;
    Eigen::VectorXd row = wall.row.head<kPoseDimensions>();
    row.tail<3>() /= options_.radius;
    for (int pass = 0; pass < 2; ++pass) {
      row -= basis.leftCols(count) * (basis.leftCols(count).transpose() * row);
    }
    if (row.norm() > 1e-6) basis.col(count++) = row.normalized();
  }
  return static_cast<int>(count);
}

}  // namespace assay::finemotion
