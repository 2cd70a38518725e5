#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "planner/plan/data/plan.h"

namespace assay::plan {

// The quantity that a precondition compares.
enum class Quantity { kLength, kAngle, kRatio };  // metres, radians, a ratio

// The steps that need a kind of precondition.
enum class NeededBy {
  kGrasp,     // pickup, squeeze
  kCarrying,  // steps with a part in the travelling hand: pickup, putdown, assemble
  kHandWork,  // all steps with the hand: all but sense
  kWay,       // every step: the arm goes somewhere in each
  kPutdown,   // putdown
  kRelease,   // steps that let a part go where it stays: putdown, assemble
  kMating,    // assemble, straight or by a strategy
  kStrategy,  // assemble by a strategy
};

// A kind of uncertainty-reduction precondition; planner/uncertainty/preconditions/precondition.h
// says what each kind means. The certificate of a step that needs the kind has preconditions of it,
// or states why it has none. A certificate that lacks the kind without a reason is refused.
struct ConditionKind {
  std::string_view name;  // CertifiedPrecondition::condition
  Quantity quantity;
  NeededBy needed_by;
  bool is_published;               // false: Spar's paper does not ask for it
  std::string_view may_lack = "";  // the only valid reason to have none; empty: some are required
};

// Returns the table of all kinds. A new kind needs a line in this table and in plan.schema.json.
std::span<const ConditionKind> ConditionKinds();
const ConditionKind* FindConditionKind(std::string_view name);  // null if there is none
Quantity QuantityOf(std::string_view condition);                // the kind must exist (checked)

// The reason in certificates that are made as published.
inline constexpr std::string_view kNotPublished = "the paper's propagation does not ask for it";
// Returns whether any certificate of the plan gives kNotPublished as a reason.
bool IsAsPublished(const Plan& plan);

// Returns the kinds that a step needs, in the order of the table. `strategy` is null if no strategy
// executes the step.
std::vector<const ConditionKind*> KindsNeeded(const Action& action, const Strategy* strategy);

// Returns the kinds that the step needs and of which there is no precondition, each with its
// reason. Checks that every kind that may not lack a precondition has one, and that no unneeded
// kind has one. The planner therefore never writes a certificate that silently leaves something
// unproved.
std::vector<NotNeeded> NotNeededIn(const std::vector<CertifiedPrecondition>& preconditions,
                                   const Action& action, const Strategy* strategy,
                                   bool as_published);

// Returns, in words, the kinds that the step's certificate should cover and does not, or covers
// wrongly; empty if there are none. The truth of the reasons is not checked.
std::vector<std::string> FlawsOfCoverage(const PlannedStep& step);

}  // namespace assay::plan
