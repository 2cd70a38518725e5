#include "planner/plan/data/strategy.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace assay::plan {
namespace {

// Finds what is wrong with the numbers of a strategy.
class FormCheck {
 public:
  explicit FormCheck(const Strategy& strategy) : strategy_(strategy) {}

  std::vector<std::string> Run() {
    Require(IsFrame(strategy_.X_HeldTip), "X_HeldTip is no frame");
    Require(IsFrame(strategy_.X_FixedStart), "X_FixedStart is no frame");
    Require(!strategy_.motions.empty(), "it has no motions");
    for (const StrategyContact& contact : strategy_.contacts) CheckContact(contact);
    for (std::size_t i = 0; i < strategy_.motions.size(); ++i) CheckMotion(i);
    Require(IsAtLeast(0, strategy_.friction), "its friction is below 0");
    Require(IsAtLeast(0, strategy_.length) && strategy_.length > 0, "its length is not above 0");
    CheckCertificate();
    return std::move(flaws_);
  }

 private:
  static bool IsFrame(const Pose& X) {
    const geometry::Matrix3 R = X.linear();
    return X.matrix().allFinite() && R.determinant() > 0 &&
           (R.transpose() * R).isApprox(geometry::Matrix3::Identity(), kUnit);
  }
  static bool IsAtLeast(double low, double number) {
    return std::isfinite(number) && number >= low;
  }

  void CheckContact(const StrategyContact& contact) {
    Require(std::abs(contact.normal.norm() - 1) <= kUnit,
            fmt::format("the normal of {} is not of unit length", contact.name));
    Require(contact.at.allFinite(), fmt::format("{} is nowhere", contact.name));
  }

  void CheckMotion(std::size_t index) {
    const StrategyMotion& motion = strategy_.motions[index];
    const auto require = [&](bool holds, const std::string& what) {
      Require(holds, fmt::format("motion {}: {}", index + 1, what));
    };
    require(IsFrame(motion.X_FixedTip), "X_FixedTip is no frame");
    for (const int kept : motion.kept) require(IsContact(kept), fmt::format("no contact {}", kept));
    if (motion.until)
      require(IsContact(*motion.until), fmt::format("no contact {}", *motion.until));
    require(!motion.until || std::ranges::count(motion.kept, *motion.until) == 0,
            "it waits for a contact that it keeps");
    require(IsAtLeast(0, motion.beyond), "`beyond` is negative");
    for (const UnwantedContact& unwanted : motion.unwanted) {
      const int contact = unwanted.contact;
      require(IsContact(contact), fmt::format("no contact {}", contact));
      require(unwanted.is_loss == Wants(motion, contact),
              fmt::format("contact {} is {}", contact,
                          unwanted.is_loss ? "not there to be lost" : "wanted and unwanted"));
      require(IsAtLeast(0, unwanted.scale), fmt::format("the scale of contact {}", contact));
      require(std::isfinite(unwanted.gap), fmt::format("the gap of contact {}", contact));
      require(IsAtLeast(0, unwanted.separation) && unwanted.separation <= 1,
              fmt::format("the separation of contact {}", contact));
      const auto& likely = unwanted.likely;
      require(!likely || (likely->d.allFinite() && likely->w.allFinite()),
              fmt::format("the likely error of contact {}", contact));
    }
  }

  void CheckCertificate() {
    const StrategyCertificate& certificate = strategy_.certificate;
    Require((certificate.d.array() >= 0).all() && certificate.d.allFinite() &&
                (certificate.w.array() >= 0).all() && certificate.w.allFinite(),
            "a half width of its errors is below 0");
    Require(certificate.w.norm() < M_PI / 2, "it is to absorb turns of more than a right angle");
    Require(IsAtLeast(0, certificate.velocity), "the error of its velocity is below 0");
    Require(IsAtLeast(strategy_.friction, certificate.friction),
            fmt::format("friction of {:.4g} could hold the part, and there may be {:.4g}",
                        certificate.friction, strategy_.friction));
    Require(
        IsAtLeast(1, certificate.absorbed),
        fmt::format("it absorbs {:.4g} times the errors, and 1 is needed", certificate.absorbed));
  }

  static bool Wants(const StrategyMotion& motion, int contact) {
    return std::ranges::count(ContactsAfter(motion), contact) > 0;
  }

  bool IsContact(int index) const { return index >= 0 && index < std::ssize(strategy_.contacts); }

  void Require(bool holds, std::string what) {
    if (!holds) flaws_.push_back(std::move(what));
  }

  const Strategy& strategy_;
  std::vector<std::string> flaws_;
};

}  // namespace

std::vector<StrategyContact> ContactsAt(const Strategy& strategy, const std::vector<int>& indices) {
  std::vector<StrategyContact> those;
  for (const int index : indices)
    those.push_back(strategy.contacts[static_cast<std::size_t>(index)]);
  return those;
}

std::vector<int> ContactsAfter(const StrategyMotion& motion) {
  std::vector<int> contacts = motion.kept;
  if (motion.until) contacts.push_back(*motion.until);
  return contacts;
}

std::vector<int> ContactsInError(const StrategyMotion& motion, const UnwantedContact& unwanted) {
  std::vector<int> contacts = unwanted.is_loss ? ContactsAfter(motion) : motion.kept;
  if (unwanted.is_loss) {
    std::erase(contacts, unwanted.contact);
  } else {
    contacts.push_back(unwanted.contact);
  }
  return contacts;
}

bool Absorbs(const std::optional<Strategy>& strategy, Condition condition) {
  return strategy && strategy->certificate.absorbed >= 1 &&
         std::ranges::count(strategy->certificate.absorbs, condition) > 0;
}

std::vector<std::string> FlawsOfForm(const Strategy& strategy) { return FormCheck(strategy).Run(); }

}  // namespace assay::plan
