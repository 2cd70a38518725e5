#include "planner/finemotion/maneuver.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

namespace assay::finemotion {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kAcross = 0.1;        // cosine, between a wall's normal and the way in
constexpr double kAgainst = 0.3;       // of the way in, that a contact must take back to oppose it
constexpr double kRoom = 0.6;          // of the play, that errors across it may take
constexpr double kLeast = 1e-6;        // metres and radians that are worth a motion
constexpr double kBlocked = 0.2;       // what contacts must leave of a direction
constexpr double kGrazing = 0.3;       // sine of an angle that is too small to feel a contact
constexpr double kCorrection = 2e-3;   // metres; more is no correction
constexpr double kLongest = 0.015;     // metres of a way that is checked as one motion
constexpr double kShortOfNext = 5e-4;  // metres from the next critical point, to be free there

constexpr double kUprightEnough = 0.02;  // radians

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

// What is touched first along a direction, and how far away.
struct Hit {
  const PrimitiveContact* contact = nullptr;
  double distance = kInfinity;
};

Hit FirstHit(const std::vector<PrimitiveContact>& contacts, const std::vector<ContactKey>& without,
             const PoseChange& direction) {
  Hit hit;
  for (const PrimitiveContact& contact : contacts) {
    const double rate = contact.row.head<kPoseDimensions>().dot(direction);
    if (rate > -1e-9 || IsOneOf(without, contact)) continue;
    const double distance = -contact.offset / rate;
    if (distance < 0 || distance >= hit.distance) continue;
    const bool inside = std::ranges::all_of(contact.limits, [&](const HalfSpace& limit) {
      return distance * limit.a.head<kPoseDimensions>().dot(direction) <= limit.b + 1e-9;
    });
    if (inside) hit = {&contact, distance};
  }
  return hit;
}

// A contact that is come upon at a small angle is felt late, and where it is felt is not certain.
bool IsGrazing(const PrimitiveContact& contact, const PoseChange& direction, double radius) {
  const double size = direction.head<3>().norm() + radius * direction.tail<3>().norm();
  return contact.row.head<kPoseDimensions>().dot(direction) > -kGrazing * size;
}

// d and w so that kept contacts neither close nor open: w as it is, d as little changed as can be.
std::optional<PoseChange> Complied(const std::vector<const PrimitiveContact*>& kept, Vector3 d,
                                   const Vector3& w) {
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
  PoseChange z;
  z.head<3>() = d;
  z.tail<3>() = w;
  return z;
}

// All that its strategy tells of: kept, waited for, and unwanted.
std::vector<PrimitiveContact> ContactsOf(const Command& command, const SegmentCheck& check,
                                         const std::vector<PrimitiveContact>& contacts) {
  std::vector<ContactKey> keys = command.kept;
  if (command.until) keys.push_back(*command.until);
  for (const Unwanted& unwanted : check.unwanted) keys.push_back(unwanted.contact);
  std::ranges::sort(keys);
  const auto rest = std::ranges::unique(keys);
  keys.erase(rest.begin(), rest.end());
  std::vector<PrimitiveContact> those;
  for (const PrimitiveContact* contact : Those(contacts, keys)) those.push_back(*contact);
  return those;
}

}  // namespace

// Per metre or radian of the amount.
struct Maneuvering::Direction {
  PoseChange along;
  double amount = 0;
  std::vector<ContactKey> kept;
};

Pose Passage::X_StationaryEntryAt(int i) const {
  if (i == 0) return X_StationaryEntry;
  return geometry::Translation(further[static_cast<std::size_t>(i) - 1] * mating) *
         X_StationaryEntry;
}

Maneuvering::Maneuvering(const Passage& passage, int critical_point, const ContactFinder& finder,
                         const Options& options)
    : passage_(passage),
      critical_point_(critical_point),
      X_StationaryEntry_(passage.X_StationaryEntryAt(critical_point)),
      options_(options),
      finder_(finder) {
  for (const PrimitiveContact& contact :
       finder_.Near(X_StationaryEntry_, {.reach = passage.depth, .turn = 0})) {
    if (contact.kind == ContactKind::kEdgeEdge) continue;
    if (std::abs(contact.normal.dot(passage.mating)) > kAcross) continue;
    walls_.push_back(contact);
    const bool known = std::ranges::any_of(
        laterals_, [&](const Vector3& n) { return n.dot(contact.normal) > 1 - kAcross; });
    if (!known) laterals_.push_back(contact.normal);
  }
}

std::vector<PrimitiveContact> Maneuvering::ContactsAt(const Pose& X) const {
  return finder_.Near(X, {.reach = options_.reach, .turn = options_.turn_error});
}

Situation Maneuvering::At(const Belief& belief) const {
  return {belief, ContactsAt(belief.X_StationaryMoving)};
}

Maneuvering::Nearby Maneuvering::OnTheWayTo(const Pose& end, double way) const {
  const ContactRange range = {.reach = options_.reach + way, .turn = options_.turn_error};
  return {finder_.Near(end, range), finder_.NearlyParallel(end, range)};
}

SegmentCheck Maneuvering::Checked(const Nearby& nearby, const Belief& belief,
                                  const Command& command, Margins margins) const {
  const SegmentModel model{nearby.contacts, options_.velocity_error, options_.radius, options_.test,
                           nearby.parallel};
  return Check(model, belief, command, margins == Margins::kAll);
}

Vector3 Maneuvering::ToUpright(const Pose& X_StationaryMoving) const {
  return Between(X_StationaryMoving, X_StationaryEntry_).tail<3>();
}

double Maneuvering::WayToNext(const Belief& belief) const {
  const Pose X_StationaryNext = passage_.X_StationaryEntryAt(critical_point_ + 1);
  const Vector3 way = X_StationaryNext.translation() - belief.X_StationaryMoving.translation();
  PoseChange down = PoseChange::Zero();
  down.head<3>() = passage_.mating;
  const double shift = (belief.errors.transpose() * down).lpNorm<1>();
  const double turn = belief.errors.bottomRows<3>().rowwise().lpNorm<1>().maxCoeff();
  const double deepest = shift + 2 * options_.radius * turn;
  return way.dot(passage_.mating) - deepest - kShortOfNext;
}

std::optional<Maneuvering::Direction> Maneuvering::DirectionOf(const Situation& situation,
                                                               const Maneuver& maneuver) const {
  const auto& [belief, contacts] = situation;
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
      d = X_StationaryEntry_.translation() - X.translation();
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
    case Maneuver::Kind::kAdvance:
      d = passage_.mating;
      direction.amount = WayToNext(belief);
      if (direction.amount < kLeast) return std::nullopt;
      break;
  }
  const auto kept = Those(contacts, direction.kept);
  if (kept.size() != direction.kept.size()) return std::nullopt;
  auto along = Complied(kept, d, w);
  if (!along) return std::nullopt;
  direction.along = std::move(*along);
  return direction;
}

// Where contacts that touch at the end do so to second order, too.
PoseChange Maneuvering::Refined(const Pose& X, const Command& command) const {
  const PoseChange& z = command.displacement;
  std::vector<ContactKey> touching = command.kept;
  if (command.until) touching.push_back(*command.until);
  if (touching.empty() || z.tail<3>().isZero(1e-9)) return z;
  Pose end = Displaced(X, z);
  for (int round = 0; round < 2; ++round) {
    const std::vector<PrimitiveContact> contacts = finder_.Of(touching, end, options_.turn_error);
    const auto those = Those(contacts, touching);
    if (those.size() != touching.size()) return z;
    const PoseChange closing = Closing(those, PoseChange::Zero(), options_.radius);
    if (closing.head<3>().norm() > kCorrection) return z;
    end = Displaced(end, closing);
  }
  return Between(X, end);
}

Maneuvered Maneuvering::Apply(const Situation& situation, const Maneuver& maneuver,
                              Margins margins) const {
  Maneuvered result{.after = situation.belief};
  const Situation* now = &situation;
  Situation later;
  double done = 0;
  while (true) {
    const Pose& X = now->belief.X_StationaryMoving;
    const auto direction = DirectionOf(*now, maneuver);
    if (!direction) return result;
    const bool anew = maneuver.kind == Maneuver::Kind::kUpright ||
                      maneuver.kind == Maneuver::Kind::kAdvance;  // what is left, each time
    const double left = direction->amount - (anew ? 0 : done);
    const double turn = direction->along.tail<3>().norm();
    const double most = std::min(left, turn > 0 ? kLinearTurn / turn : kLongest);
    const Hit hit = FirstHit(now->contacts, now->belief.kept, direction->along);
    const bool touches = hit.contact != nullptr && hit.distance <= most;
    if (touches && !maneuver.to_contact) return result;
    if (touches && IsGrazing(*hit.contact, direction->along, options_.radius)) return result;
    const double length = touches ? hit.distance : most;
    if (length < kLeast) return result;
    Command command{length * direction->along, direction->kept, {}};
    if (touches) command.until = KeyOf(*hit.contact);
    command.displacement = Refined(X, command);
    result.motions.push_back(Follow(now->belief, std::move(command), margins));
    const SegmentCheck& check = result.motions.back().check;
    done += length;
    if (!check.certain) return result;
    result.after = check.after;
    if (touches || left - length < kLeast) {
      result.certain = touches == maneuver.to_contact;
      return result;
    }
    later = At(result.after);
    now = &later;
  }
}

CertainMotion Maneuvering::Follow(const Belief& belief, Command command, Margins margins) const {
  const Pose end = Displaced(belief.X_StationaryMoving, command.displacement);
  Nearby nearby = OnTheWayTo(end, command.displacement.head<3>().norm());
  CertainMotion motion{std::move(command), belief.X_StationaryMoving, {}, {}};
  motion.check = Checked(nearby, belief, motion.command, margins);
  if (motion.check.certain) motion.X_StationaryAfter = motion.check.after.X_StationaryMoving;
  if (margins == Margins::kAll) {
    for (const ParallelEdges& edges : nearby.parallel) nearby.contacts.push_back(edges.contact);
    motion.contacts = ContactsOf(motion.command, motion.check, nearby.contacts);
  }
  return motion;
}

double Maneuvered::LeastScale() const {
  double least = kBeyondLadder;
  for (const CertainMotion& motion : motions) {
    for (const Unwanted& unwanted : motion.check.unwanted) least = std::min(least, unwanted.scale);
  }
  return least;
}

bool Maneuvering::IsReached(const Belief& belief) const {
  const Vector3& in = passage_.mating;
  const Pose& X = belief.X_StationaryMoving;
  double lowest = -kInfinity;
  for (const OuterVertex& vertex : passage_.moving.vertices)
    lowest = std::max(lowest, (X * vertex.p).dot(in));
  double highest = kInfinity;
  for (const OuterVertex& vertex : passage_.stationary.vertices)
    highest = std::min(highest, vertex.p.dot(in));
  const double way = lowest - highest;
  if (way <= 0) return true;
  PoseChange down = PoseChange::Zero();
  down.head<3>() = way * in;
  Belief outside = belief;
  outside.X_StationaryMoving = Displaced(X, -down);
  return Checked(OnTheWayTo(X, way), outside, {down, {}, {}}, Margins::kNone).certain;
}

bool Maneuvering::IsThrough(const Belief& belief) const {
  return ToUpright(belief.X_StationaryMoving).norm() < kUprightEnough &&
         WideDirections(belief) == 0 && ComesThrough(belief);
}

bool Maneuvering::ComesThrough(const Belief& belief) const {
  const Pose& X = belief.X_StationaryMoving;
  const Vector3 above = X_StationaryEntry_.translation() - X.translation();
  const double way = passage_.depth + above.dot(passage_.mating);
  if (way <= 0) return true;
  PoseChange in = PoseChange::Zero();
  in.head<3>() = way * passage_.mating;
  Nearby nearby = OnTheWayTo(Displaced(X, in), way);
  std::erase_if(nearby.contacts, [&](const PrimitiveContact& contact) {
    return contact.row.head<3>().dot(in.head<3>()) > -kAgainst * way;
  });
  const Belief free{X, belief.errors, {}, belief.tolerances};
  return Checked(nearby, free, {in, {}, {}}, Margins::kNone).certain;
}

int Maneuvering::WideDirections(const Belief& belief) const {
  Eigen::MatrixXd basis(kPoseDimensions, kPoseDimensions);
  Eigen::Index count = 0;
  for (const PrimitiveContact& wall : walls_) {
    if (ErrorOf(wall.row, belief) <= kRoom * wall.offset) continue;
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
