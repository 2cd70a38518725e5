#include "planner/finemotion/strategy_checks/strategy_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "planner/finemotion/strategy_checks/exact_replay.h"

namespace assay::finemotion {

namespace {

// Numbers in the file are rounded, so results that are computed again may differ by these amounts.
constexpr double kRounding = 0.999;  // factor by which the errors are reduced
constexpr double kPlace = kLost;     // metres by which gaps and poses may differ
constexpr double kDirection = 1e-3;  // radians by which directions may differ
constexpr double kGreatestTurn = 1.5 * kLinearTurn;
constexpr double kNoTurn = 1e-9;  // radians; less is rounding
// The length that a motion may need may differ by this fraction of the motion's length.
constexpr double kFarther = 1e-3;

bool AreSame(const Pose& a, const Pose& b) {
  const PoseChange z = Between(a, b);
  return z.head<3>().norm() <= kPlace && z.tail<3>().norm() <= kDirection;
}

// Returns the motion's name in plans, which count from 1.
std::string Motion(std::size_t index) { return fmt::format("motion {}", index + 1); }

// Replays a strategy with a multiple of the errors.
class StrategyReplay {
 public:
  StrategyReplay(const MatingGeometry& geometry, const FineMotionErrors& errors,
                 const plan::Strategy& strategy)
      : geometry_(geometry),
        errors_(errors),
        strategy_(strategy),
        checker_(CheckerFor(geometry.passage, errors, OptionsOf(strategy))),
        maneuvering_(geometry.passage, geometry.passage.critical_points() - 1, checker_, 0) {}

  std::vector<std::string> Run() {
    CheckFrames();
    CheckSlides();
    ReadContacts();
    const double absorbed = strategy_.certificate.absorbed;
    if (flaws_.empty()) Replay(1, Margins::kAll);
    if (flaws_.empty() && absorbed > 1) Replay(absorbed, Margins::kNone);
    if (flaws_.empty()) ReplayExactly();
    return std::move(flaws_);
  }

 private:
  // --- Checks without motions.

  void CheckFrames() {
    if (!AreSame(strategy_.X_HeldTip, geometry_.X_HeldTip))
      Add("X_HeldTip is not the mating's tip");
    if (!AreSame(strategy_.motions.back().X_FixedTip, geometry_.X_FixedSeat))
      Add("{}: it does not lead to the seat", Motion(strategy_.motions.size() - 1));
  }

  // Checks that the last motion slides in, that no other motion does, and that it names no
  // contacts.
  void CheckSlides() {
    for (std::size_t i = 0; i < strategy_.motions.size(); ++i) {
      const plan::StrategyMotion& motion = strategy_.motions[i];
      const bool is_last = i + 1 == strategy_.motions.size();
      if (motion.slides != is_last)
        Add("{}: {}", Motion(i),
            is_last ? "the last one must slide in" : "only the last one slides in");
      if (motion.slides && (!motion.kept.empty() || motion.until))
        Add("{}: a motion that slides in must not name contacts", Motion(i));
    }
  }

  void ReadContacts() {
    for (const plan::StrategyContact& contact : strategy_.contacts) {
      const std::optional<ContactKey> key = ContactNamed(contact.name);
      if (!key) Add("'{}' is no contact's name", contact.name);
      keys_.push_back(key.value_or(ContactKey{}));
    }
  }

  // --- The replay.

  void Replay(double multiple, Margins margins) {
    multiple_ = multiple;
    BelievedPose believed = BelievedPoseIn(strategy_.X_FixedStart, errors_, kRounding * multiple);
    if (!maneuvering_.IsReached(believed)) return Add("the start is not surely free{}", Errors());
    const std::size_t slide = strategy_.motions.size() - 1;
    for (std::size_t i = 0; i < slide; ++i) {
      const std::optional<Command> command = CommandOf(i, believed);
      if (!command) return;
      const CertainMotion replayed = checker_.Check(believed, *command, margins);
      if (!replayed.check.certain) return Refuse(i, replayed);
      CompareLength(i, replayed);
      if (margins == Margins::kAll) CompareClaims(i, replayed);
      Remember(i, replayed);
      believed = replayed.check.after;
      believed.X_StationaryMoving = strategy_.motions[i].X_FixedTip;
    }
    if (!maneuvering_.IsThrough(believed))
      Add("{}: where it starts, the way in is not surely free{}", Motion(slide), Errors());
  }

  // Remembers a motion with the pose that the file has. A contact comes later with greater errors,
  // so the longest way is kept.
  void Remember(std::size_t index, const CertainMotion& replayed) {
    if (index == motions_.size()) motions_.push_back(replayed);
    CertainMotion& motion = motions_[index];
    motion.X_StationaryAfter = strategy_.motions[index].X_FixedTip;
    motion.check.longest = std::max(motion.check.longest, replayed.check.longest);
  }

  void ReplayExactly() {
    const StrategyOptions options = OptionsOf(strategy_);
    const ExactReplay replay{.passage = geometry_.passage,
                             .X_StationaryStart = strategy_.X_FixedStart,
                             .motions = motions_,
                             .radius = options.radius,
                             .velocity_error = errors_.velocity};
    const ExactReplays replays =
        ReplayWithErrors(replay, kRounding * strategy_.certificate.absorbed * errors_.pose,
                         options.drawn, options.seed);
    if (const auto& deviation = replays.deviation) {
      const PoseChange& error = deviation->error;
      Add("{}: in exact geometry the motion does not go as planned for errors of ({:.4g}) mm and "
          "({:.4g}) rad",
          Motion(deviation->motion), fmt::join(Vector3(1e3 * error.head<3>()), ", "),
          fmt::join(Vector3(error.tail<3>()), ", "));
    }
  }

  static StrategyOptions OptionsOf(const plan::Strategy& strategy) {
    return {.friction = strategy.friction, .radius = strategy.length};
  }

  // Returns the motion's command, or none if the motion cannot be checked.
  std::optional<Command> CommandOf(std::size_t index, const BelievedPose& believed) {
    const plan::StrategyMotion& motion = strategy_.motions[index];
    Command command{Between(believed.X_StationaryMoving, motion.X_FixedTip), {}, {}};
    if (command.displacement.tail<3>().isZero(kNoTurn)) command.displacement.tail<3>().setZero();
    for (const int kept : motion.kept) command.kept.push_back(KeyAt(kept));
    if (motion.until) command.until = KeyAt(*motion.until);
    for (const ContactKey& kept : command.kept) {
      if (std::ranges::count(believed.kept, kept) > 0) continue;
      Add("{}: it keeps {}, which does not touch", Motion(index), Name(kept));
      return std::nullopt;
    }
    const double turn = command.displacement.tail<3>().norm();
    if (turn <= kGreatestTurn) return command;
    Add("{}: it turns by {:.3g} rad; contacts are linear in {:.3g}", Motion(index), turn,
        kGreatestTurn);
    return std::nullopt;
  }

  // Adds the reason why a motion is not certain.
  void Refuse(std::size_t index, const CertainMotion& replayed) {
    if (replayed.can_be_held)
      return Add("{}: friction of {:.4g} can hold it", Motion(index), strategy_.friction);
    if (!replayed.check.unwanted.empty()) {
      const Unwanted& unwanted = replayed.check.unwanted.front();
      return Add("{}: {} may be {}{}", Motion(index), Name(unwanted.contact),
                 unwanted.is_loss ? "lost" : "made", Errors());
    }
    const Command& command = replayed.command;
    for (const int contact : plan::ContactsAfter(strategy_.motions[index])) {
      const ContactKey key = KeyAt(contact);
      if (checker_.Of({&key, 1}, strategy_.motions[index].X_FixedTip).empty())
        return Add("{}: contact {} does not exist at the end of the motion", Motion(index),
                   Name(key));
    }
    if (command.until)
      return Add("{}: {} may never be made{}", Motion(index), Name(*command.until), Errors());
    Add("{}: it cannot keep its contacts{}", Motion(index), Errors());
  }

  // --- Comparison of a certain motion with the file.

  void CompareLength(std::size_t index, const CertainMotion& replayed) {
    const plan::StrategyMotion& motion = strategy_.motions[index];
    if (!motion.until || motion.beyond >= replayed.check.longest - 1 - kFarther) return;
    Add("{}: the motion goes on beyond its end for at most {:.4g} of its length, but contact {} "
        "may come only {:.4g} of its length beyond the end{}",
        Motion(index), motion.beyond, Name(KeyAt(*motion.until)), replayed.check.longest - 1,
        Errors());
  }

  void CompareClaims(std::size_t index, const CertainMotion& replayed) {
    const plan::StrategyMotion& motion = strategy_.motions[index];
    for (const int contact : plan::ContactsAfter(motion)) {
      CompareContact(index, contact, replayed);
      const PrimitiveContact* found = Find(replayed.contacts, KeyAt(contact));
      if (found != nullptr && std::abs(found->offset) > kPlace)
        Add("{}: it leads {:.4g} mm beside {}", Motion(index), 1e3 * found->offset, Name(*found));
    }
    const double friction = FrictionLimitOf(replayed);
    if (strategy_.certificate.friction > friction / kRounding)
      Add("{}: friction of {:.4g} can hold it, and it is said to take {:.4g}", Motion(index),
          friction, strategy_.certificate.friction);
    for (const Unwanted& unwanted : replayed.check.unwanted) CompareScale(index, unwanted);
    for (const plan::UnwantedContact& stated : motion.unwanted) {
      if (!stated.is_loss) CompareContact(index, stated.contact, replayed);
      CompareGap(index, stated, replayed);
    }
  }

  void CompareContact(std::size_t index, int contact, const CertainMotion& replayed) {
    const plan::StrategyContact& claimed = strategy_.contacts[static_cast<std::size_t>(contact)];
    const PrimitiveContact* found = Find(replayed.contacts, KeyAt(contact));
    if (found == nullptr) return;
    if ((found->normal - claimed.normal).norm() > kDirection)
      Add("{}: the normal of {} is not ({:.4g}, {:.4g}, {:.4g})", Motion(index), claimed.name,
          claimed.normal.x(), claimed.normal.y(), claimed.normal.z());
    // The place where parallel edges are nearest depends on rounding.
    const Vector3 beside = found->at - claimed.at;
    const bool is_anywhere = found->limits.empty();
    const double distance = is_anywhere ? std::abs(found->normal.dot(beside)) : beside.norm();
    if (distance > kPlace)
      Add("{}: {} is {:.4g} mm from where it is said to be", Motion(index), claimed.name,
          1e3 * distance);
  }

  // Compares the scale of an unwanted contact. If a face has several regions, the file has only the
  // least of their scales, because the contact with this scale comes first.
  void CompareScale(std::size_t index, const Unwanted& unwanted) {
    const std::vector<plan::UnwantedContact>& stated = strategy_.motions[index].unwanted;
    const auto claimed = std::ranges::find_if(
        stated, [&](const auto& one) { return KeyAt(one.contact) == unwanted.contact; });
    const char* const happens = unwanted.is_loss ? "lost" : "made";
    if (claimed == stated.end())
      return Add("{}: the file does not name contact {}, which may be {} with {} times the errors",
                 Motion(index), Name(unwanted.contact), happens, unwanted.scale);
    if (claimed->scale > unwanted.scale)
      Add("{}: {} is said to be {} with {} times the errors, and may be with {}", Motion(index),
          Name(unwanted.contact), happens, claimed->scale, unwanted.scale);
  }

  void CompareGap(std::size_t index, const plan::UnwantedContact& stated,
                  const CertainMotion& replayed) {
    const PrimitiveContact* found = Find(replayed.contacts, KeyAt(stated.contact));
    if (found == nullptr || stated.gap <= found->offset + kPlace) return;
    Add("{}: the gap of {} is said to be {:.4g} mm, and is {:.4g}", Motion(index), Name(*found),
        1e3 * stated.gap, 1e3 * found->offset);
  }

  const ContactKey& KeyAt(int contact) const { return keys_[static_cast<std::size_t>(contact)]; }

  // Returns the multiple of the errors with which a flaw is found, as text.
  std::string Errors() const {
    return multiple_ == 1 ? ""
                          : fmt::format(" with {:.4g} times the errors, which it is said to absorb",
                                        multiple_);
  }

  template <class... Values>
  void Add(fmt::format_string<Values...> text, Values&&... values) {
    flaws_.push_back(fmt::format(text, std::forward<Values>(values)...));
  }

  const MatingGeometry& geometry_;
  const FineMotionErrors errors_;
  const plan::Strategy& strategy_;
  const MotionChecker checker_;
  const Maneuvering maneuvering_;  // maneuvers at the last critical point, where the strategy ends
  std::vector<ContactKey> keys_;   // keys of the strategy's contacts
  std::vector<CertainMotion> motions_;
  double multiple_ = 1;
  std::vector<std::string> flaws_;
};

}  // namespace

std::vector<std::string> FlawsOfStrategy(const MatingGeometry& geometry,
                                         const plan::Strategy& strategy) {
  return StrategyReplay(geometry, ErrorsOf(strategy.certificate, geometry), strategy).Run();
}

}  // namespace assay::finemotion
