#pragma once

#include "planner/plan/data/strategy.h"
#include "sim/execution/control/found_contacts.h"
#include "sim/execution/control/soft_arm.h"
#include "sim/execution/control/strategy_end.h"

namespace assay::execution {

// Corrects the believed pose of the tip from contacts, which show it better than the hand does.
class TipCorrection {
 public:
  // All arguments must outlive this object.
  TipCorrection(const plan::Strategy& strategy, const FoundContacts& contacts, SoftArm& arm)
      : strategy_(strategy), contacts_(contacts), arm_(arm) {}

  // Call it at the start of each attempt.
  void BeginAttempt() { X_TipTool_ = arm_.X_TipTool(); }
  // Corrects the tip so that, after a motion to X_FixedTip, kept contacts are where the plan has
  // them.
  void LearnKept(const PressedContacts& kept, const Pose& X_FixedTip);
  // Corrects the tip so that a contact that was made on the way `along` is where the plan has this
  // contact.
  void LearnMade(int contact, const Pose& X_FixedTip, const Vector6& along);
  // Corrects the tip in an error state: the tip's error is taken to be near the mean of the errors
  // that lead to that state, and the touching contacts touch.
  void LearnError(const ErrorState& error);

 private:
  const plan::UnwantedContact* UnwantedIn(const ErrorState& error) const;  // null if none is known
  void BelieveLikely(const plan::TipError& likely);
  void BelieveUnwanted(const plan::StrategyMotion& motion, const plan::UnwantedContact& unwanted);

  const plan::Strategy& strategy_;
  const FoundContacts& contacts_;
  SoftArm& arm_;
  Pose X_TipTool_;  // the tip's believed pose in the hand at the start of the attempt
};

}  // namespace assay::execution
