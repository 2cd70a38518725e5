#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "planner/plan/certificates/condition_table.h"
#include "planner/plan/data/plan.h"

namespace assay::plan {

// The certificate of a step that needs a kind of precondition has preconditions of it, or states
// why it has none. A certificate that lacks the kind without a valid reason is refused. The
// functions below have a list of kinds as an argument. If it is left out, they consider all kinds
// that the planner knows.

// The reason for which certificates of the paper mode lack a kind.
inline constexpr std::string_view kNotPublished = "the paper's propagation does not ask for it";
// Returns whether any certificate of the plan gives kNotPublished as a reason.
bool IsAsPublished(const Plan& plan);

// Returns whether a step needs the kinds of preconditions that the table marks with `who`
// (condition_table.h). `strategy` is null if no strategy executes the step.
bool Needs(NeededBy who, const Action& action, const Strategy* strategy);

// Returns the kinds that a step needs, in the order of the list.
std::vector<Condition> ConditionsNeeded(const Action& action, const Strategy* strategy,
                                        ConditionKinds kinds = KnownConditions());

// Returns the kinds that the step needs and of which there is no precondition, each with its
// reason. Checks two things: each kind that must have a precondition has one, and no kind that the
// step does not need has one. The planner therefore never writes a certificate that silently leaves
// something unproved.
std::vector<NotNeeded> NotNeededIn(const std::vector<CertifiedPrecondition>& preconditions,
                                   const Action& action, const Strategy* strategy,
                                   bool as_published, ConditionKinds kinds = KnownConditions());

// Returns, in words, the kinds that the step's certificate should cover and does not, or covers
// wrongly; empty if there are none. The truth of the reasons is not checked.
std::vector<std::string> FlawsOfCoverage(const PlannedStep& step,
                                         ConditionKinds kinds = KnownConditions());

}  // namespace assay::plan
