#include "sim/execution/control/tip_correction.h"

#include <algorithm>

namespace assay::execution {

void TipCorrection::LearnKept(const PressedContacts& kept, const Pose& X_FixedTip) {
  const Vector6 off = TwistBetween(X_FixedTip, arm_.MeasuredTip());
  arm_.Correct(-kept.Opening(kept.rows() * off));
}

// Corrects the believed pose of the tip along the way on which the contact was made. The contact
// shows how far the tip had really come on this way.
void TipCorrection::LearnMade(int contact, const Pose& X_FixedTip, const Vector6& along) {
  const auto& made = contacts_.Planned(contact);
  const Vector6 row = Joined(made.normal, made.at.cross(made.normal));
  arm_.Correct(-row.dot(TwistBetween(X_FixedTip, arm_.MeasuredTip())) / row.dot(along) * along);
}

// Returns the unwanted contact of the error state. If the awaited contact has not come and forces
// show nothing else, it is the loss of that contact.
const plan::UnwantedContact* TipCorrection::UnwantedIn(const ErrorState& error) const {
  const plan::StrategyMotion& motion = strategy_.motions[static_cast<std::size_t>(error.motion)];
  const auto is_it = [&](const plan::UnwantedContact& unwanted) {
    if (const auto& recognized = error.recognized)
      return contacts_.Planned(unwanted.contact).name == recognized->name &&
             unwanted.is_loss == recognized->is_loss;
    return error.outcome == TrialOutcome::kTimeout && unwanted.contact == motion.until;
  };
  const auto found = std::ranges::find_if(motion.unwanted, is_it);
  return found == motion.unwanted.end() ? nullptr : &*found;
}

void TipCorrection::LearnError(const ErrorState& error) {
  const plan::UnwantedContact* unwanted = UnwantedIn(error);
  if (unwanted == nullptr) return;
  if (unwanted->likely) BelieveLikely(*unwanted->likely);
  if (!unwanted->is_loss)
    BelieveUnwanted(strategy_.motions[static_cast<std::size_t>(error.motion)], *unwanted);
}

// Corrects the believed pose by the likely errors. They refer to the believed pose at the start of
// the attempt, which has turned with the hand since.
void TipCorrection::BelieveLikely(const plan::TipError& likely) {
  arm_.Believe(X_TipTool_);
  const geometry::Matrix3 turn =
      arm_.MeasuredTip().linear() * strategy_.X_FixedStart.linear().transpose();
  arm_.Correct(Joined(turn * likely.d, turn * likely.w));
}

void TipCorrection::BelieveUnwanted(const plan::StrategyMotion& motion,
                                    const plan::UnwantedContact& unwanted) {
  const PressedContacts touching = contacts_.Pressed(plan::ContactsInError(motion, unwanted));
  // The gaps at the believed pose.
  Eigen::VectorXd gaps = touching.rows() * TwistBetween(motion.X_FixedTip, arm_.MeasuredTip());
  gaps.tail<1>()[0] += unwanted.gap;
  arm_.Correct(-touching.Opening(gaps));
}

}  // namespace assay::execution
