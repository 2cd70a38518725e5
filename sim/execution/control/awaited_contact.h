#pragma once

#include "sim/execution/control/control_law.h"
#include "sim/execution/control/soft_arm.h"

namespace assay::execution {

// Detects the contact that a motion waits for, from the forces that it and the kept contacts would
// have to bear to explain the measured wrench.
class AwaitedContact {
 public:
  // `kept` is the number of kept contacts. `seeming` is the force, in newtons, that friction of the
  // kept contacts may seem to put on the awaited one.
  AwaitedContact(int kept, double seeming, const ControlLaw& law);

  // Takes the forces of one timestep in newtons: first the forces of the kept contacts, then the
  // force of the awaited contact.
  void Feel(const Eigen::VectorXd& forces, double timestep);
  // Returns whether the contact bears enough on average, or more than all kept contacts, whose
  // force it takes over.
  bool IsMade() const;
  // Returns whether only the kept contacts bear anything.
  bool IsApart() const;
  // Returns the share of its rate at which the motion should go on. The arm is stiff against turns,
  // so a contact that is made beside a kept one takes over its force within micrometres. A motion
  // that went on at full rate would break the kept contact.
  double Pace() const { return pace_; }

 private:
  double OfKept(const Eigen::VectorXd& forces) const { return forces.head(kept_).sum(); }
  double Usual() const;

  const ControlLaw& law_;
  int kept_;
  double least_;          // newtons that the contact must bear at least
  Eigen::VectorXd felt_;  // forces, averaged over time
  double pace_ = 1;
};

}  // namespace assay::execution
