#pragma once

#include <optional>
#include <vector>

#include "planner/kinematics/inverse/closed_form.h"
#include "planner/kinematics/inverse/elimination.h"

namespace assay::kinematics {

// The inverse kinematics of a chain with six revolute joints. For an arm of the general class, the
// values of one joint after another are searched, until two searches give the same solutions and
// their number is even, as it is for all but singular poses. If the axes of an arm miss the common
// point or direction of their class slightly, Newton's method starts at the solutions of the closed
// form of the class. Near singular poses, the values of the joints are searched as well.
class ChainInverse {
 public:
  // The chain must have six joints.
  explicit ChainInverse(SerialChain chain);

  const SerialChain& chain() const { return chain_; }
  const ArmClass& arm_class() const { return arm_; }

  // Returns all joint vectors that put the tip at X_BaseTip to within 1e-9 (metres, and entries of
  // the rotation), without regard to limits. Angles are in (-pi, pi]. Solutions that differ by less
  // than 1e-6 rad in every joint are given once. At a singular pose with a continuum of solutions,
  // a free joint has the value of `reference`, and the others follow.
  std::vector<SixAngles> Solve(const Pose& X_BaseTip,
                               const SixAngles& reference = SixAngles::Zero()) const;

 private:
  void RankSearches();
  std::vector<SixAngles> SolveInClosedForm(const Pose& X_BaseTip, const SixAngles& reference) const;
  std::vector<SixAngles> SolveFromClosedForm(const Pose& X_BaseTip,
                                             const SixAngles& reference) const;
  ClosedFormSolutions ClosedForm(const Pose& X_BaseTip, const SixAngles& reference) const;
  void AddBySearches(const Pose& X_BaseTip, std::vector<SixAngles>& known) const;
  std::size_t AddSearched(const SearchedJoint& joint, const Pose& X_BaseTip,
                          std::vector<SixAngles>& known) const;

  SerialChain chain_;
  SixAxes axes_;
  Pose X_TipBase_;  // at zero
  ArmClass arm_;
  SixAxes ideal_axes_;  // of the class
  // Searches over one joint each, the best first. They serve arms that are not exactly of a class
  // with a closed form.
  std::vector<SearchedJoint> searches_;
};

struct NewtonLimits {
  int steps = 40;
  double start_error = 1e9;  // greatest error at the start, m and entries of rotations
};

// Refines joint values by Newton's method. Returns nothing if they do not come to within 1e-9 of
// the pose.
std::optional<SixAngles> RefineByNewton(const SerialChain& chain, const Pose& X_BaseTip,
                                        SixAngles q, const NewtonLimits& limits = {});

// Returns the joint vectors that differ from q by whole turns and are within the limits of the
// chain, or beyond them by at most 1e-9 rad.
std::vector<ChainVector> WithinLimits(const SerialChain& chain, const ChainVector& q);

// The inverse kinematics of a chain with seven joints: all solutions for a value of one joint.
class RedundantInverse {
 public:
  // The chain must have seven joints. One joint is locked. It is chosen so that the other six
  // joints form an arm of the class that is solved most easily. If several joints can be chosen,
  // the last of them is taken. The other six joints must be able to move the tip in all directions.
  explicit RedundantInverse(SerialChain chain);

  const SerialChain& chain() const { return chain_; }
  int locked_joint() const { return locked_; }
  // Returns the solver of the six joints that remain.
  ChainInverse At(double value) const { return ChainInverse(chain_.Locked(locked_, value)); }
  std::vector<ChainVector> Solve(const Pose& X_BaseTip, double value,
                                 const SixAngles& reference = SixAngles::Zero()) const;

 private:
  SerialChain chain_;
  int locked_ = 0;
};

}  // namespace assay::kinematics
