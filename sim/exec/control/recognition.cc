#include "sim/exec/control/recognition.h"

#include <algorithm>

#include "planner/finemotion/replay/force_signature.h"
#include "sim/exec/control/pressed_contacts.h"

namespace assay::exec {
namespace {

constexpr double kTellingForce = 1;  // newtons that tell of contacts
// What is as unlikely as the other: such an angle (its sine) between a wrench and the signature
// that it is of; a contact so far beside where it is planned; or so much greater errors.
constexpr double kUsualSine = 0.1;
constexpr double kUsualSlip = 0.005;  // metres
constexpr double kUsualGrowth = 1.5;  // multiple of errors, above 1
// Unlikelinesses, sums of squares of the above. Where all went as planned (841 ends of motions),
// the planned state's was 0.7 at most, and where it was not the true one 6 at least.
constexpr double kExplained = 4;  // at most, of a state that explains a wrench
constexpr double kBetter = 1;     // by which one must be less to explain more than another
constexpr double kAlike = 0.1;    // separation of states that forces do not tell apart

// Weighs the states after one motion against what is felt.
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

  // That these contacts exert the wrench: where they are planned or, since edges that are nearly
  // parallel touch far from there, beside it.
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

  // What is made is needed to explain the wrench; what is lost is not.
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

}  // namespace assay::exec
