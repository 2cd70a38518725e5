#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "planner/finemotion/contacts/contact_range.h"
#include "planner/finemotion/contacts/parallel_edges.h"
#include "planner/finemotion/motions/kept_directions.h"
#include "planner/finemotion/motions/row_range.h"
#include "planner/finemotion/motions/segment_model.h"

namespace assay::finemotion {

// A command and its possible results under errors: the poses that the part can come to, and the
// believed pose after the command. Checks of motions spend much of their time here, so the class
// stands in a header.
class UncertainMotion {
 public:
  // All three must outlive the motion.
  UncertainMotion(const SegmentModel& model, const BelievedPose& believed, const Command& command)
      : model_(model),
        believed_(believed),
        command_(command),
        kept_(FoundOf(command.kept)),
        until_(command.until ? Find(model.contacts, *command.until) : nullptr),
        directions_(kept_, believed.tolerances, model.radius) {
    const double turn = command.displacement.tail<3>().norm();
    const double move = command.displacement.head<3>().norm();
    PoseChange drift;
    drift.head<3>().setConstant(model.velocity_error * (move + model.radius * turn));
    drift.tail<3>().setConstant(model.velocity_error * turn);
    drifts_ = directions_.Closed(drift.asDiagonal().toDenseMatrix(), false);
    errors_ = directions_.Closed(Turned(believed.errors), true);
    if (turn == 0) {
      swept_ = errors_;
    } else {
      swept_.resize(Eigen::NoChange, 2 * errors_.cols());
      swept_ << errors_, errors_ - believed.errors;
    }
    if (until_ != nullptr) {
      until_at_start_ = RangeOf(until_->row, errors_);
      until_on_the_way_ = RangeOf(until_->row, swept_);
    }
  }

  const std::vector<const PrimitiveContact*>& kept() const { return kept_; }
  const PrimitiveContact* until() const { return until_; }  // null if no contact ends the motion
  Eigen::Index errors() const { return swept_.cols(); }     // number of errors of positions
  Eigen::Index drifts() const { return drifts_.cols(); }    // number of errors of the velocity

  // Returns whether the contacts of the command exist, and whether the kept contacts can last. The
  // function does not handle a contact that disappears where another contact of the same C-surface
  // takes over.
  bool HasItsContacts() const {
    return kept_.size() == command_.kept.size() && !directions_.are_parted() &&
           (!command_.until || until_ != nullptr);
  }

  // Returns the time after which the motion is surely over, or none if it may never be over. The
  // unit is the time that the commanded displacement takes.
  std::optional<double> Time() const {
    if (until_ == nullptr) return 1;
    const double slowest = -until_at_start_.Fastest();
    const double farthest = until_->offset + until_at_start_.Highest(0);
    if (slowest <= 0 || farthest > kLatestContact * slowest) return std::nullopt;
    return std::max(0.0, farthest / slowest);
  }

  // Returns how far the part gets from the command's end (segment.h).
  ContactRange Range(double size) const {
    const double time = Time().value_or(kLatestContact);
    const double turn = MostOf<3>(swept_.bottomRows<3>(), time * drifts_.bottomRows<3>());
    const double shift = MostOf<3>(swept_.topRows<3>(), time * drifts_.topRows<3>());
    const PoseChange& way = command_.displacement;
    const double length = way.head<3>().norm() + size * way.tail<3>().norm();
    return {.reach = std::max(1.0, time - 1) * length + shift + size * turn, .turn = turn};
  }

  // --- Values of rows on the way. All are seen from the end of the motion.

  RowRange RangeOf(const numeric::SmallVector& row) const { return RangeOf(row, swept_); }
  const RowRange& UntilOnTheWay() const { return until_on_the_way_; }

  // Returns a number below the contact's gap. It costs less than RangeOf.
  double LeastGap(const PrimitiveContact& contact, double time) const {
    const PoseChange row = contact.row.head<kPoseDimensions>();
    const double motion = row.dot(command_.displacement);
    const double drift = (drifts_.transpose() * row).lpNorm<1>();
    const double error = SumOfParts(contact.row, swept_, believed_.tolerances);
    return contact.offset - motion - error + time * std::min(0.0, motion - drift);
  }

  // Returns whether the motion surely opens the contact.
  bool SurelyLeaves(const PrimitiveContact& contact) const {
    const auto row = contact.row.head<kPoseDimensions>();
    return row.dot(command_.displacement) > (drifts_.transpose() * row).lpNorm<1>();
  }

  SweptEdge SweptAlong(const EdgeAlongEdge& edge) const {
    return {
        .ends = {Swept(edge.ends[0]), Swept(edge.ends[1])},
        .length = edge.length,
        .elongation = edge.elongation.head(believed_.tolerances.size()).dot(believed_.tolerances)};
  }

  // Returns the values of the gap of the contact that ends the motion.
  SweptValues<1> SweptGapOfUntil() const {
    SweptValues<1> gap;
    gap.start << until_->offset + until_on_the_way_.start;
    gap.motion << until_on_the_way_.motion;
    gap.start_errors = until_on_the_way_.start_errors.transpose();
    gap.motion_errors = until_on_the_way_.motion_errors.transpose();
    return gap;
  }

  // --- Where the motion ends.

  // The places where motions come to the surface of the contact that ends them. They combine the
  // start's errors, moved there along the mean velocity, with the velocity's errors on the longest
  // way.
  struct Arrival {
    PoseChange center;
    PoseChanges errors;  // errors of the start, moved to the surface
    PoseChanges drifts;  // drifts on a way of one displacement
  };

  // A motion from z at velocity v0 + e is on the surface after some time s. The projection P along
  // v0 leaves that point where it is and removes s v0. So the point is P z + s (linear part of P)
  // e. The time s is at most that of the farthest start at the slowest approach.
  Arrival ArrivalAt(const PrimitiveContact& contact) const {
    const auto row = contact.row.head<kPoseDimensions>();
    const PoseChange step =  // the step that changes the gap by 1
        command_.displacement / row.dot(command_.displacement);
    return {-contact.offset * step,
            Stepped(errors_, PartsOf(contact.row, errors_, believed_.tolerances), step),
            Stepped(drifts_, drifts_.transpose() * row, step)};
  }

  // Returns each change minus its share of the step.
  static PoseChanges Stepped(PoseChanges changes, const Eigen::VectorXd& parts,
                             const PoseChange& step) {
    for (Eigen::Index i = 0; i < changes.cols(); ++i) changes.col(i) -= parts[i] * step;
    return changes;
  }

  // Returns the highest value of a row over all arrivals.
  double Highest(const numeric::SmallVector& row, const Arrival& arrival, double time) const {
    const auto pose = row.head<kPoseDimensions>();
    return pose.dot(arrival.center) +
           PartsOf(row, arrival.errors, believed_.tolerances).lpNorm<1>() +
           time * (arrival.drifts.transpose() * pose).lpNorm<1>();
  }

  // Returns the believed pose after a motion that nothing ends.
  BelievedPose After() const { return After(PoseChange::Zero(), Joined(errors_, drifts_)); }
  // Returns the believed pose after a motion that `until()` ends.
  BelievedPose After(const Arrival& arrival, double time) const {
    return After(arrival.center, Joined(arrival.errors, time * arrival.drifts));
  }

 private:
  static constexpr double kLatestContact = 20;  // displacements until it is surely made, at most
  static constexpr double kVanished = 1e-12;    // relative length of a generator that is rounding

  std::vector<const PrimitiveContact*> FoundOf(const std::vector<ContactKey>& keys) const {
    std::vector<const PrimitiveContact*> found;
    found.reserve(keys.size() + 1);
    for (const ContactKey& key : keys) {
      if (const PrimitiveContact* contact = Find(model_.contacts, key)) found.push_back(contact);
    }
    return found;
  }

  // Returns the errors turned by the displacement. The hand turns the part about the place where
  // the hand believes the tip to be, so errors turn with the hand.
  PoseChanges Turned(PoseChanges errors) const {
    if (command_.displacement.tail<3>().isZero(0)) return errors;
    const Eigen::Matrix3d R = Displaced(Pose::Identity(), command_.displacement).linear();
    errors.topRows<3>() = R * errors.topRows<3>();
    errors.bottomRows<3>() = R * errors.bottomRows<3>();
    return errors;
  }

  RowRange RangeOf(const numeric::SmallVector& row, const PoseChanges& errors) const {
    const auto pose = row.head<kPoseDimensions>();
    RowRange range;
    range.motion = pose.dot(command_.displacement);
    range.start = -range.motion;
    range.motion_errors = drifts_.transpose() * pose;
    range.start_errors = PartsOf(row, errors, believed_.tolerances);
    return range;
  }

  // Returns a bound of the length of a sum of the columns, each times a factor in -1 .. 1.
  template <int Rows>
  static double MostOf(const Eigen::Matrix<double, Rows, Eigen::Dynamic>& a,
                       const Eigen::Matrix<double, Rows, Eigen::Dynamic>& b) {
    return (a.cwiseAbs().rowwise().sum() + b.cwiseAbs().rowwise().sum()).norm();
  }

  // Returns the point's values as seen from the end of the motion.
  SweptValues<3> Swept(PointAtEdge point) const {
    directions_.TakeOut(point);
    SweptValues<3> swept;
    swept.motion = point.pose * command_.displacement;
    swept.start = point.offset - swept.motion;
    swept.start_errors = point.pose * swept_;
    const Eigen::Index t = believed_.tolerances.size();
    if (t > 0) {
      swept.start_errors.leftCols(t) += point.tolerances * believed_.tolerances.asDiagonal();
    }
    swept.motion_errors = point.pose * drifts_;
    return swept;
  }

  // Kept contacts drift off their surfaces to second order, so they are closed again.
  BelievedPose After(const PoseChange& center, PoseChanges errors) const {
    std::vector<const PrimitiveContact*> touching = kept_;
    if (until_ != nullptr) touching.push_back(until_);
    BelievedPose after{.X_StationaryMoving =
                           Displaced(Displaced(believed_.X_StationaryMoving, command_.displacement),
                                     center + Closing(touching, center, model_.radius)),
                       .errors = std::move(errors),
                       .kept = command_.kept,
                       .tolerances = believed_.tolerances};
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
      if (i < believed_.tolerances.size() || IsSomething(errors.col(i), believed_.errors.col(i))) {
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
  const BelievedPose& believed_;
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
};

}  // namespace assay::finemotion
