#include "sim/execution/control/recognition.h"

#include <algorithm>

#include "planner/finemotion/forces/force_signature.h"
#include "sim/execution/control/pressed_contacts.h"

namespace assay::execution {
namespace {

constexpr double kTellingForce = 1;  // newtons; a greater force gives information about contacts
// The next three constants are deviations that count as equally unlikely: the sine of the angle
// between a wrench and the signature of its state, the distance of a contact from its planned
// place, and the factor of the errors minus 1.
constexpr double kUsualSine = 0.1;
constexpr double kUsualSlip = 0.005;  // metres between a contact and its planned place
constexpr double kUsualGrowth = 1.5;  // factor of the errors, minus 1
// Limits of the unlikeliness, which is a sum of squares of these deviations. In 841 motions that
// went as planned, the unlikeliness of the planned state was at most 0.7 at the end. At the ends of
// other motions, where the planned state was not the true state, it was at least 6.
constexpr double kExplained = 4;  // greatest unlikeliness of a state that explains a wrench
// Least difference by which one state explains a wrench better than another.
constexpr double kBetter = 1;
constexpr double kAlike = 0.1;  // separation below which forces do not distinguish states

// Compares the states that are possible after one motion with the measured wrench.
class Weighing {
 public:
  Weighing(const plan::Strategy& strategy, const plan::StrategyMotion& motion,
           const Vector6& wrench)
      : strategy_(strategy), motion_(motion), wrench_(wrench) {}

  double OfPlan() const { return Unlikeliness(plan::ContactsAfter(motion_)); }

  std::optional<plan::UnwantedContact> Run() const {
    const double planned = OfPlan();
    const plan::UnwantedContact* likeliest = nullptr;
    double least = 0;
    for (const plan::UnwantedContact& unwanted : motion_.unwanted) {
      if (unwanted.is_loss && unwanted.contact == motion_.until) continue;
      const double as_felt = Unlikeliness(plan::ContactsInError(motion_, unwanted));
      if (!IsCandidate(unwanted, as_felt, planned)) continue;
      const double unlikely = as_felt + Square((unwanted.scale - 1) / kUsualGrowth);
      if (likeliest != nullptr && unlikely >= least) continue;
      least = unlikely;
      likeliest = &unwanted;
    }
    if (likeliest == nullptr) return std::nullopt;
    return *likeliest;
  }

 private:
  static double Square(double x) { return x * x; }

  // Returns how unlikely it is that these contacts exert the wrench, at their planned places or
  // beside them. Nearly parallel edges touch far from their planned places.
  double Unlikeliness(const std::vector<int>& indices) const {
    const std::vector<plan::StrategyContact> contacts = plan::ContactsAt(strategy_, indices);
    const double there = Square(SineOf(contacts) / kUsualSine);
    PressedContacts pressed(contacts);
    pressed.Locate(wrench_, 1);
    double slip = 0;
    for (std::size_t i = 0; i < contacts.size(); ++i)
      slip = std::max(slip, (pressed.contacts()[i].at - contacts[i].at).norm());
    if (!(Square(slip / kUsualSlip) < there)) return there;
    return std::min(there,
                    Square(slip / kUsualSlip) + Square(SineOf(pressed.contacts()) / kUsualSine));
  }

  double SineOf(const std::vector<plan::StrategyContact>& contacts) const {
    const auto signature = finemotion::SignatureOf(contacts, strategy_.friction);
    return finemotion::Separation(wrench_, signature, strategy_.length);
  }

  // Returns whether the unwanted event fits the felt wrench. `as_felt` is the unlikeliness of the
  // contact state after the event, and `planned` that of the planned state. A new contact fits if
  // the planned state does not explain the wrench, and the state with the contact explains it. A
  // lost contact fits if the state without the contact explains the wrench, and the planned state
  // does not explain it clearly better.
  static bool IsCandidate(const plan::UnwantedContact& unwanted, double as_felt, double planned) {
    if (unwanted.separation < kAlike || as_felt > kExplained) return false;
    if (unwanted.is_loss) return as_felt < planned + kBetter;
    return planned > kExplained && as_felt < planned - kBetter;
  }

  const plan::Strategy& strategy_;
  const plan::StrategyMotion& motion_;
  const Vector6& wrench_;
};

bool TellsOfContacts(const Vector6& wrench) { return wrench.head<3>().norm() > kTellingForce; }

}  // namespace

bool IsAsPlanned(const plan::Strategy& strategy, const plan::StrategyMotion& motion,
                 const Vector6& wrench) {
  return !TellsOfContacts(wrench) || Weighing(strategy, motion, wrench).OfPlan() <= kExplained;
}

std::optional<plan::UnwantedContact> Recognize(const plan::Strategy& strategy,
                                               const plan::StrategyMotion& motion,
                                               const Vector6& wrench) {
  if (!TellsOfContacts(wrench)) return std::nullopt;
  return Weighing(strategy, motion, wrench).Run();
}

}  // namespace assay::execution
