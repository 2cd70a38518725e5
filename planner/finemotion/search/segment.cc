#include "planner/finemotion/search/segment.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "planner/finemotion/contacts/meeting.h"
#include "planner/finemotion/graph/projection_image.h"
#include "planner/numeric/orthogonal_decomposition.h"

namespace assay::finemotion {

namespace {

constexpr double kTurned = 2e-3;       // radians that a kept contact may be beyond a limit
constexpr double kLatestContact = 20;  // displacements until the contact is surely made, at most
constexpr double kGreatestMultiplier = 1e6;
constexpr int kThirds = 30;  // steps of a search that leaves two thirds of an interval in each
constexpr double kParallel = 1e-9;   // greatest difference of the coefficients of parallel rows
constexpr double kParted = 1e-9;     // metres by which tolerances may part kept contacts
constexpr double kVanished = 1e-12;  // relative length below which a generator is only rounding
// Metres; a feature that slides along another as it touches may close by this much.
constexpr double kGrazed = 1e-12;
// Number of errors for which the edge test takes a millisecond.
constexpr Eigen::Index kFewErrors = 12;

// The changes of a row's value that are due to the errors of the start, one number for each error.
using ErrorParts = Eigen::VectorXd;

ErrorParts PartsOf(const numeric::SmallVector& row, const PoseChanges& errors,
                   const Eigen::VectorXd& tolerances) {
  ErrorParts parts = errors.transpose() * row.head<kPoseDimensions>();
  const Eigen::Index t = tolerances.size();
  if (t > 0) parts.head(t) += row.tail(t).cwiseProduct(tolerances);
  return parts;
}

// Returns the sum of the sizes of the parts that PartsOf computes.
double SumOfParts(const numeric::SmallVector& row, const PoseChanges& errors,
                  const Eigen::VectorXd& tolerances) {
  const PoseChange pose = row.head<kPoseDimensions>();
  const Eigen::Index t = tolerances.size();
  double sum = 0;
  for (Eigen::Index i = 0; i < t; ++i) {
    sum += std::abs(pose.dot(errors.col(i)) + row[kPoseDimensions + i] * tolerances[i]);
  }
  for (Eigen::Index i = t; i < errors.cols(); ++i) sum += std::abs(pose.dot(errors.col(i)));
  return sum;
}

// The range of a linear function over a forward projection: over the start, with all of its errors,
// and over the velocity, with all of its errors.
struct RowRange {
  double start = 0;
  double motion = 0;  // change of the value in one displacement
  ErrorParts start_errors;
  PoseChange motion_errors;

  double Lowest(double time) const { return Extreme(-1, time); }
  double Highest(double time) const { return Extreme(1, time); }
  // Returns the greatest rate over all velocities.
  double Fastest() const { return motion + motion_errors.lpNorm<1>(); }

 private:
  double Extreme(double sign, double time) const {
    const double moved = sign * motion + motion_errors.lpNorm<1>();
    return sign * (sign * start + start_errors.lpNorm<1>() + time * std::max(0.0, moved));
  }
};

// Returns whether `row` stays below `most` wherever the contact that ends the motion is still open.
// The highest value of `row` there is at most the highest value of `row` plus a multiple of the
// contact's gap (Lagrange). This bound is convex in the multiplier, so a search over multipliers
// finds the best bound.
bool StaysBelow(const RowRange& row, const RowRange& gap, double gap_offset, double most,
                double time) {
  const auto bound = [&](double multiplier) {
    const double errors = (row.start_errors + multiplier * gap.start_errors).lpNorm<1>();
    const double moved = row.motion + multiplier * gap.motion +
                         (row.motion_errors + multiplier * gap.motion_errors).lpNorm<1>();
    return row.start + multiplier * (gap.start + gap_offset) + errors + time * std::max(0.0, moved);
  };
  double high = 1;
  while (high < kGreatestMultiplier && bound(2 * high) < bound(high)) high *= 2;
  high *= 2;
  double low = 0;
  for (int i = 0; i < kThirds; ++i) {
    const double third = (high - low) / 3;
    const double left = bound(low + third);
    const double right = bound(high - third);
    if (std::min(left, right) <= most) return true;
    (left < right ? high : low) += left < right ? -third : third;
  }
  return false;
}

// The directions of the kept contacts' gaps, along which force control allows no motion. They are
// orthonormal, with rotations times the radius as lengths. Each has the shift that tolerances
// cause.
class KeptDirections {
 public:
  KeptDirections(const std::vector<const PrimitiveContact*>& kept,
                 const Eigen::VectorXd& tolerances, double radius)
      : tolerances_(tolerances) {
    lengths_ << 1, 1, 1, radius, radius, radius;
    shifts_.resize(tolerances.size(), kPoseDimensions);
    for (const PrimitiveContact* contact : kept) Add(*contact);
  }

  // Returns whether errors of the model can open some of the contacts when others are closed.
  bool are_parted() const { return are_parted_; }

  // Rewrites the point's coordinates so that they are constant where the contacts make them
  // constant. This holds even along a motion that keeps contacts to first order only.
  void TakeOut(PointAtEdge& point) const {
    for (int i = 0; i < count_; ++i) {
      const PoseChange row = lengths_.cwiseProduct(basis_.col(i));
      const Vector3 along = point.pose * lengths_.cwiseInverse().cwiseProduct(basis_.col(i));
      point.offset -= offsets_[i] * along;
      point.pose -= along * row.transpose();
      if (tolerances_.size() > 0) point.tolerances -= along * shifts_.col(i).transpose();
    }
  }

  // Returns the errors moved by the least change that closes the contacts. If `with_tolerances`,
  // the first columns belong to the tolerances too.
  PoseChanges Closed(PoseChanges errors, bool with_tolerances) const {
    if (count_ == 0) return errors;
    for (Eigen::Index j = 0; j < errors.cols(); ++j) {
      const PoseChange error = errors.col(j);
      PoseChange closing = PoseChange::Zero();
      for (int i = 0; i < count_; ++i) {
        const PoseChange direction = basis_.col(i);
        double open = direction.cwiseProduct(lengths_).dot(error);
        if (with_tolerances && j < tolerances_.size()) open += shifts_(j, i) * tolerances_[j];
        closing += open * lengths_.cwiseInverse().cwiseProduct(direction);
      }
      errors.col(j) = error - closing;
    }
    return errors;
  }

 private:
  void Add(const PrimitiveContact& contact) {
    PoseChange row = contact.row.head<kPoseDimensions>().cwiseQuotient(lengths_);
    Eigen::VectorXd shift = contact.row.tail(tolerances_.size());
    double offset = contact.offset;
    for (int pass = 0; pass < 2; ++pass) {
      for (int i = 0; i < count_; ++i) {
        const double along = basis_.col(i).dot(row);
        row -= along * basis_.col(i);
        shift -= along * shifts_.col(i);
        offset -= along * offsets_[i];
      }
    }
    const double length = row.norm();
    if (length > 1e-9) {
      basis_.col(count_) = row / length;
      offsets_[count_] = offset / length;
      shifts_.col(count_++) = shift / length;
    } else if (shift.cwiseProduct(tolerances_).lpNorm<1>() > kParted) {
      are_parted_ = true;
    }
  }

  const Eigen::VectorXd& tolerances_;
  PoseChange lengths_;
  Eigen::Matrix<double, kPoseDimensions, kPoseDimensions> basis_;
  PoseChange offsets_;  // gaps along these directions at the end of the motion
  Eigen::Matrix<double, Eigen::Dynamic, kPoseDimensions> shifts_;
  int count_ = 0;
  bool are_parted_ = false;
};

// The places where motions come to the surface of the contact that ends them. They combine the
// start's errors, moved there along the mean velocity, with the velocity's errors on the longest
// way.
struct Arrival {
  PoseChange center;
  PoseChanges errors;  // errors of the start, moved to the surface
  PoseChanges drifts;  // drifts on a way of one displacement
};

class Checker {
 public:
  Checker(const SegmentModel& model, const Belief& belief, const Command& command)
      : model_(model),
        belief_(belief),
        command_(command),
        kept_(FoundOf(command.kept)),
        until_(command.until ? Find(model.contacts, *command.until) : nullptr),
        directions_(kept_, belief.tolerances, model.radius) {
    const double turn = command.displacement.tail<3>().norm();
    const double move = command.displacement.head<3>().norm();
    PoseChange drift;
    drift.head<3>().setConstant(model.velocity_error * (move + model.radius * turn));
    drift.tail<3>().setConstant(model.velocity_error * turn);
    drifts_ = directions_.Closed(drift.asDiagonal().toDenseMatrix(), false);
    errors_ = directions_.Closed(Turned(belief.errors), true);
    if (turn == 0) {
      swept_ = errors_;
    } else {
      swept_.resize(Eigen::NoChange, 2 * errors_.cols());
      swept_ << errors_, errors_ - belief.errors;
    }
    if (until_ != nullptr) {
      until_at_start_ = RangeOf(until_->row, errors_);
      until_on_the_way_ = RangeOf(until_->row, swept_);
    }
  }

  SegmentCheck Run(Telling telling) {
    telling_ = telling;
    if (!KeptStay() || (command_.until && until_ == nullptr)) return check_;
    const std::optional<double> time = Time();
    if (!time) return check_;
    time_ = *time;
    check_.longest = time_;
    if (!AddContacts() || !AddParallelEdges() || !AddLosses() || !AddMissing()) return check_;
    check_.certain = check_.unwanted.empty();
    if (check_.certain) check_.after = After();
    return check_;
  }

  ContactRange Range(double size) const {
    const double time = Time().value_or(kLatestContact);
    const double turn = MostOf<3>(swept_.bottomRows<3>(), time * drifts_.bottomRows<3>());
    const double shift = MostOf<3>(swept_.topRows<3>(), time * drifts_.topRows<3>());
    const PoseChange& way = command_.displacement;
    const double length = way.head<3>().norm() + size * way.tail<3>().norm();
    return {.reach = std::max(1.0, time - 1) * length + shift + size * turn, .turn = turn};
  }

 private:
  std::vector<const PrimitiveContact*> FoundOf(const std::vector<ContactKey>& keys) const {
    std::vector<const PrimitiveContact*> found;
    found.reserve(keys.size() + 1);
    for (const ContactKey& key : keys) {
      if (const PrimitiveContact* contact = Find(model_.contacts, key)) found.push_back(contact);
    }
    return found;
  }

  // Returns whether the kept contacts last. A contact that disappears where another one of its
  // C-surface takes over is not handled here.
  bool KeptStay() const {
    return kept_.size() == command_.kept.size() && !directions_.are_parted();
  }

  // Returns the errors turned by the displacement. The hand turns the part about where it believes
  // the tip to be, so errors turn with it.
  PoseChanges Turned(PoseChanges errors) const {
    if (command_.displacement.tail<3>().isZero(0)) return errors;
    const Eigen::Matrix3d R = Displaced(Pose::Identity(), command_.displacement).linear();
    errors.topRows<3>() = R * errors.topRows<3>();
    errors.bottomRows<3>() = R * errors.bottomRows<3>();
    return errors;
  }

  // Returns the row's range as seen from the end of the motion.
  RowRange RangeOf(const numeric::SmallVector& row, const PoseChanges& errors) const {
    const auto pose = row.head<kPoseDimensions>();
    RowRange range;
    range.motion = pose.dot(command_.displacement);
    range.start = -range.motion;
    range.motion_errors = drifts_.transpose() * pose;
    range.start_errors = PartsOf(row, errors);
    return range;
  }

  ErrorParts PartsOf(const numeric::SmallVector& row, const PoseChanges& errors) const {
    return finemotion::PartsOf(row, errors, belief_.tolerances);
  }

  // Returns the number of displacements until the motion is surely over, or none if it may never
  // be.
  std::optional<double> Time() const {
    if (until_ == nullptr) return 1;
    const double slowest = -until_at_start_.Fastest();
    const double farthest = until_->offset + until_at_start_.Highest(0);
    if (slowest <= 0 || farthest > kLatestContact * slowest) return std::nullopt;
    return std::max(0.0, farthest / slowest);
  }

  // Returns a bound of the length of a sum of the columns, each times a factor in -1 .. 1.
  template <int Rows>
  static double MostOf(const Eigen::Matrix<double, Rows, Eigen::Dynamic>& a,
                       const Eigen::Matrix<double, Rows, Eigen::Dynamic>& b) {
    return (a.cwiseAbs().rowwise().sum() + b.cwiseAbs().rowwise().sum()).norm();
  }

  // --- Contacts that must not be made.

  bool AddContacts() {
    return std::ranges::all_of(model_.contacts, [&](const PrimitiveContact& contact) {
      return IsWanted(contact) || !CanMake(contact) || Add({KeyOf(contact), false});
    });
  }

  // Adds an unwanted contact or loss. Returns whether the check should go on.
  bool Add(const Unwanted& unwanted) {
    check_.unwanted.push_back(unwanted);
    return telling_ == Telling::kAll;
  }

  // Returns whether the contact may be made. A contact that the motion lets go may be made if the
  // motion surely leaves it.
  bool IsWanted(const PrimitiveContact& contact) const {
    const ContactKey key = KeyOf(contact);
    if (command_.until && key == *command_.until) return true;
    if (std::ranges::find(command_.kept, key) != command_.kept.end()) return true;
    if (std::ranges::find(belief_.kept, key) == belief_.kept.end()) return false;
    const auto row = contact.row.head<kPoseDimensions>();
    return row.dot(command_.displacement) > (drifts_.transpose() * row).lpNorm<1>();
  }

  bool CanMake(const PrimitiveContact& contact) {
    if (!MayClose(contact)) return false;
    const RowRange gap = RangeOf(contact.row, swept_);
    if (contact.offset + gap.Lowest(time_) > -kGrazed) return false;
    std::vector<RowRange> limits;
    limits.reserve(contact.limits.size());
    for (const HalfSpace& limit : contact.limits) {
      limits.push_back(RangeOf(limit.a, swept_));
      if (limits.back().Lowest(time_) > limit.b) return false;
    }
    return Meets(contact, gap, limits);
  }

  // Returns whether the gap may close at all. This test rules out most contacts quickly.
  bool MayClose(const PrimitiveContact& contact) const {
    const PoseChange row = contact.row.head<kPoseDimensions>();
    const double motion = row.dot(command_.displacement);
    const double drift = (drifts_.transpose() * row).lpNorm<1>();
    const double error = SumOfParts(contact.row, swept_, belief_.tolerances);
    return contact.offset - motion - error + time_ * std::min(0.0, motion - drift) <= -kGrazed;
  }

  // Returns whether the contact can be made before the contact that ends the motion.
  bool Meets(const PrimitiveContact& contact, const RowRange& gap,
             const std::vector<RowRange>& limits) {
    const Eigen::Index rows = std::ssize(limits) + (until_ != nullptr ? 2 : 1);
    ProjectionImage image(rows, swept_.cols(), drifts_.cols());
    Eigen::Index row = 0;
    const auto add = [&](const RowRange& range, double offset, double sign) {
      image.start(row) = sign * (range.start + offset);
      image.motion(row) = sign * time_ * range.motion;
      for (Eigen::Index i = 0; i < swept_.cols(); ++i) {
        image.start_error(row, i) = sign * range.start_errors[i];
      }
      for (Eigen::Index i = 0; i < drifts_.cols(); ++i) {
        image.motion_error(row, i) = sign * time_ * range.motion_errors[i];
      }
      ++row;
    };
    add(gap, contact.offset, 1);
    for (std::size_t i = 0; i < limits.size(); ++i) add(limits[i], -contact.limits[i].b, 1);
    if (until_ != nullptr) add(until_on_the_way_, until_->offset, -1);
    image.ForgetZeros();
    return Decide(image);
  }

  bool Decide(const ProjectionImage& image) {
    const auto is_exactly = [&] { return finemotion::Meets(image, kMeetingTolerance); };
    ++check_.comparison.tests;
    if (model_.test == MeetingTest::kExact || image.errors() > kFewErrors) return is_exactly();
    if (model_.test == MeetingTest::kEdges) return EdgeMeets(image);
    const bool meets = is_exactly();
    ++check_.comparison.compared;
    if (meets && !EdgeMeets(image)) ++check_.comparison.missed;
    return meets;
  }

  bool AddParallelEdges() {
    if (model_.parallel_edges.empty()) return true;
    std::optional<SweptValues<1>> until;
    if (until_ != nullptr) until = UntilOnTheWay();
    const auto may_touch = [&](const EdgeAlongEdge& along) {
      return MayTouch(SweptAlong(along), until ? &*until : nullptr, time_);
    };
    return std::ranges::all_of(model_.parallel_edges, [&](const ParallelEdges& edges) {
      return !may_touch(edges.along_stationary) || !may_touch(edges.along_moving) ||
             Add({KeyOf(edges), false});
    });
  }

  SweptEdge SweptAlong(const EdgeAlongEdge& edge) const {
    return {.ends = {Swept(edge.ends[0]), Swept(edge.ends[1])},
            .length = edge.length,
            .elongation = edge.elongation.head(belief_.tolerances.size()).dot(belief_.tolerances)};
  }

  // Returns the point's values as seen from the end of the motion.
  SweptValues<3> Swept(PointAtEdge point) const {
    directions_.TakeOut(point);
    SweptValues<3> swept;
    swept.motion = point.pose * command_.displacement;
    swept.start = point.offset - swept.motion;
    swept.start_errors = point.pose * swept_;
    const Eigen::Index t = belief_.tolerances.size();
    if (t > 0) {
      swept.start_errors.leftCols(t) += point.tolerances * belief_.tolerances.asDiagonal();
    }
    swept.motion_errors = point.pose * drifts_;
    return swept;
  }

  SweptValues<1> UntilOnTheWay() const {
    SweptValues<1> gap;
    gap.start << until_->offset + until_on_the_way_.start;
    gap.motion << until_on_the_way_.motion;
    gap.start_errors = until_on_the_way_.start_errors.transpose();
    gap.motion_errors = until_on_the_way_.motion_errors.transpose();
    return gap;
  }

  // --- Contacts that must not be lost.

  bool AddLosses() {
    return std::ranges::all_of(kept_, [&](const PrimitiveContact* kept) {
      return !CanLose(*kept) || Add({KeyOf(*kept), true});
    });
  }

  // Returns whether a limit of the contact can be exceeded where nothing stops the part.
  bool CanLose(const PrimitiveContact& contact) const {
    return std::ranges::any_of(contact.limits, [&](const HalfSpace& limit) {
      const double most = limit.b + Slack(limit);
      const RowRange range = RangeOf(limit.a, swept_);
      if (range.Highest(time_) <= most || Stops(limit)) return false;
      return until_ == nullptr ||
             !StaysBelow(range, until_on_the_way_, until_->offset, most, time_);
    });
  }

  bool AddMissing() {
    if (until_ == nullptr) return true;
    arrival_ = ArrivalAt(*until_);
    return !CanPass() || Add({KeyOf(*until_), true});
  }

  // Returns whether the part can come to the awaited contact's surface outside the contact's
  // limits.
  bool CanPass() const {
    return std::ranges::any_of(until_->limits, [&](const HalfSpace& limit) {
      const auto pose = limit.a.head<kPoseDimensions>();
      const double highest = pose.dot(arrival_.center) +
                             PartsOf(limit.a, arrival_.errors).lpNorm<1>() +
                             time_ * (arrival_.drifts.transpose() * pose).lpNorm<1>();
      return highest > limit.b + Slack(limit) && !Stops(limit);
    });
  }

  static double Slack(const HalfSpace& limit) {
    return limit.a.head<3>().isZero(0) ? kTurned : kLost;
  }

  bool Stops(const HalfSpace& limit) const {
    return std::ranges::any_of(model_.contacts, [&](const PrimitiveContact& contact) {
      return std::abs(contact.offset - limit.b) < kParallel &&
             (contact.row + limit.a).cwiseAbs().maxCoeff() < kParallel;
    });
  }

  // --- The believed pose afterwards.

  // A motion from z at velocity v0 + e is on the surface after some time s. The projection P along
  // v0 leaves that point where it is and removes s v0. So the point is P z + s (linear part of P)
  // e. The time s is at most that of the farthest start at the slowest approach.
  Arrival ArrivalAt(const PrimitiveContact& contact) const {
    const auto row = contact.row.head<kPoseDimensions>();
    const PoseChange step =  // the step that changes the gap by 1
        command_.displacement / row.dot(command_.displacement);
    return {-contact.offset * step, Stepped(errors_, PartsOf(contact.row, errors_), step),
            Stepped(drifts_, drifts_.transpose() * row, step)};
  }

  // Returns each change minus its share of the step.
  static PoseChanges Stepped(PoseChanges changes, const Eigen::VectorXd& parts,
                             const PoseChange& step) {
    for (Eigen::Index i = 0; i < changes.cols(); ++i) changes.col(i) -= parts[i] * step;
    return changes;
  }

  Belief After() const {
    PoseChange center = PoseChange::Zero();
    if (until_ != nullptr) center = arrival_.center;
    // Kept contacts drift off their surfaces to second order.
    std::vector<const PrimitiveContact*> touching = kept_;
    if (until_ != nullptr) touching.push_back(until_);
    Belief after{.X_StationaryMoving =
                     Displaced(Displaced(belief_.X_StationaryMoving, command_.displacement),
                               center + Closing(touching, center, model_.radius)),
                 .errors = until_ != nullptr ? Joined(arrival_.errors, time_ * arrival_.drifts)
                                             : Joined(errors_, drifts_),
                 .kept = command_.kept,
                 .tolerances = belief_.tolerances};
    if (until_ != nullptr) after.kept.push_back(*command_.until);
    std::ranges::sort(after.kept);
    return after;
  }

  // Returns errors and drifts together, without those that have vanished. The columns of tolerances
  // stay.
  PoseChanges Joined(const PoseChanges& errors, const PoseChanges& drifts) const {
    PoseChanges joined(kPoseDimensions, errors.cols() + drifts.cols());
    Eigen::Index count = 0;
    for (Eigen::Index i = 0; i < errors.cols(); ++i) {
      if (i < belief_.tolerances.size() || IsSomething(errors.col(i), belief_.errors.col(i))) {
        joined.col(count++) = errors.col(i);
      }
    }
    for (Eigen::Index i = 0; i < drifts.cols(); ++i) {
      if (IsSomething(drifts.col(i), drifts_.col(i))) joined.col(count++) = drifts.col(i);
    }
    joined.conservativeResize(Eigen::NoChange, count);
    return joined;
  }

  // Returns whether more than rounding remains of the error.
  static bool IsSomething(const PoseChange& error, const PoseChange& before) {
    return error.norm() > kVanished * before.norm();
  }

  const SegmentModel& model_;
  const Belief& belief_;
  const Command& command_;
  std::vector<const PrimitiveContact*> kept_;
  const PrimitiveContact* until_;
  KeptDirections directions_;
  // The drifts of one displacement, the start's errors as seen from the end, and the start's errors
  // together with the errors anywhere on the way to the end.
  Eigen::Matrix<double, kPoseDimensions, kPoseDimensions> drifts_;
  PoseChanges errors_;
  PoseChanges swept_;
  RowRange until_at_start_;
  RowRange until_on_the_way_;
  Arrival arrival_;
  Telling telling_ = Telling::kFirst;
  double time_ = 1;  // displacements until the motion is surely over
  SegmentCheck check_;
};

}  // namespace

TestComparison& TestComparison::operator+=(const TestComparison& other) {
  tests += other.tests;
  compared += other.compared;
  missed += other.missed;
  return *this;
}

double ErrorOf(const numeric::SmallVector& row, const Belief& belief) {
  return SumOfParts(row, belief.errors, belief.tolerances);
}

PoseChange Closing(const std::vector<const PrimitiveContact*>& contacts, const PoseChange& z,
                   double radius) {
  PoseChange closing = PoseChange::Zero();
  if (contacts.empty()) return closing;
  Eigen::MatrixXd rows(std::ssize(contacts), kPoseDimensions);
  Eigen::VectorXd gaps(rows.rows());
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    const PrimitiveContact& contact = *contacts[static_cast<std::size_t>(i)];
    rows.row(i) = contact.row.head<kPoseDimensions>();
    gaps[i] = contact.offset + rows.row(i).dot(z);
  }
  rows.rightCols<3>() /= radius;
  closing = numeric::ShortestLeastSquares(rows, -gaps);
  closing.tail<3>() /= radius;
  return closing;
}

Pose Displaced(const Pose& X_StationaryMoving, const PoseChange& z) {
  Pose X = X_StationaryMoving;
  const Vector3 w = z.tail<3>();
  const double angle = w.norm();
  if (angle > 0) X.linear() = Eigen::AngleAxisd(angle, w / angle) * X.linear();
  X.translation() += z.head<3>();
  return X;
}

PoseChange Between(const Pose& from, const Pose& to) {
  const Eigen::AngleAxisd turn(Eigen::Matrix3d(to.linear() * from.linear().transpose()));
  PoseChange z;
  z << to.translation() - from.translation(), turn.angle() * turn.axis();
  return z;
}

SegmentCheck Check(const SegmentModel& model, const Belief& belief, const Command& command,
                   Telling telling) {
  return Checker(model, belief, command).Run(telling);
}

ContactRange RangeOf(const SegmentModel& touching, const Belief& belief, const Command& command,
                     double size) {
  return Checker(touching, belief, command).Range(size);
}

}  // namespace assay::finemotion
