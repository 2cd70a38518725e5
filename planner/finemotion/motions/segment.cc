#include "planner/finemotion/motions/segment.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "planner/finemotion/forward_projections/meeting.h"
#include "planner/finemotion/forward_projections/projection_image.h"
#include "planner/finemotion/motions/uncertain_motion.h"

namespace assay::finemotion {

namespace {

constexpr double kTurned = 2e-3;    // radians that a kept contact may be beyond a limit
constexpr double kParallel = 1e-9;  // greatest difference of the coefficients of parallel rows
// The gap of a contact between features that slide along each other may shrink by this many metres.
constexpr double kGrazed = 1e-12;
// Number of errors for which the edge test takes a millisecond.
constexpr Eigen::Index kFewErrors = 12;

class Checker {
 public:
  Checker(const SegmentModel& model, const BelievedPose& believed, const Command& command)
      : model_(model), believed_(believed), command_(command), motion_(model, believed, command) {}

  SegmentCheck Run(Telling telling) {
    telling_ = telling;
    if (!motion_.HasItsContacts()) return check_;
    const std::optional<double> time = motion_.Time();
    if (!time) return check_;
    time_ = *time;
    check_.longest = time_;
    if (!AddContacts() || !AddParallelEdges() || !AddLosses() || !AddMissing()) return check_;
    check_.certain = check_.unwanted.empty();
    if (check_.certain) {
      check_.after = motion_.until() != nullptr ? motion_.After(arrival_, time_) : motion_.After();
    }
    return check_;
  }

 private:
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

  // Returns whether the contact may be made. A contact that held before the motion and is not kept
  // may touch at the start if the motion surely leaves it.
  bool IsWanted(const PrimitiveContact& contact) const {
    const ContactKey key = KeyOf(contact);
    if (command_.until && key == *command_.until) return true;
    if (std::ranges::find(command_.kept, key) != command_.kept.end()) return true;
    if (std::ranges::find(believed_.kept, key) == believed_.kept.end()) return false;
    return motion_.SurelyLeaves(contact);
  }

  bool CanMake(const PrimitiveContact& contact) {
    if (motion_.LeastGap(contact, time_) > -kGrazed) return false;
    const RowRange gap = motion_.RangeOf(contact.row);
    if (contact.offset + gap.Lowest(time_) > -kGrazed) return false;
    std::vector<RowRange> limits;
    limits.reserve(contact.limits.size());
    for (const HalfSpace& limit : contact.limits) {
      limits.push_back(motion_.RangeOf(limit.a));
      if (limits.back().Lowest(time_) > limit.b) return false;
    }
    return Meets(contact, gap, limits);
  }

  // Returns whether the contact can be made before the contact that ends the motion.
  bool Meets(const PrimitiveContact& contact, const RowRange& gap,
             const std::vector<RowRange>& limits) {
    const Eigen::Index rows = std::ssize(limits) + (motion_.until() != nullptr ? 2 : 1);
    ProjectionImage image(rows, motion_.errors(), motion_.drifts());
    Eigen::Index row = 0;
    const auto add = [&](const RowRange& range, double offset, double sign) {
      image.start(row) = sign * (range.start + offset);
      image.motion(row) = sign * time_ * range.motion;
      for (Eigen::Index i = 0; i < motion_.errors(); ++i) {
        image.start_error(row, i) = sign * range.start_errors[i];
      }
      for (Eigen::Index i = 0; i < motion_.drifts(); ++i) {
        image.motion_error(row, i) = sign * time_ * range.motion_errors[i];
      }
      ++row;
    };
    add(gap, contact.offset, 1);
    for (std::size_t i = 0; i < limits.size(); ++i) add(limits[i], -contact.limits[i].b, 1);
    if (motion_.until() != nullptr) add(motion_.UntilOnTheWay(), motion_.until()->offset, -1);
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
    if (motion_.until() != nullptr) until = motion_.SweptGapOfUntil();
    const auto may_touch = [&](const EdgeAlongEdge& along) {
      return MayTouch(motion_.SweptAlong(along), until ? &*until : nullptr, time_);
    };
    return std::ranges::all_of(model_.parallel_edges, [&](const ParallelEdges& edges) {
      return !may_touch(edges.along_stationary) || !may_touch(edges.along_moving) ||
             Add({KeyOf(edges), false});
    });
  }

  // --- Contacts that must not be lost.

  bool AddLosses() {
    return std::ranges::all_of(motion_.kept(), [&](const PrimitiveContact* kept) {
      return !CanLose(*kept) || Add({KeyOf(*kept), true});
    });
  }

  // Returns whether a limit of the contact can be exceeded where nothing stops the part.
  bool CanLose(const PrimitiveContact& contact) const {
    return std::ranges::any_of(contact.limits, [&](const HalfSpace& limit) {
      const double most = limit.b + Slack(limit);
      const RowRange range = motion_.RangeOf(limit.a);
      if (range.Highest(time_) <= most || Stops(limit)) return false;
      return motion_.until() == nullptr ||
             !StaysBelow(range, motion_.UntilOnTheWay(), motion_.until()->offset, most, time_);
    });
  }

  bool AddMissing() {
    if (motion_.until() == nullptr) return true;
    arrival_ = motion_.ArrivalAt(*motion_.until());
    return !CanPass() || Add({KeyOf(*motion_.until()), true});
  }

  // Returns whether the part can come to the awaited contact's surface outside the contact's
  // limits.
  bool CanPass() const {
    return std::ranges::any_of(motion_.until()->limits, [&](const HalfSpace& limit) {
      return motion_.Highest(limit.a, arrival_, time_) > limit.b + Slack(limit) && !Stops(limit);
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

  const SegmentModel& model_;
  const BelievedPose& believed_;
  const Command& command_;
  UncertainMotion motion_;
  UncertainMotion::Arrival arrival_;
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

SegmentCheck Check(const SegmentModel& model, const BelievedPose& believed, const Command& command,
                   Telling telling) {
  return Checker(model, believed, command).Run(telling);
}

ContactRange RangeOf(const SegmentModel& touching, const BelievedPose& believed,
                     const Command& command, double size) {
  return UncertainMotion(touching, believed, command).Range(size);
}

}  // namespace assay::finemotion
