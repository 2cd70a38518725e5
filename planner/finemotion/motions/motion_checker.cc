#include "planner/finemotion/motions/motion_checker.h"

#include <algorithm>

#include "planner/finemotion/forces/friction_limit.h"

namespace assay::finemotion {

namespace {

std::vector<ContactKey> TouchedIn(const Command& command) {
  std::vector<ContactKey> touched = command.kept;
  if (command.until) touched.push_back(*command.until);
  return touched;
}

std::vector<PrimitiveContact> CopiesOf(const std::vector<PrimitiveContact>& contacts,
                                       const std::vector<ContactKey>& keys) {
  std::vector<PrimitiveContact> those;
  for (const ContactKey& key : keys) {
    if (const PrimitiveContact* contact = Find(contacts, key)) those.push_back(*contact);
  }
  return those;
}

Pose EndOf(const BelievedPose& believed, const Command& command) {
  return Displaced(believed.X_StationaryMoving, command.displacement);
}

BelievedPose WithErrorsScaled(BelievedPose believed, double scale) {
  believed.errors *= scale;
  believed.tolerances *= scale;
  return believed;
}

// Gathers the unwanted contacts as errors grow.
class Ladder {
 public:
  using Nearby = MotionChecker::Nearby;

  Ladder(const Command& command, const Nearby& nearby) : touched_(TouchedIn(command)) {
    for (const ContactKey& key : touched_) KeepContact(key, nearby);
  }

  // Adds the unwanted contacts and losses of this enlargement, except those of lesser enlargements.
  void Add(double scale, const std::vector<Unwanted>& unwanted, const Nearby& nearby) {
    for (const Unwanted& added : unwanted) {
      if (std::ranges::any_of(unwanted_, [&](const Unwanted& known) {
            return known.contact == added.contact && known.is_loss == added.is_loss;
          })) {
        continue;
      }
      unwanted_.push_back({added.contact, added.is_loss, scale});
      KeepContact(added.contact, nearby);
    }
  }

  // Adds everything near, for a motion that may never end and may meet anything.
  void AddAll(double scale, const Nearby& nearby) {
    std::vector<Unwanted> all;
    const auto add = [&](const ContactKey& key) {
      const bool is_wanted = std::ranges::find(touched_, key) != touched_.end();
      all.push_back({key, is_wanted});
    };
    for (const PrimitiveContact& contact : nearby.contacts) add(KeyOf(contact));
    for (const ParallelEdges& edges : nearby.parallel) add(KeyOf(edges));
    Add(scale, all, nearby);
  }

  const std::vector<Unwanted>& unwanted() const { return unwanted_; }

  std::vector<PrimitiveContact> Contacts() && {
    std::ranges::sort(contacts_, {}, [](const auto& contact) { return KeyOf(contact); });
    return std::move(contacts_);
  }

 private:
  void KeepContact(const ContactKey& key, const Nearby& nearby) {
    if (Find(contacts_, key) != nullptr) return;
    if (const PrimitiveContact* contact = Find(nearby.contacts, key)) {
      contacts_.push_back(*contact);
      return;
    }
    for (const ParallelEdges& edges : nearby.parallel) {
      if (KeyOf(edges) == key) contacts_.push_back(edges.contact);
    }
  }

  std::vector<ContactKey> touched_;
  std::vector<Unwanted> unwanted_;
  std::vector<PrimitiveContact> contacts_;
};

}  // namespace

double FrictionLimitOf(const CertainMotion& motion) {
  return FrictionLimit(CopiesOf(motion.contacts, motion.command.kept), motion.command.displacement);
}

MotionChecker::MotionChecker(const Polyhedron& moving, const ContactFinder& finder,
                             const Options& options)
    : finder_(finder), options_(options) {
  for (const OuterVertex& vertex : moving.vertices) size_ = std::max(size_, vertex.p.norm());
}

MotionChecker MotionChecker::WithoutVelocityErrors() const {
  MotionChecker checker = *this;
  checker.options_.velocity_error = 0;
  return checker;
}

std::vector<PrimitiveContact> MotionChecker::ContactsWithin(double reach,
                                                            const Pose& X_StationaryMoving) const {
  return finder_.Near(X_StationaryMoving, {.reach = reach, .turn = options_.turn});
}

std::vector<PrimitiveContact> MotionChecker::Of(std::span<const ContactKey> keys,
                                                const Pose& X_StationaryMoving) const {
  return finder_.Of(keys, X_StationaryMoving, options_.turn);
}

MotionChecker::Nearby MotionChecker::NearTheWay(const BelievedPose& believed,
                                                const Command& command, double scale) const {
  const Pose end = EndOf(believed, command);
  Nearby touching{Of(TouchedIn(command), end), {}};
  const SegmentModel model{touching.contacts, scale * options_.velocity_error, options_.radius};
  ContactRange range = RangeOf(model, WithErrorsScaled(believed, scale), command, size_);
  range.turn = std::max(options_.turn, range.turn);
  Nearby nearby{finder_.Near(end, range), finder_.NearlyParallel(end, range)};
  // The contacts of the command stay in the model even if errors can turn their edges until these
  // edges are parallel. The contacts are linear within their limits, and the limits show when a
  // contact is lost.
  for (PrimitiveContact& contact : touching.contacts) {
    const ContactKey key = KeyOf(contact);
    std::erase_if(nearby.parallel, [&](const ParallelEdges& edges) { return KeyOf(edges) == key; });
    if (Find(nearby.contacts, key) == nullptr) nearby.contacts.push_back(std::move(contact));
  }
  return nearby;
}

SegmentCheck MotionChecker::Check(const Nearby& nearby, const BelievedPose& believed,
                                  const Command& command, Telling telling, double scale) const {
  const SegmentModel model{nearby.contacts, scale * options_.velocity_error, options_.radius,
                           options_.test, nearby.parallel};
  if (scale == 1) return finemotion::Check(model, believed, command, telling);
  return finemotion::Check(model, WithErrorsScaled(believed, scale), command, telling);
}

CertainMotion MotionChecker::Check(const BelievedPose& believed, const Command& command,
                                   Margins margins) const {
  CertainMotion motion{command, believed.X_StationaryMoving, {}};
  const Nearby nearby = NearTheWay(believed, command);
  const Telling telling = margins == Margins::kNone ? Telling::kFirst : Telling::kAll;
  motion.check = Check(nearby, believed, command, telling);
  if (motion.check.certain) {
    motion.X_StationaryAfter = motion.check.after.X_StationaryMoving;
    motion.can_be_held =
        CanHold(CopiesOf(nearby.contacts, command.kept), command.displacement, options_.friction);
    motion.check.certain = !motion.can_be_held;
  }
  if (margins == Margins::kNone) return motion;
  Ladder ladder(command, nearby);
  ladder.Add(1, motion.check.unwanted, nearby);
  const bool ends = motion.check.certain || motion.can_be_held || !motion.check.unwanted.empty();
  for (const double scale : kLadder) {
    if (scale == 1 || !ends) continue;
    if (margins == Margins::kLeast && !ladder.unwanted().empty()) break;
    const Nearby wider = NearTheWay(believed, command, scale);
    const SegmentCheck check = Check(wider, believed, command, Telling::kAll, scale);
    ladder.Add(scale, check.unwanted, wider);
    if (!check.certain && check.unwanted.empty()) ladder.AddAll(scale, wider);
    motion.check.comparison += check.comparison;
  }
  motion.check.unwanted = ladder.unwanted();
  motion.contacts = std::move(ladder).Contacts();
  return motion;
}

}  // namespace assay::finemotion
