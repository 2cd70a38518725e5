#pragma once

#include "planner/algebra/bounds/bounds.h"
#include "planner/uncertainty/preconditions/derivation.h"

namespace assay::uncertainty {

// A precondition that could not be proved.
struct Unproved {
  plan::CertifiedPrecondition claim;
  Expression expression;  // the claim's expression, in the variables of the world it was decided in
  PartId neighbour = PartId::None();  // see Precondition::neighbour
};

struct CertifiedStep {
  plan::Certificate certificate;
  std::vector<Unproved> unproved;
};

// Returns the sum of the amounts by which the bounds are beyond their limits.
double Violation(const std::vector<Unproved>& unproved);

// Returns the least amount by which any bound of the expression, however tight, is beyond its
// limit. It comes from values that the expression takes at single points of the box.
double LeastViolation(const Unproved& unproved, const UncertainWorld& world);

// Certifies the next action of a plan instance, and changes `world` to its state after the action.
// This applies the add and delete lists of manipulations and of sensing actions at the
// uncertainty-reduction level. The new state assumes that the action's own preconditions held. If a
// strategy executes the action, the new state assumes the preconditions that the strategy relies
// on, but not the preconditions that it absorbs. `strategy` is null if no strategy executes the
// action. `theory` has the preconditions that the certificate states.
CertifiedStep CertifyStep(UncertainWorld& world, const plan::Action& action,
                          const algebra::BoundRequest& request,
                          const plan::Strategy* strategy = nullptr, const Theory& theory = {});

// Returns the preconditions of the next action, and takes the world to its state after the action,
// as CertifyStep does. Nothing is decided.
std::vector<Precondition> PreconditionsOf(UncertainWorld& world, const plan::Action& action,
                                          const plan::Strategy* strategy = nullptr);

// Returns the certificates of all steps of a plan by StepId. They are computed anew from the
// problem and the actions, without resolutions. The plan must be executable
// (planner/plan/checker/checker.h), and each of its matings must have a shaft in a hole.
std::vector<plan::Certificate> CertificatesAnew(const domain::Problem& problem,
                                                const plan::Plan& plan, Propagation propagation,
                                                const algebra::BoundRequest& request);

// Decides the preconditions of the next action as CertifyStep does, and takes the world to its
// state after the action, but returns only the unproved preconditions. The claims have no texts and
// no worst corners, and their bounds may be looser than a certificate's. With kFirstUnproved, the
// search stops at the first unproved precondition.
enum class Wanted { kFirstUnproved, kAllUnproved };
std::vector<Unproved> DecideStep(UncertainWorld& world, const plan::Action& action,
                                 const algebra::BoundRequest& request, Wanted wanted,
                                 const plan::Strategy* strategy = nullptr);

// Returns the unproved precondition with the bound that a certificate states. `world` must be the
// world in which the precondition was decided, or a world that continues it.
Unproved AsCertified(Unproved unproved, const UncertainWorld& world,
                     const algebra::BoundRequest& request);

// Applies the action to the world as CertifyStep does, without looking at preconditions.
void Propagate(UncertainWorld& world, const plan::Action& action,
               const plan::Strategy* strategy = nullptr);

// Returns the known errors of a part. The version with X_ToolGrasp is for a held part, and its
// errors are in the frame of the commanded hand.
plan::ErrorSet ErrorSetOf(const UncertainWorld& world, PartId part, const Transform& X_ToolGrasp);
plan::ErrorSet ErrorSetOf(const UncertainWorld& world, PartId part);

}  // namespace assay::uncertainty
