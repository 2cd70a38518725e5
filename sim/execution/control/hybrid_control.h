#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "planner/plan/data/strategy.h"
#include "sim/execution/control/found_contacts.h"
#include "sim/execution/control/recognition.h"
#include "sim/execution/control/soft_arm.h"
#include "sim/execution/control/strategy_end.h"
#include "sim/execution/control/tip_correction.h"

namespace assay::execution {

// Called after each timestep with the simulation and the index of the motion.
using MotionObserver = std::function<void(const mujoco::Data&, int)>;

// Returns whether a contact that touches after the previous motion is not kept in this motion. Each
// motion plans its contacts at places of its own, so two contacts are the same if their names are.
bool LetsGo(const plan::Strategy& strategy, std::size_t motion);

// Executes strategies by hybrid control of position and force (Dakin and Popplestone, section 2).
// In each contact state the arm moves along the tangents as planned and along the normals as the
// forces require. Contacts are thus kept although their places are not known exactly.
//
// The arm is rigid and takes positions as commands, so force control is an admittance: the arm
// yields with a velocity in proportion to the excess of force. The yielding becomes part of the
// commanded position and is not undone later.
//
// After each motion, control decides whether the wrench can come from the planned contact state
// (recognition.h). If the wrench cannot, or if the motion cannot go on, the arm is in an error
// state: the arm draws back and starts again. The controller keeps what contacts have shown about
// the tip's pose. A recognized unwanted contact shows more, since the plan has the mean of the
// errors that lead to this contact. The believed pose is first corrected by this mean, and then by
// the least errors for which the touching contacts touch. In the last attempt the arm goes on as
// long as it can, because parts that touch otherwise than planned often still enter.
class HybridControl {
 public:
  // The part in the execution's hand follows the strategy, relative to `fixed`. The tool must be
  // where the strategy starts. All arguments must outlive this object.
  HybridControl(const plan::Strategy& strategy, PartId fixed, const ControlLaw& law,
                Execution& execution);

  StrategyEnd Run(const MotionObserver& observer = {});

 private:
  // A straight way, as a twist about the tip in the fixed part's axes (metres and radians). A rate
  // is the fraction of the way that the tip covers in one second.
  struct Way {
    Vector6 twist = Vector6::Zero();
    double rate = 0;          // greatest rate, 1/s
    double acceleration = 0;  // 1/s^2

    Way At(double pace) const { return {twist, pace * rate, acceleration}; }
  };
  using Ended = std::optional<ErrorState>;  // none if the motion goes on
  // The wrench on the arm, averaged over time.
  struct Feeling {
    Vector6 wrench = Vector6::Zero();
    double time = 0;
  };

  Ended RunOnce();
  void Record(const ErrorState& end);
  ErrorState Passed() const;  // returns success, with the recognized error state if any
  std::optional<RecognizedContact> Recognized(const plan::StrategyMotion& motion) const;
  RecognizedContact Named(const plan::UnwantedContact& unwanted, double time) const;
  // Checks that the wrench after the motion can come from the planned contact state.
  Ended CheckState(const plan::StrategyMotion& motion);
  // Draws the part out of the hole, and to where the strategy starts.
  Ended DrawBack();
  Vector3 WayOut() const;

  struct Speed {
    double shift = 0;  // m/s
    double turn = 0;   // rad/s
  };
  // Returns the way from the tip's measured pose to X_FixedTip, with at most this speed.
  Way WayTo(const Pose& X_FixedTip, Speed speed) const;
  Speed SpeedOf(const plan::StrategyMotion& motion) const;
  // Returns the rate of the next timestep, if the fraction `left` of the way is left.
  double NextRate(const Way& way, double rate, double left) const;

  Ended RunMotion(std::size_t index);
  Ended MoveAlong(const Way& way, const PressedContacts& kept);
  Ended MoveUntil(const plan::StrategyMotion& motion, const Way& way);
  // Returns the force, in newtons, that seems to come from the awaited contact but may come from
  // friction of the kept contacts.
  double SeemingForce(const plan::StrategyMotion& motion, const PressedContacts& kept,
                      const Way& way) const;
  Ended Slide(const Way& way);
  Ended Stuck(const Vector6& direction, double left);
  double Slack(int contact, const Way& way) const;
  Ended Brake(const TipMotion& motion);
  // Ends a motion whose awaited contact was made on the way, with this contact and the kept ones
  // pressed.
  Ended Make(const plan::StrategyMotion& motion, const Way& way, double rate,
             const PressedContacts& kept);
  Ended Settle(const PressedContacts& contacts);
  Ended Step(const TipMotion& motion);

  // Returns the motion that presses on the contacts and otherwise follows `wanted`.
  TipMotion Hybrid(const PressedContacts& contacts, const Vector6& wanted) const;
  // Returns the motion that yields to all forces but those along this direction.
  Vector6 YieldingAcross(const Vector6& direction) const;
  // Returns an error state if forces that contacts do not explain last longer than an impact.
  Ended CheckObstruction(const PressedContacts& contacts);

  ErrorState Error(TrialOutcome outcome, std::string reason) const;

  const plan::Strategy& strategy_;
  const ControlLaw& law_;
  Execution& execution_;
  PartId fixed_;
  SoftArm arm_;
  FoundContacts contacts_;
  TipCorrection correction_;
  MotionObserver observer_;
  double obstructed_ = 0;            // seconds of obstruction without interruption
  std::vector<ErrorState> ignored_;  // error states of the last attempt, as in StrategyEnd
  // There was an error state, so the part may hit anything. From then on no motion is faster than a
  // motion to a contact.
  bool in_doubt_ = false;
  Feeling felt_;
  // Wrench when the awaited contact was made; other contacts may have followed it.
  Feeling first_felt_;
  int attempt_ = 1;
  int motion_ = 0;
};

}  // namespace assay::execution
