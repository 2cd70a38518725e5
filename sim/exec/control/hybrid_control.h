#pragma once

#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "planner/plan/data/strategy.h"
#include "sim/exec/control/holding.h"
#include "sim/exec/control/mating_outcome.h"
#include "sim/exec/control/pressed_contacts.h"
#include "sim/exec/control/recognition.h"
#include "sim/exec/control/soft_arm.h"

namespace assay::exec {

MatingOutcome OutcomeOf(ExecutionOutcome outcome);

// A contact state that is not of the plan, or in which it does not go on.
struct ErrorState {
  MatingOutcome outcome = MatingOutcome::kDone;
  std::string reason = {};
  int motion = 0;                                    // that it came in
  std::optional<RecognizedContact> recognized = {};  // none: of the known ones none
  double time = 0;                                   // simulated seconds
  // Of a part that got stuck: by the contacts that the engine had then, which control knows nothing
  // of.
  std::optional<Holding> holding = {};
};

struct StrategyEnd {
  MatingOutcome outcome = MatingOutcome::kDone;
  std::string reason = {};                 // empty if done
  int motion = 0;                          // the one that it ended in
  std::vector<ErrorState> recovered = {};  // that it had come into before, and out of again
  std::vector<ErrorState> ignored = {};    // of the last attempt, that it went on in
  std::optional<RecognizedContact> recognized = {};
  double time = 0;  // simulated seconds
  std::optional<Holding> holding = {};
};

// Told of each timestep: the simulation after it, and the motion's index.
using MotionObserver = std::function<void(const mujoco::Data&, int)>;

// Whether a contact that touches after the motion before is not kept in this one. Each motion plans
// a contact at a place of its own: it is the same one if its name is.
bool LetsGo(const plan::Strategy& strategy, std::size_t motion);

// Runs strategies by hybrid control of position and force (Dakin and Popplestone, section 2): in
// each contact state the arm is moved along the tangents as the plan has it, and along the normals
// as forces ask for, so that contacts are kept although it is not known exactly where they are.
//
// The arm is rigid and told positions, so force control is an admittance: it gives way with a
// velocity in proportion to what the force is too much. What it gives way goes into the commanded
// position and is not undone later.
//
// After each motion the arm asks whether it feels the contact state that the plan then has
// (recognition.h). If not, or if it cannot go on, it is in an error state: it draws back and starts
// again. What contacts have told until then is kept. An unwanted one that is recognized tells more:
// the plan knows what errors lead to it, so that their mean is believed, and of the errors near it
// those with which what touches does. In the last attempt it goes on as long as it can: with parts
// that touch otherwise than planned it often still comes in.
class HybridControl {
 public:
  // The part in the execution's hand goes where the strategy leads, seen from `fixed`. The tool
  // is where the strategy starts. All must outlive this.
  HybridControl(const plan::Strategy& strategy, PartId fixed, const ControlLaw& law,
                Execution& execution);

  StrategyEnd Run(const MotionObserver& observer = {});

 private:
  // A straight way, as a twist in the fixed part's axes about the tip: metres and radians. Rates
  // are in ways a second.
  struct Way {
    Vector6 twist = Vector6::Zero();
    double rate = 0;          // at most
    double acceleration = 0;  // ways / s^2

    Way At(double pace) const { return {twist, pace * rate, acceleration}; }
  };
  using Ended = std::optional<ErrorState>;  // none: it goes on
  // The arm's wrench, averaged.
  struct Feeling {
    Vector6 wrench = Vector6::Zero();
    double time = 0;
  };

  Ended RunOnce();
  void Record(const ErrorState& end);
  ErrorState Passed() const;  // none, but what is recognized
  // The strategy with contacts where they are found to be.
  plan::Strategy Found() const;
  std::optional<RecognizedContact> Recognized(const plan::StrategyMotion& motion) const;
  RecognizedContact Named(const plan::UnwantedContact& unwanted, double time) const;
  // That the motion has come to the contact state that the plan has there.
  Ended CheckState(const plan::StrategyMotion& motion);
  // Out of the hole, and to where the strategy starts.
  Ended DrawBack();
  Vector3 WayOut() const;

  struct Speed {
    double shift = 0;  // m/s
    double turn = 0;   // rad/s
  };
  // From where the tip is, at most with this speed.
  Way WayTo(const Pose& X_FixedTip, Speed speed) const;
  Speed SpeedOf(const plan::StrategyMotion& motion) const;
  // The next timestep's rate, if so much of the way is left.
  double NextRate(const Way& way, double rate, double left) const;
  const plan::StrategyContact& Planned(int contact) const;
  // Where they are found to be.
  PressedContacts Pressed(std::span<const int> contacts) const;
  Vector3 Beside(const plan::StrategyContact& planned) const;
  void Remember(std::span<const int> contacts, const PressedContacts& pressed);

  Ended RunMotion(std::size_t index);
  Ended MoveAlong(const Way& way, const PressedContacts& kept);
  Ended MoveUntil(const plan::StrategyMotion& motion, const Way& way);
  // Newtons on what the motion waits for that friction on what it keeps may seem to be.
  double SeemingForce(const plan::StrategyMotion& motion, const PressedContacts& kept,
                      const Way& way) const;
  Ended Slide(const Way& way);
  Ended Stuck(const Vector6& direction, double left);
  double Slack(int contact, const Way& way) const;
  Ended Brake(TipMotion motion);
  // The awaited contact was made on the way: it and what is kept are pressed on.
  Ended Make(const plan::StrategyMotion& motion, const Way& way, double rate,
             const PressedContacts& kept);
  Ended Settle(const PressedContacts& contacts);
  Ended Step(const TipMotion& motion);

  // Presses on contacts, and otherwise follows `wanted`.
  TipMotion Hybrid(const PressedContacts& contacts, const Vector6& wanted) const;
  // Gives way to all that is felt but along this direction.
  Vector6 YieldingAcross(const Vector6& direction) const;
  // Whether forces that contacts do not explain last for longer than an impact takes.
  Ended CheckObstruction(const PressedContacts& contacts);

  // Contacts tell where the tip is, better than the hand knows: kept ones are as the plan has them
  // after a motion, and so is one that was made on the way `along`.
  void Believe(const PressedContacts& kept, const Pose& X_FixedTip);
  void BelieveMade(int contact, const Pose& X_FixedTip, const Vector6& along);
  // What an error state tells of where the tip is: about where it is when this happens, and that
  // what touches then does.
  void LearnFrom(const ErrorState& error);
  const plan::UnwantedContact* UnwantedIn(const ErrorState& error) const;  // null: none is known
  void BelieveLikely(const plan::TipError& likely);
  void BelieveUnwanted(const plan::StrategyMotion& motion, const plan::UnwantedContact& unwanted);

  ErrorState Error(MatingOutcome outcome, std::string reason) const;

  const plan::Strategy& strategy_;
  const ControlLaw& law_;
  Execution& execution_;
  PartId fixed_;
  SoftArm arm_;
  MotionObserver observer_;
  Pose X_TipTool_;                         // believed when the attempt began
  std::map<std::string, Vector3> beside_;  // where contacts are planned, that they are found
  double obstructed_ = 0;                  // seconds, without a break
  std::vector<ErrorState> ignored_;        // StrategyEnd
  // There was an error state: anything may be hit, so that nothing is faster than to a contact.
  bool in_doubt_ = false;
  Feeling felt_;
  Feeling first_felt_;  // of the motion's awaited contact; what else is made then comes after it
  int attempt_ = 1;
  int motion_ = 0;
};

}  // namespace assay::exec
