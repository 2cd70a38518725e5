#pragma once

#include <string_view>

#include "planner/domain/units/units.h"

namespace assay::plan {

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

// The mode of certification that asks for a kind of precondition.
enum class Origin {
  kPaper,      // Spar's paper: both modes ask for it
  kSoundMode,  // sound mode alone
};

// What makes a step work although preconditions of a kind fail, apart from smaller errors.
enum class AbsorbedBy {
  kNothing,
  kFineMotion,  // a fine-motion strategy, for which the kind need not hold
  kOtherPlace,  // another place on the table, where the kind may hold
};

// What a claim is about, if a certificate makes several claims of the same kind.
enum class Circumstance {
  kUsual,          // the step's work
  kWayHome,        // the arm's way home after the last step
  kYieldingWrist,  // a shaft that bevelled edges lead into its hole as the wrist yields
};

// A kind of uncertainty-reduction precondition: the one description of it in the program. The kinds
// of the planner are in condition_table.h. Kinds are compared by their addresses, so each kind is
// one object that lives as long as the program.
struct ConditionKind {
  std::string_view name;     // in files and in output
  std::string_view meaning;  // what holds, for people
  domain::Dimension dimension;
  NeededBy needed_by;
  Origin origin;
  AbsorbedBy absorbed_by = AbsorbedBy::kNothing;
  // The only valid reason of a certificate to have no precondition of the kind; empty: it must have
  // some.
  std::string_view may_lack = "";
  // What may make a step fail if its certificate has no precondition of the kind; empty for kinds
  // whose absence needs no statement.
  std::string_view left_open = "";

  constexpr bool is_published() const { return origin == Origin::kPaper; }
};

// The kind of a precondition. A condition always refers to a kind.
class Condition {
 public:
  // The kind must outlive the condition. The conversion is implicit, so that a kind can be passed
  // wherever a condition is expected.
  constexpr Condition(const ConditionKind& kind) : kind_(&kind) {}
  Condition(ConditionKind&&) = delete;

  constexpr const ConditionKind* operator->() const { return kind_; }
  constexpr std::string_view name() const { return kind_->name; }

  bool operator==(const Condition&) const = default;

 private:
  const ConditionKind* kind_;
};

}  // namespace assay::plan
