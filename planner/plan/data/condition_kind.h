#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "planner/plan/data/plan.h"

namespace assay::plan {

// What the two sides of a precondition are.
enum class Quantity { kLength, kAngle, kRatio };  // metres, radians, a ratio

// The steps that need a kind of precondition.
enum class NeededBy {
  kGrasp,     // pickup, squeeze
  kCarrying,  // what has a part in the hand as the hand travels: pickup, putdown, assemble
  kHandWork,  // everything with the hand: all but sense
  kWay,       // whatever the arm goes to: every step
  kPutdown,   //
  kRelease,   // what lets a part go where it stays: putdown, assemble
  kMating,    // assemble, straight or by a strategy
  kStrategy,  // assemble by a strategy
};

// A kind of uncertainty-reduction precondition (planner/uncertainty/preconditions/precondition.h
// says what each means). The certificate of a step that needs it has preconditions of the kind, or
// states why it has none; a certificate that lacks it without a reason is refused.
struct ConditionKind {
  std::string_view name;  // CertifiedPrecondition::condition
  Quantity quantity;
  NeededBy needed_by;
  bool is_published;               // else Spar's paper does not ask for it
  std::string_view may_lack = "";  // the only reason for which there is none; empty: there must be
};

// All of them. Who adds a kind adds a line to this table and to plan.schema.json.
std::span<const ConditionKind> ConditionKinds();
const ConditionKind* FindConditionKind(std::string_view name);  // null: there is none
Quantity QuantityOf(std::string_view condition);                // the kind must be there (checked)

// The reason where certificates are made as published.
inline constexpr std::string_view kNotPublished = "the paper's propagation does not ask for it";
// Whether any certificate of the plan gives that reason.
bool IsAsPublished(const Plan& plan);

// The kinds that a step needs, in the order of the table. `strategy`: null if it goes straight.
std::vector<const ConditionKind*> KindsNeeded(const Action& action, const Strategy* strategy);

// Of the kinds that the step needs, those without a precondition, each with its reason. The kinds
// that may not be lacking must be there, and no others (checked): so the planner refuses what it
// would leave unproved without a word.
std::vector<NotNeeded> NotNeededIn(const std::vector<CertifiedPrecondition>& preconditions,
                                   const Action& action, const Strategy* strategy,
                                   bool as_published);

// What is wrong with what the step's certificate covers, in words; empty: nothing. Whether the
// reasons are true is not looked at.
std::vector<std::string> FlawsOfCoverage(const PlannedStep& step);

}  // namespace assay::plan
