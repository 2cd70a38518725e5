#pragma once

#include "sim/exec/control/control_law.h"
#include "sim/exec/control/soft_arm.h"

namespace assay::exec {

// Tells of a contact that a motion waits for, by the forces that it and the kept ones would have to
// bear for what is felt.
class AwaitedContact {
 public:
  // `seeming`: newtons on it that the friction of what is kept may seem to be.
  AwaitedContact(int kept, double seeming, const ControlLaw& law);

  // The newtons of a timestep, the kept contacts' and then its own.
  void Feel(const Eigen::VectorXd& forces, double timestep);
  // It bears enough on average; or more than all that is kept, of which it takes over.
  bool IsMade() const;
  // What is felt is of the kept contacts only.
  bool IsApart() const;
  // The share of its rate at which the motion is to go on. The arm is stiff against turns, and what
  // is made beside a kept contact takes over what that one bears within micrometres of the way: a
  // motion that went on would lift it.
  double Pace() const { return pace_; }

 private:
  double OfKept(const Eigen::VectorXd& forces) const { return forces.head(kept_).sum(); }
  double Usual() const;

  const ControlLaw& law_;
  int kept_;
  double least_;          // newtons
  Eigen::VectorXd felt_;  // averaged
  double pace_ = 1;
};

}  // namespace assay::exec
