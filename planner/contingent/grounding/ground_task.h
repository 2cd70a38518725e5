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

using AtomId = Id<struct AtomTag>;          // an atom, p(a, b) or f(a) = b
using FunctionId = Id<struct FunctionTag>;  // a function with its arguments, f(a)
using FormulaId = Id<struct FormulaTag>;    // a formula that Kw can hold
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
  double error = 0;  // for a number in Kv: the greatest error of the sensed value
  // True if knowledge of other numbers or of atoms may rule out a part of the interval. Then it is
  // undecided whether more is known than the interval says.
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

bool IsUpper(Relation relation);   // true for < and <=
bool IsStrict(Relation relation);  // true for < and >
// Returns true if a ground task's bound holds for every number in the range.
bool SurelyHolds(const Bound& bound, const Range& range);
Bound Negation(Bound bound);
// Returns the part of the range where a ground task's bound holds.
Range Narrowed(Range range, const Bound& bound);

// A conjunction of literals, or one bound.
struct Formula {
  std::vector<GroundLiteral> literals;
  std::optional<Bound> bound;

  bool operator==(const Formula&) const = default;
};

// A function with its arguments, f(a). A function of objects has one atom for each constant of its
// range. A numeric function has a slot for its interval in knowledge states.
struct GroundFunction {
  std::string text;
  std::string symbol;
  std::vector<std::string> arguments;
  std::vector<AtomId> values;
  std::vector<std::string> constants;  // the constants of `values`, in the same order
  int slot = -1;                       // the slot of the interval, or -1 for a function of objects
};

struct GroundQuery {
  enum class Kind {
    kAnd,  // true without operands
    kOr,   // false without operands
    kNot,
    kKnown,         // the literal is known
    kBoundKnown,    // the bound surely holds
    kKnownWhether,  // the formula is in Kw, known to be true, or known to be false
    // the function is in Kv or known to be a number, with an error of at most `within`
    kValueSensed,
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

// The sum of a constant and of functions, each with its sign, +1 or -1.
struct GroundSum {
  Interval constant;
  std::vector<std::pair<FunctionId, int>> functions;

  bool operator==(const GroundSum&) const = default;
};

struct GroundChange {
  enum class Kind {
    kSet,           // add(Kf, l): the literal becomes true
    kForget,        // del(Kf, l): the atom may become true or false
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
  double error = 0;  // for kSenseValue: the sensor's greatest error
};

struct GroundEffect {
  GroundQuery condition;
  // True if the condition asks only K of literals and of bounds. Then the effect takes place in the
  // world: the changes happen where the condition is true, whether that is known or not.
  bool is_of_worlds = false;
  std::vector<GroundChange> changes;
  Place place = {};  // place in the domain's file
};

struct GroundAction {
  std::string name;
  // Constants, or function terms for run-time variables.
  std::vector<std::string> arguments;
  // Indexed by argument: the function of a run-time variable, or none for a constant.
  std::vector<FunctionId> run_time_values = {};
  GroundQuery precondition;
  std::vector<GroundEffect> effects;
  Place place = {};  // place in the domain's file
};

// A set of literals of which exactly one, or at least one, holds initially.
struct InitialRelation {
  std::vector<GroundLiteral> literals;
  bool is_inclusive = false;
  FilePlace place;
};

// The symbol and arguments of an atom p(a, b). The atom f(a) = c has the symbol f and the arguments
// a, c.
struct GroundAtom {
  std::string symbol;
  std::vector<std::string> arguments;
};

// The initial knowledge. An atom in neither `known` nor `relations` is unknown.
struct InitialKnowledge {
  std::vector<GroundLiteral> known;
  std::vector<InitialRelation> relations;
  std::vector<FormulaId> sensed;
  std::map<FunctionId, double> values_sensed;  // the functions in Kv with their errors
  std::vector<Range> ranges;                   // the intervals of numeric functions, by slot
};

struct GroundTask {
  std::string domain_file;
  std::vector<std::string> atoms;            // the texts of the atoms
  std::vector<GroundAtom> ground_atoms;      // the symbols and arguments of the atoms
  std::vector<FunctionId> function_of_atom;  // by atom: f for f(a) = b, none for predicates
  std::vector<GroundFunction> functions;
  std::vector<FunctionId> function_of_slot;
  std::vector<Formula> formulas;
  std::vector<GroundAction> actions;
  std::vector<GroundEffect> updates;
  InitialKnowledge initial;
  GroundQuery goal;
  FilePlace goal_place;
};

// Returns true for a change that asserts Kx or a bound. It changes what is known, and not the
// world.
bool IsAsserted(const GroundChange& change);
// Returns true if the task asserts Kx or bounds, which say something about the present world.
bool TellsSomething(const GroundTask& task);

// Returns the formulas that init, an action or an update rule adds to Kw.
std::set<FormulaId> SensedFormulas(const GroundTask& task);

// Returns the greatest number of rounds in which the update rules may change something. Rules that
// still change something after these rounds never come to rest.
std::size_t MostRoundsOf(const GroundTask& task);

// Returns the text of a literal or a formula: "isSpillable(can1)", "!p & q", "weight(can1) > 2".
std::string TextOf(const GroundTask& task, const GroundLiteral& literal);
std::string TextOf(const GroundTask& task, const Formula& formula);
// Returns the text of a function with its interval, "weight(can1) = [0.2, 0.4]", or "weight(can1) >
// 0.2" for an interval with only one end or with an excluded end.
std::string TextOf(const GroundFunction& function, const Range& range);
std::string TextOf(const GroundAction& action);
std::string_view TextOf(Relation relation);

}  // namespace assay::contingent
