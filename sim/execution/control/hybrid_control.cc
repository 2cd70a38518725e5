#include "sim/execution/control/hybrid_control.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "sim/execution/control/awaited_contact.h"

namespace assay::execution {
namespace {

constexpr double kStalled = 0.3;       // seconds without progress along a crevice
constexpr double kCreviceEnd = 0.002;  // metres to which the end of a crevice is known
constexpr double kNoWay = 1e-9;        // metres or radians; a shorter motion counts as none

bool CanBeLeft(TrialOutcome error) {
  return error == TrialOutcome::kJammed || error == TrialOutcome::kWrongContact ||
         error == TrialOutcome::kTimeout;
}

}  // namespace

bool LetsGo(const plan::Strategy& strategy, std::size_t motion) {
  if (motion == 0) return false;
  const auto names_of = [&](const std::vector<int>& contacts) {
    std::set<std::string> names;
    for (const auto& contact : plan::ContactsAt(strategy, contacts)) names.insert(contact.name);
    return names;
  };
  return !std::ranges::includes(names_of(strategy.motions[motion].kept),
                                names_of(plan::ContactsAfter(strategy.motions[motion - 1])));
}

HybridControl::HybridControl(const plan::Strategy& strategy, PartId fixed, const ControlLaw& law,
                             Execution& execution)
    : strategy_(strategy),
      law_(law),
      execution_(execution),
      fixed_(fixed),
      arm_(execution, fixed, strategy.X_HeldTip, law),
      contacts_(strategy),
      correction_(strategy, contacts_, arm_) {}

StrategyEnd HybridControl::Run(const MotionObserver& observer) {
  observer_ = observer;
  StrategyEnd end;
  for (attempt_ = 1;; ++attempt_) {
    correction_.BeginAttempt();
    Ended error = RunOnce();
    end.ignored = ignored_;
    in_doubt_ = true;
    if (!error) return end;
    if (attempt_ < law_.attempts && CanBeLeft(error->outcome)) {
      correction_.LearnError(*error);
      end.recovered.push_back(*std::move(error));
      error = DrawBack();
      if (!error) continue;
    }
    end.outcome = error->outcome;
    end.reason = error->reason;
    end.motion = error->motion;
    end.recognized = std::move(error->recognized);
    end.time = error->time;
    end.holding = error->holding;
    return end;
  }
}

HybridControl::Ended HybridControl::RunOnce() {
  for (std::size_t i = 0; i < strategy_.motions.size(); ++i) {
    motion_ = static_cast<int>(i);
    Ended error = RunMotion(i);
    if (error && !error->recognized) error->recognized = Recognized(strategy_.motions[i]);
    Record(error ? *error : Passed());
    if (error) return error;
  }
  return std::nullopt;
}

void HybridControl::Record(const ErrorState& end) {
  execution_.trace().events.push_back(MotionRecord{.time = end.time,
                                                   .step = execution_.step(),
                                                   .motion = end.motion,
                                                   .attempt = attempt_,
                                                   .outcome = end.outcome,
                                                   .recognized = end.recognized});
}

ErrorState HybridControl::Passed() const {
  ErrorState passed = Error(TrialOutcome::kSucceeded, {});
  if (!ignored_.empty() && ignored_.back().motion == motion_)
    passed.recognized = ignored_.back().recognized;
  return passed;
}

// Returns the unwanted contact that the forces show. If an error state was ignored, the arm is not
// where the plan expects it. In this case the unwanted contact of that error state is returned.
std::optional<RecognizedContact> HybridControl::Recognized(
    const plan::StrategyMotion& motion) const {
  if (!ignored_.empty()) return ignored_.front().recognized;
  const auto error = Recognize(contacts_.Strategy(), motion, felt_.wrench);
  if (!error) return std::nullopt;
  return Named(*error, felt_.time);
}

RecognizedContact HybridControl::Named(const plan::UnwantedContact& unwanted, double time) const {
  return {contacts_.Planned(unwanted.contact).name, unwanted.is_loss, time};
}

HybridControl::Ended HybridControl::CheckState(const plan::StrategyMotion& motion) {
  const plan::Strategy found = contacts_.Strategy();
  if (IsAsPlanned(found, motion, felt_.wrench)) return std::nullopt;
  ErrorState wrong =
      Error(TrialOutcome::kWrongContact, "forces that no contacts of the plan explain");
  // Two wrenches are examined, because other contacts may have been made after the contact that
  // ended the motion.
  for (const Feeling& felt : {first_felt_, felt_}) {
    if (IsAsPlanned(found, motion, felt.wrench)) continue;
    const auto unwanted = Recognize(found, motion, felt.wrench);
    if (!unwanted) continue;
    wrong.recognized = Named(*unwanted, felt.time);
    break;
  }
  if (attempt_ < law_.attempts) return wrong;
  in_doubt_ = true;
  ignored_.push_back(std::move(wrong));
  return std::nullopt;
}

HybridControl::Ended HybridControl::DrawBack() {
  constexpr double kAbove = 0.01;  // metres above the start, where the part can be turned
  const Vector3 out = WayOut();
  Pose X_FixedStart = strategy_.X_FixedStart;
  const Vector3 start = X_FixedStart.translation();
  arm_.TakeStock();
  const Vector6 up = law_.contact_speed * Joined(out, Vector3::Zero());
  while (out.dot(arm_.MeasuredTip().translation() - start) < kAbove) {
    if (Ended error = Step({.yielding = up + YieldingAcross(up)})) return error;
    if (arm_.wrench().head<3>().dot(-out) > law_.obstructing_force)
      return Error(TrialOutcome::kWedged, "the arm cannot draw the part back");
  }
  arm_.TakeStock();
  X_FixedStart.translation() = start + kAbove * out;
  if (Ended error = MoveAlong(WayTo(X_FixedStart, {law_.free_speed, law_.turning_speed}),
                              contacts_.Pressed({})))
    return error;
  X_FixedStart.translation() = start;
  return MoveAlong(WayTo(X_FixedStart, {law_.contact_speed, law_.contact_turning_speed}),
                   contacts_.Pressed({}));
}

// Returns the direction opposite to the last motion.
Vector3 HybridControl::WayOut() const {
  const auto& motions = strategy_.motions;
  const Pose& before =
      motions.size() > 1 ? motions[motions.size() - 2].X_FixedTip : strategy_.X_FixedStart;
  return (before.translation() - motions.back().X_FixedTip.translation()).normalized();
}

HybridControl::Way HybridControl::WayTo(const Pose& X_FixedTip, Speed speed) const {
  const Vector6 twist = TwistBetween(arm_.MeasuredTip(), X_FixedTip);
  const double length = twist.head<3>().norm() + kNoWay;
  const double angle = twist.tail<3>().norm() + kNoWay;
  return {.twist = twist,
          .rate = std::min(speed.shift / length, speed.turn / angle),
          .acceleration = std::min(law_.acceleration / length, law_.turning_acceleration / angle)};
}

HybridControl::Speed HybridControl::SpeedOf(const plan::StrategyMotion& motion) const {
  if (motion.until || in_doubt_) return {law_.contact_speed, law_.contact_turning_speed};
  const bool is_free = motion.kept.empty() && !motion.slides;
  return {is_free ? law_.free_speed : law_.sliding_speed, law_.turning_speed};
}

double HybridControl::NextRate(const Way& way, double rate, double left) const {
  const double change = way.acceleration * arm_.NextPeriod();
  // The arm can still brake after one more step at this rate.
  const double braking = std::sqrt(change * change + 2 * way.acceleration * left) - change;
  return std::min({way.rate, rate + change, braking});
}

HybridControl::Ended HybridControl::RunMotion(std::size_t index) {
  const plan::StrategyMotion& motion = strategy_.motions[index];
  // The commanded pose of a part that presses on a contact is beyond the contact.
  if (LetsGo(strategy_, index)) arm_.TakeStock();
  arm_.Linearize();
  first_felt_ = {};
  const Way way = WayTo(motion.X_FixedTip, SpeedOf(motion));
  if (motion.slides) return Slide(way);
  if (motion.until) return MoveUntil(motion, way);
  const PressedContacts kept = contacts_.Pressed(motion.kept);
  if (Ended error = MoveAlong(way, kept)) return error;
  if (Ended error = CheckState(motion)) return error;
  correction_.LearnKept(kept, motion.X_FixedTip);
  return std::nullopt;
}

HybridControl::Ended HybridControl::MoveAlong(const Way& way, const PressedContacts& kept) {
  constexpr double kEnd = 1e-3;  // fraction of the way that is not worth a timestep
  double gone = 0;
  double rate = 0;
  while (gone < 1 - kEnd) {
    rate = NextRate(way, rate, 1 - gone);
    if (Ended error = Step(Hybrid(kept, rate * way.twist))) return error;
    if (Ended error = CheckObstruction(kept)) return error;
    gone += arm_.period() * rate;
  }
  return Settle(kept);
}

// Moves until the awaited contact is made. If it did not come in an earlier attempt, the errors are
// greater than they should be. Later attempts therefore go farther.
HybridControl::Ended HybridControl::MoveUntil(const plan::StrategyMotion& motion, const Way& way) {
  const std::vector<int> after = plan::ContactsAfter(motion);
  PressedContacts kept = contacts_.Pressed(motion.kept);
  AwaitedContact awaited(static_cast<int>(motion.kept.size()), SeemingForce(motion, kept, way),
                         law_);
  const double latest = 1 + attempt_ * motion.beyond + Slack(*motion.until, way);
  double gone = 0;
  double rate = 0;
  for (double waited = 0; waited < law_.settling;) {
    rate = gone < latest ? NextRate(way.At(awaited.Pace()), rate, latest - gone) : 0;
    if (Ended error = Step(Hybrid(kept, rate * way.twist))) return error;
    const double dt = arm_.period();
    const PressedContacts touched = contacts_.Pressed(after);
    awaited.Feel(touched.Forces(arm_.wrench()), dt);
    if (awaited.IsMade()) return Make(motion, way, rate, kept);
    if (Ended error = CheckObstruction(touched)) return error;
    if (awaited.IsApart()) {
      kept.Locate(arm_.wrench(), std::min(1.0, dt / law_.location_filter));
      contacts_.Remember(motion.kept, kept);
    }
    gone += dt * rate;
    if (rate == 0) waited += dt;
  }
  return Error(TrialOutcome::kTimeout,
               fmt::format("no contact of {}", contacts_.Planned(*motion.until).name));
}

// Kept contacts may slide toward the awaited one. Their friction is then a force that seems to come
// from the awaited contact.
double HybridControl::SeemingForce(const plan::StrategyMotion& motion, const PressedContacts& kept,
                                   const Way& way) const {
  constexpr double kRipple = 1.5;  // factor by which pressing forces may exceed their command
  const Vector6 sliding = Hybrid(kept, way.twist).planned;
  Vector6 wrench = Vector6::Zero();
  for (const plan::StrategyContact& contact : kept.contacts()) {
    const Vector3 along = sliding.head<3>() + sliding.tail<3>().cross(contact.at);
    const Vector3 force =
        law_.pressing_force * (contact.normal - strategy_.friction * along.normalized());
    wrench += Joined(force, contact.at.cross(force));
  }
  const double seeming = contacts_.Pressed(plan::ContactsAfter(motion)).Forces(wrench).tail<1>()[0];
  return kRipple * std::max(0.0, seeming);
}

HybridControl::Ended HybridControl::Make(const plan::StrategyMotion& motion, const Way& way,
                                         double rate, const PressedContacts& kept) {
  first_felt_ = felt_;
  if (Ended error = Brake(Hybrid(kept, rate * way.twist))) return error;
  if (Ended error = Settle(contacts_.Pressed(plan::ContactsAfter(motion)))) return error;
  if (Ended error = CheckState(motion)) return error;
  correction_.LearnKept(kept, motion.X_FixedTip);
  correction_.LearnMade(*motion.until, motion.X_FixedTip, Hybrid(kept, way.twist).planned);
  return std::nullopt;
}

HybridControl::Ended HybridControl::CheckObstruction(const PressedContacts& contacts) {
  const double force = contacts.Unexplained(arm_.wrench());
  obstructed_ = force > law_.obstructing_force ? obstructed_ + arm_.period() : 0;
  if (obstructed_ <= law_.obstruction_duration) return std::nullopt;
  return Error(TrialOutcome::kWrongContact,
               fmt::format("{:.0f} N that no contact of the plan explains", force));
}

// Slides along a crevice, in which there is one way to go. The walls guide the part: the hand
// yields to all forces across the way. The greater the resistance along the way, the slower the
// hand moves. The walls then have time to guide the part.
HybridControl::Ended HybridControl::Slide(const Way& way) {
  const double length = way.twist.norm();
  const Vector6 direction = way.twist / length;
  double gone = 0;
  double stalled = 0;
  while (gone < length + kCreviceEnd && stalled < kStalled) {
    const double resistance = std::max(0.0, -direction.dot(arm_.wrench()));
    const bool near = in_doubt_ || std::min(gone, length - gone) < law_.seating_length;
    const double speed = near ? law_.contact_speed : law_.sliding_speed;
    const double share = std::clamp(1 - resistance / law_.pushing_force, 0.0, 1.0);
    const Vector6 yielding = share * speed * direction + YieldingAcross(direction);
    if (Ended error = Step({.yielding = yielding})) return error;
    gone += arm_.period() * direction.dot(arm_.velocity().yielding);
    stalled = share < 0.02 ? stalled + arm_.period() : 0;
  }
  if (length - gone < kCreviceEnd) return std::nullopt;
  return Stuck(direction, length - gone);
}

// Returns the error state of a stuck part, which is jammed or wedged (Whitney 1982). A wedged part
// is held between the walls whatever the hand does.
HybridControl::Ended HybridControl::Stuck(const Vector6& direction, double left) {
  constexpr double kBack = 0.002;  // metres to draw back
  ErrorState stuck =
      Error(TrialOutcome::kJammed, fmt::format("stuck {:.1f} mm before its end", 1e3 * left));
  stuck.holding = TrueHolding(execution_, fixed_, strategy_.X_HeldTip,
                              direction.head<3>().normalized(), strategy_.length);
  for (double gone = 0; gone < kBack; gone += arm_.period() * law_.contact_speed) {
    if (Ended error = Step({.yielding = -law_.contact_speed * direction})) return error;
    if (direction.dot(arm_.wrench()) > law_.obstructing_force) {
      stuck.outcome = TrialOutcome::kWedged;
      break;
    }
  }
  return stuck;
}

// Returns how much farther the part may go until the contact is pressed, as a multiple of the way.
// The parts may be a little farther apart than errors explain.
double HybridControl::Slack(int contact, const Way& way) const {
  const auto& awaited = contacts_.Planned(contact);
  const Vector6 row = Joined(awaited.normal, awaited.at.cross(awaited.normal));
  return law_.slack / std::max(law_.slack, -row.dot(way.twist));
}

// Stops quickly. If the part stopped slowly, it would turn about the contact that it has made, and
// would lose other contacts.
HybridControl::Ended HybridControl::Brake(const TipMotion& motion) {
  TipMotion slower = motion;
  for (double time = 0; time < law_.braking; time += arm_.period()) {
    slower.planned = (1 - std::min(1.0, (time + arm_.period()) / law_.braking)) * motion.planned;
    if (Ended error = Step(slower)) return error;
  }
  arm_.TakeStock();
  return std::nullopt;
}

// Waits until all contacts are pressed on average, but at most five times as long as usual.
HybridControl::Ended HybridControl::Settle(const PressedContacts& contacts) {
  double least = contacts.empty() ? law_.touching_force : 0;  // newtons
  double share = 0;
  for (double time = 0; time < 1 || (time < 5 && least < law_.touching_force / 2); time += share) {
    if (Ended error = Step(Hybrid(contacts, Vector6::Zero()))) return error;
    share = arm_.period() / law_.settling;
    if (contacts.empty()) continue;
    least += 5 * share * (contacts.Forces(arm_.wrench()).minCoeff() - least);
  }
  return std::nullopt;
}

// Removes from the wanted twist the components along the normals of kept contacts. Along these
// normals, the arm only yields to the force, so the part stays where it is.
TipMotion HybridControl::Hybrid(const PressedContacts& contacts, const Vector6& wanted) const {
  if (contacts.empty()) return {.planned = wanted};
  const PressedContacts::Rows& rows = contacts.rows();
  const Eigen::VectorXd excess =
      contacts.Forces(arm_.wrench()) - Eigen::VectorXd::Constant(rows.rows(), law_.pressing_force);
  const Vector6 yielding = law_.relaxation * arm_.compliance() * rows.transpose() * excess;
  const Eigen::VectorXd opens = rows * yielding;
  const double most = std::max(
      {1.0, opens.maxCoeff() / law_.yielding_speed, -opens.minCoeff() / law_.seeking_speed});
  return {wanted - contacts.Opening(rows * wanted), yielding / most};
}

Vector6 HybridControl::YieldingAcross(const Vector6& direction) const {
  const auto across = [&](const Vector6& v) -> Vector6 {
    return v - direction * direction.dot(v) / direction.squaredNorm();
  };
  return across(law_.relaxation * arm_.compliance() * across(arm_.wrench()));
}

HybridControl::Ended HybridControl::Step(const TipMotion& motion) {
  if (Progress failure = arm_.Step(motion)) return Error(failure->outcome, failure->reason);
  felt_.wrench +=
      std::min(1.0, arm_.period() / law_.recognition_filter) * (arm_.wrench() - felt_.wrench);
  felt_.time = arm_.data().time();
  if (observer_) observer_(arm_.data(), motion_);
  return std::nullopt;
}

ErrorState HybridControl::Error(TrialOutcome outcome, std::string reason) const {
  return {.outcome = outcome,
          .reason = fmt::format("motion {}: {}", motion_ + 1, reason),
          .motion = motion_,
          .recognized = {},
          .time = arm_.data().time()};
}

}  // namespace assay::execution
