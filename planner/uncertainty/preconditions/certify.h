#pragma once

#include "planner/algebra/bounds/bounds.h"
#include "planner/uncertainty/preconditions/precondition.h"

namespace assay::uncertainty {

// A precondition that could not be proved.
struct Unproved {
  plan::CertifiedPrecondition claim;
  Expression expression;  // of the claim, in the variables of the world it was decided in
  PartId neighbour = PartId::None();  // Precondition::neighbour
};

struct CertifiedStep {
  plan::Certificate certificate;
  std::vector<Unproved> unproved;
};

// The sum of how far the bounds are beyond their limits.
double Violation(const std::vector<Unproved>& unproved);

// How far the bound of the expression is beyond its limit at least, however tight it is: by the
// values that a glance finds.
double LeastViolation(const Unproved& unproved, const UncertainWorld& world);

// Certifies the next action of a plan instance, and takes the world to where it is after it: the
// action's add and delete lists at the uncertainty-reduction level, of manipulations and of sensing
// alike. The action's own preconditions are assumed to have held; if it is executed by a strategy,
// those that the strategy takes for granted, and not those that it absorbs. `strategy`: null if the
// action goes straight.
CertifiedStep CertifyStep(UncertainWorld& world, const plan::Action& action,
                          const algebra::BoundRequest& request,
                          const plan::Strategy* strategy = nullptr);

// The certificates of all steps of a plan, computed anew from the problem and the actions, without
// resolutions; by StepId. The plan must be one that can be executed (planner/plan/check/checker.h),
// and its matings must have a shaft in a hole.
std::vector<plan::Certificate> CertificatesAnew(const domain::Problem& problem,
                                                const plan::Plan& plan, Propagation propagation,
                                                const algebra::BoundRequest& request);

// The same as CertifyStep, only for the answer what is not proved: the claims have no texts and no
// worst corners, and their bounds need not be as tight as a certificate's. Looks no further than at
// the first that is not, if that is enough to know.
enum class Wanted { kFirstUnproved, kAllUnproved };
std::vector<Unproved> DecideStep(UncertainWorld& world, const plan::Action& action,
                                 const algebra::BoundRequest& request, Wanted wanted,
                                 const plan::Strategy* strategy = nullptr);

// With the bound that a certificate tells, in a world that goes on from that in which it was
// decided.
Unproved AsCertified(Unproved unproved, const UncertainWorld& world,
                     const algebra::BoundRequest& request);

// The same without looking at preconditions.
void Propagate(UncertainWorld& world, const plan::Action& action,
               const plan::Strategy* strategy = nullptr);

// What is known of a part: while held, in the frame of the commanded hand.
plan::ErrorSet ErrorSetOf(const UncertainWorld& world, PartId part, const Transform& X_ToolGrasp);
plan::ErrorSet ErrorSetOf(const UncertainWorld& world, PartId part);

}  // namespace assay::uncertainty
