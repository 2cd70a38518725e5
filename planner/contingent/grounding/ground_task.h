#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "planner/base/id.h"
#include "planner/base/interval.h"
#include "planner/contingent/language/domain.h"

// A contingent planning problem without variables.
namespace assay::contingent {

using AtomId = Id<struct AtomTag>;          // p(a, b), or f(a) = b
using FunctionId = Id<struct FunctionTag>;  // f(a)
using FormulaId = Id<struct FormulaTag>;    // what Kw can hold
using ActionId = Id<struct ActionTag>;

struct GroundLiteral {
  AtomId atom;
  bool is_positive = true;

  bool operator==(const GroundLiteral&) const = default;
};

// An interval whose ends may be excluded. Ends may be infinite.
struct Range {
  double low = 0;
  double high = 0;
  bool excludes_low = false;
  bool excludes_high = false;
  double error = 0;  // of what is sensed of it, where it is in Kv
  // What else is known, of other numbers or of atoms, may rule out some of it; then that more is
  // not known cannot be told.
  bool is_outer = false;

  bool operator==(const Range&) const = default;
};

// A numeric function compared with a number by <, <=, > or >=.
struct Bound {
  FunctionId function;
  Relation relation = Relation::kLess;
  double value = 0;

  bool operator==(const Bound&) const = default;
};

bool IsUpper(Relation relation);   // < or <=
bool IsStrict(Relation relation);  // < or >
// Of every number in the range.
bool SurelyHolds(const Bound& bound, const Range& range);
Bound Negation(Bound bound);
// What is left of a range where the bound holds.
Range Narrowed(Range range, const Bound& bound);

// A conjunction of literals, or one bound.
struct Formula {
  std::vector<GroundLiteral> literals;
  std::optional<Bound> bound;

  bool operator==(const Formula&) const = default;
};

// f(a). Of objects: one atom for each constant of its range. Numeric: where knowledge states keep
// its interval.
struct GroundFunction {
  std::string text;
  std::string symbol;
  std::vector<std::string> arguments;
  std::vector<AtomId> values;
  std::vector<std::string> constants;  // of the values
  int slot = -1;                       // of the interval; -1 unless numeric
};

struct GroundQuery {
  enum class Kind {
    kAnd,  // of none: true
    kOr,   // of none: false
    kNot,
    kKnown,         // the literal is known
    kBoundKnown,    // the bound surely holds
    kKnownWhether,  // the formula is in Kw, or known to be true, or to be false
    kValueSensed,   // the function is in Kv, or a number; with an error of `within` at most
  };
  Kind kind = Kind::kAnd;
  GroundLiteral literal;
  Bound bound;
  FormulaId formula;
  FunctionId function;
  std::optional<double> within;
  std::vector<GroundQuery> operands;

  bool IsTrue() const { return kind == Kind::kAnd && operands.empty(); }
  bool IsFalse() const { return kind == Kind::kOr && operands.empty(); }
};

// constant + the sum of the functions, each with its sign.
struct GroundSum {
  Interval constant;
  std::vector<std::pair<FunctionId, int>> functions;

  bool operator==(const GroundSum&) const = default;
};

struct GroundChange {
  enum class Kind {
    kSet,           // the literal is made true: add(Kf, l)
    kForget,        // the atom may be anything now: del(Kf, l)
    kSense,         // add(Kw, formula)
    kUnsense,       // del(Kw, formula)
    kSenseValue,    // add(Kv, f)
    kUnsenseValue,  // del(Kv, f)
    kRelate,        // add(Kx, ...): exactly one, or at least one, of the literals holds
    kAssign,        // add(Kf, f = sum)
    kNarrow,        // add(Kf, f < number)
    kForgetNumber,  // del(Kf, f = ...)
  };
  Kind kind = Kind::kSet;
  GroundLiteral literal = {};
  FormulaId formula = {};
  FunctionId function = {};
  std::vector<GroundLiteral> literals = {};
  bool is_inclusive = false;
  GroundSum sum = {};
  Bound bound = {};
  double error = 0;  // of kSenseValue
};

struct GroundEffect {
  GroundQuery condition;
  // The condition asks K alone, of literals and bounds: then the effect is one of the world, "where
  // the condition is true, the changes happen", whether that is known or not.
  bool is_of_worlds = false;
  std::vector<GroundChange> changes;
  Place place = {};  // in the domain's file
};

struct GroundAction {
  std::string name;
  std::vector<std::string> arguments;            // constants, or function terms: run-time variables
  std::vector<FunctionId> run_time_values = {};  // by argument; none for constants
  GroundQuery precondition;
  std::vector<GroundEffect> effects;
  Place place = {};  // in the domain's file
};

// Exactly one, or at least one, of the literals holds.
struct InitialRelation {
  std::vector<GroundLiteral> literals;
  bool is_inclusive = false;
  FilePlace place;
};

// p(a, b); f(a) = c as the symbol f with the arguments a, c.
struct GroundAtom {
  std::string symbol;
  std::vector<std::string> arguments;
};

// What is known at first. Atoms that are in neither list are unknown.
struct InitialKnowledge {
  std::vector<GroundLiteral> known;
  std::vector<InitialRelation> relations;
  std::vector<FormulaId> sensed;
  std::map<FunctionId, double> values_sensed;  // with their errors
  std::vector<Range> ranges;                   // by slot
};

struct GroundTask {
  std::string domain_file;
  std::vector<std::string> atoms;            // their texts
  std::vector<GroundAtom> ground_atoms;      // the same, in pieces
  std::vector<FunctionId> function_of_atom;  // f of f(a) = b; none for predicates
  std::vector<GroundFunction> functions;
  std::vector<FunctionId> function_of_slot;
  std::vector<Formula> formulas;
  std::vector<GroundAction> actions;
  std::vector<GroundEffect> updates;
  InitialKnowledge initial;
  GroundQuery goal;
  FilePlace goal_place;
};

// That init, an action or an update rule adds to Kw.
std::set<FormulaId> SensedFormulas(const GroundTask& task);

// Rounds of all update rules that may change something; what changes after them is restless.
std::size_t MostRoundsOf(const GroundTask& task);

// "isSpillable(can1)", "!p & q", "weight(can1) > 2".
std::string TextOf(const GroundTask& task, const GroundLiteral& literal);
std::string TextOf(const GroundTask& task, const Formula& formula);
// "weight(can1) = [0.2, 0.4]"; "weight(can1) > 0.2" where it has one end or excludes it.
std::string TextOf(const GroundFunction& function, const Range& range);
std::string TextOf(const GroundAction& action);
std::string_view TextOf(Relation relation);

}  // namespace assay::contingent
