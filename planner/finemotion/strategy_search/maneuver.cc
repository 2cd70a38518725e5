#include "planner/finemotion/strategy_search/maneuver.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "planner/finemotion/motions/row_range.h"
#include "planner/numeric/orthogonal_decomposition.h"

namespace assay::finemotion {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// A contact opposes a motion along the way in if it takes back at least this fraction of the
// motion.
constexpr double kAgainst = 0.3;
constexpr double kRoom = 0.6;          // fraction of the play that errors across it may take
constexpr double kLeastMotion = 1e-6;  // metres and radians; less is not worth a motion
// The least length that a unit direction may have after it is corrected to comply with the kept
// contacts. A shorter one means that the contacts block the motion.
constexpr double kBlocked = 0.2;
constexpr double kGrazing = 0.3;          // sine of an angle at which a contact is felt too late
constexpr double kCorrection = 2e-3;      // metres; more is not a correction
constexpr double kLongestMotion = 0.015;  // metres of the way that are checked as one motion
// The longest way along round contacts, in metres, that is checked as one motion. It is short,
// because the normals of such contacts turn as the part moves.
constexpr double kLongestRoundMotion = 0.002;
// A way ends this many metres before the next critical point, so that the part is free there.
constexpr double kShortOfNext = 5e-4;
constexpr double kUprightEnough = 0.02;  // radians from upright that count as upright

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

// The first contact made along a direction, and its distance.
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

// Returns whether the motion meets the contact at a small angle. The contact is then felt late, and
// at an uncertain place.
bool IsGrazing(const PrimitiveContact& contact, const PoseChange& direction, double radius) {
  const double size = direction.head<3>().norm() + radius * direction.tail<3>().norm();
  return contact.row.head<kPoseDimensions>().dot(direction) > -kGrazing * size;
}

bool HasRound(const std::vector<ContactKey>& keys) {
  return std::ranges::any_of(keys, [](const ContactKey& key) { return IsRound(key.kind); });
}

// Returns the least displacement that closes the contacts to first order.
PoseChange ClosingMove(const std::vector<const PrimitiveContact*>& contacts) {
  Eigen::MatrixXd normals(std::ssize(contacts), 3);
  Eigen::VectorXd gaps(normals.rows());
  for (Eigen::Index i = 0; i < gaps.size(); ++i) {
    normals.row(i) = contacts[static_cast<std::size_t>(i)]->normal;
    gaps[i] = contacts[static_cast<std::size_t>(i)]->offset;
  }
  PoseChange closing = PoseChange::Zero();
  closing.head<3>() = numeric::ShortestLeastSquares(normals, -gaps);
  return closing;
}

// Returns (d, w) changed so that kept contacts neither close nor open: w stays, and d changes as
// little as possible. Returns none if there is no such motion, or if the changed d is too short and
// w is zero.
std::optional<PoseChange> Complied(const std::vector<const PrimitiveContact*>& kept, Vector3 d,
                                   const Vector3& w) {
  if (!kept.empty()) {
    Eigen::MatrixXd normals(std::ssize(kept), 3);
    Eigen::VectorXd rates(std::ssize(kept));
    for (Eigen::Index i = 0; i < rates.size(); ++i) {
      const PrimitiveContact& contact = *kept[static_cast<std::size_t>(i)];
      normals.row(i) = contact.normal;
      rates[i] = contact.normal.dot(d) + contact.row.segment<3>(3).dot(w);
    }
    const Vector3 change = numeric::ShortestLeastSquares(normals, -rates);
    if ((normals * change + rates).norm() > 1e-9) return std::nullopt;
    d += change;
  }
  if (w.isZero(1e-12) && d.norm() < kBlocked) return std::nullopt;
  PoseChange z;
  z.head<3>() = d;
  z.tail<3>() = w;
  return z;
}

// Removes the contacts that a motion along d opens.
void LetGo(std::vector<ContactKey>& kept, const std::vector<PrimitiveContact>& contacts,
           const Vector3& d) {
  std::erase_if(kept, [&](const ContactKey& key) {
    const PrimitiveContact* contact = Find(contacts, key);
    return contact != nullptr && contact->normal.dot(d) > 1e-9;
  });
}

}  // namespace

// A direction of motion: the change of the pose for one metre or radian of `amount`, and the
// contacts that stay closed.
struct Maneuvering::Direction {
  PoseChange along;
  double amount = 0;
  std::vector<ContactKey> kept;
};

int PointAfter(const Maneuver& maneuver, int critical_point) {
  return maneuver.kind == Maneuver::Kind::kAdvance ? critical_point + 1 : critical_point;
}

Maneuvering::Maneuvering(const Passage& passage, int critical_point, const MotionChecker& checker,
                         double reach)
    : passage_(passage),
      critical_point_(critical_point),
      X_StationaryEntry_(passage.X_StationaryEntryAt(critical_point)),
      checker_(checker),
      reach_(reach),
      walls_(WallsAt(passage, critical_point, checker.finder())) {
  for (const PrimitiveContact& wall : walls_) {
    const bool known = std::ranges::any_of(
        laterals_, [&](const Vector3& n) { return n.dot(wall.normal) > 1 - kAcross; });
    if (!known) laterals_.push_back(wall.normal);
  }
}

Situation Maneuvering::At(const BelievedPose& believed) const {
  return {believed, checker_.ContactsWithin(reach_, believed.X_StationaryMoving)};
}

Vector3 Maneuvering::ToUpright(const Pose& X_StationaryMoving) const {
  return Between(X_StationaryMoving, X_StationaryEntry_).tail<3>();
}

double Maneuvering::WayToNext(const BelievedPose& believed) const {
  const bool is_last = critical_point_ + 1 == passage_.critical_points();
  const Vector3 next =
      is_last ? Vector3(X_StationaryEntry_.translation() + passage_.seat * passage_.mating)
              : Vector3(passage_.X_StationaryEntryAt(critical_point_ + 1).translation());
  const Vector3 way = next - believed.X_StationaryMoving.translation();
  PoseChange down = PoseChange::Zero();
  down.head<3>() = passage_.mating;
  const double shift = (believed.errors.transpose() * down).lpNorm<1>();
  const double turn = believed.errors.bottomRows<3>().rowwise().lpNorm<1>().maxCoeff();
  const double lever = is_last ? Breadth() : 2 * checker_.options().radius;
  const double deepest = shift + lever * turn;
  return way.dot(passage_.mating) - deepest - kShortOfNext;
}

double Maneuvering::Breadth() const {
  double breadth = 0;
  for (const OuterVertex& vertex : passage_.moving.vertices)
    breadth = std::max(breadth, vertex.p.cross(passage_.mating).norm());
  return breadth;
}

std::optional<Maneuvering::Direction> Maneuvering::DirectionOf(const Situation& situation,
                                                               const Maneuver& maneuver) const {
  const auto& [believed, contacts] = situation;
  Vector3 d = Vector3::Zero();
  Vector3 w = Vector3::Zero();
  Direction direction{.along = {}, .amount = maneuver.amount, .kept = believed.kept};
  const Pose& X = believed.X_StationaryMoving;
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
      if (contact == nullptr || direction.kept.size() == believed.kept.size()) return std::nullopt;
      d = contact->normal;
      break;
    }
    case Maneuver::Kind::kCenter: {
      d = X_StationaryEntry_.translation() - X.translation();
      d -= d.dot(passage_.mating) * passage_.mating;
      direction.amount = d.norm();
      if (direction.amount < kLeastMotion) return std::nullopt;
      d /= direction.amount;
      LetGo(direction.kept, contacts, d);
      break;
    }
    case Maneuver::Kind::kUpright:
      w = ToUpright(X);
      direction.amount = w.norm();
      if (direction.amount < kLeastMotion) return std::nullopt;
      w /= direction.amount;
      break;
    case Maneuver::Kind::kAdvance:
      d = passage_.mating;
      direction.amount = WayToNext(believed);
      if (direction.amount < kLeastMotion) return std::nullopt;
      break;
  }
  const auto kept = Those(contacts, direction.kept);
  if (kept.size() != direction.kept.size()) return std::nullopt;
  auto along = Complied(kept, d, w);
  if (!along) return std::nullopt;
  direction.along = std::move(*along);
  return direction;
}

// Returns the displacement changed so that the contacts touch at its end to second order as well.
// Without a turn, only the gaps of round contacts are of second order.
PoseChange Maneuvering::Refined(const Pose& X, const Command& command) const {
  const PoseChange& z = command.displacement;
  std::vector<ContactKey> touching = command.kept;
  if (command.until) touching.push_back(*command.until);
  const bool turns = !z.tail<3>().isZero(1e-9);
  if (touching.empty() || (!turns && !HasRound(touching))) return z;
  Pose end = Displaced(X, z);
  for (int round = 0; round < (turns ? 2 : 4); ++round) {
    const std::vector<PrimitiveContact> contacts = checker_.Of(touching, end);
    const auto those = Those(contacts, touching);
    if (those.size() != touching.size()) return z;
    const PoseChange closing =
        turns ? Closing(those, PoseChange::Zero(), checker_.options().radius) : ClosingMove(those);
    if (closing.head<3>().norm() > kCorrection) return z;
    end = Displaced(end, closing);
  }
  return Between(X, end);
}

Maneuvered Maneuvering::Apply(const Situation& situation, const Maneuver& maneuver,
                              Margins margins) const {
  Maneuvered result{.after = situation.believed};
  const Situation* now = &situation;
  Situation later;
  double done = 0;
  while (true) {
    const Pose& X = now->believed.X_StationaryMoving;
    const auto direction = DirectionOf(*now, maneuver);
    if (!direction) return result;
    // For these maneuvers, DirectionOf computes the remaining motion again.
    const bool anew =
        maneuver.kind == Maneuver::Kind::kUpright || maneuver.kind == Maneuver::Kind::kAdvance;
    const double left = direction->amount - (anew ? 0 : done);
    const double turn = direction->along.tail<3>().norm();
    const double longest = HasRound(direction->kept) ? kLongestRoundMotion : kLongestMotion;
    const double most = std::min(left, turn > 0 ? kLinearTurn / turn : longest);
    const Hit hit = FirstHit(now->contacts, now->believed.kept, direction->along);
    const bool touches = hit.contact != nullptr && hit.distance <= most;
    if (touches && !maneuver.to_contact) return result;
    if (touches && IsGrazing(*hit.contact, direction->along, checker_.options().radius))
      return result;
    const double length = touches ? hit.distance : most;
    if (length < kLeastMotion) return result;
    Command command{length * direction->along, direction->kept, {}};
    if (touches) command.until = KeyOf(*hit.contact);
    command.displacement = Refined(X, command);
    result.motions.push_back(checker_.Check(now->believed, command, margins));
    const SegmentCheck& check = result.motions.back().check;
    done += length;
    if (!check.certain) return result;
    result.after = check.after;
    if (touches || left - length < kLeastMotion) {
      result.certain = touches == maneuver.to_contact;
      return result;
    }
    later = At(result.after);
    now = &later;
  }
}

double Maneuvered::LeastScale() const {
  double least = kBeyondLadder;
  for (const CertainMotion& motion : motions) {
    for (const Unwanted& unwanted : motion.check.unwanted) least = std::min(least, unwanted.scale);
  }
  return least;
}

TestComparison Maneuvered::Comparison() const {
  TestComparison comparison;
  for (const CertainMotion& motion : motions) comparison += motion.check.comparison;
  return comparison;
}

SegmentCheck Maneuvering::CheckReached(const BelievedPose& believed) const {
  const Vector3& in = passage_.mating;
  const Pose& X = believed.X_StationaryMoving;
  double lowest = -kInfinity;
  for (const OuterVertex& vertex : passage_.moving.vertices)
    lowest = std::max(lowest, (X * vertex.p).dot(in));
  double highest = kInfinity;
  for (const OuterVertex& vertex : passage_.stationary.vertices)
    highest = std::min(highest, vertex.p.dot(in));
  const double way = lowest - highest;
  if (way <= 0) return {.certain = true};
  PoseChange down = PoseChange::Zero();
  down.head<3>() = way * in;
  BelievedPose outside = believed;
  outside.X_StationaryMoving = Displaced(X, -down);
  return checker_.Check(outside, {down, {}, {}}, Margins::kNone).check;
}

SegmentCheck Maneuvering::CheckThrough(const BelievedPose& believed) const {
  if (ToUpright(believed.X_StationaryMoving).norm() >= kUprightEnough) return {};
  for (const PrimitiveContact& wall : walls_) {
    if (!IsWithinPlay(wall, believed)) return {.unwanted = {{KeyOf(wall)}}};
  }
  return CheckWayOn(believed);
}

SegmentCheck Maneuvering::CheckWayOn(const BelievedPose& believed) const {
  const Pose& X = believed.X_StationaryMoving;
  const double way = WayToNext(believed);
  if (way <= 0) return {.certain = true};
  PoseChange in = PoseChange::Zero();
  in.head<3>() = way * passage_.mating;
  const BelievedPose free{X, believed.errors, {}, believed.tolerances};
  const Command command{in, {}, {}};
  const MotionChecker guided = checker_.WithoutVelocityErrors();
  MotionChecker::Nearby nearby = guided.NearTheWay(free, command);
  std::erase_if(nearby.contacts, [&](const PrimitiveContact& contact) {
    return contact.row.head<3>().dot(in.head<3>()) > -kAgainst * way;
  });
  return guided.Check(nearby, free, command);
}

bool Maneuvering::IsWithinPlay(const PrimitiveContact& wall, const BelievedPose& believed) const {
  return ErrorOf(wall.row, believed) <= kRoom * wall.offset;
}

int Maneuvering::WideDirections(const BelievedPose& believed) const {
  Eigen::MatrixXd basis(kPoseDimensions, kPoseDimensions);
  Eigen::Index count = 0;
  for (const PrimitiveContact& wall : walls_) {
    if (IsWithinPlay(wall, believed)) continue;
    Eigen::VectorXd row = wall.row.head<kPoseDimensions>();
    row.tail<3>() /= checker_.options().radius;
    for (int pass = 0; pass < 2; ++pass) {
      row -= basis.leftCols(count) * (basis.leftCols(count).transpose() * row);
    }
    if (row.norm() > 1e-6) basis.col(count++) = row.normalized();
  }
  return static_cast<int>(count);
}

double Maneuvering::Halvings(const BelievedPose& believed) const {
  std::vector<ErrorParts> wide;
  for (const PrimitiveContact& wall : walls_) {
    wide.push_back(PartsOf(wall.row, believed.errors, believed.tolerances) /
                   (kRoom * std::max(wall.offset, kLeastMotion)));
  }
  double halvings = 0;
  const auto norm = [](const ErrorParts& parts) { return parts.norm(); };
  for (int i = 0; i < kPoseDimensions && !wide.empty(); ++i) {
    const auto widest = std::ranges::max_element(wide, {}, norm);
    const double width = norm(*widest);
    if (width <= 1) break;
    halvings += std::log2(width);
    const ErrorParts along = *widest / width;
    for (ErrorParts& parts : wide) parts -= along.dot(parts) * along;
  }
  return halvings;
}

std::vector<Maneuvering> ManeuveringThrough(const Passage& passage, const MotionChecker& checker,
                                            double reach) {
  std::vector<Maneuvering> maneuvering;
  for (int point = 0; point < passage.critical_points(); ++point)
    maneuvering.emplace_back(passage, point, checker, reach);
  return maneuvering;
}

}  // namespace assay::finemotion
