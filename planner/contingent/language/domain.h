#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "planner/base/input_files/input_error.h"
#include "planner/base/interval.h"

// The content of a contingent planning domain and problem, before anything is checked or grounded.
// Both readers (.pks and PDDL) produce it. Semantics: Petrick and Bacchus, AIPS 2002 and ICAPS
// 2004, as restated in scenarios/know/README.md.
namespace assay::contingent {

// A place in a file. Lines and columns count from 1. They are 0 for an element that stands in no
// file and that the reader added.
struct Place {
  int line = 0;
  int column = 0;

  bool operator==(const Place&) const = default;
};

// A name with its type. It declares a parameter, a constant, or a type with its parent. The empty
// type "" means any type.
struct TypedName {
  std::string name;
  std::string type = {};
  Place place = {};
};

// The greatest number of nested conditions, effects or lists in a file. The limit protects the
// stack from overflow.
inline constexpr int kDeepestNesting = 100;
// The greatest number of characters in a word of a file. The limit exists because messages repeat
// words.
inline constexpr std::size_t kLongestWord = 1000;

// the type of functions whose value is an interval
inline constexpr const char* kNumberType = "number";

struct Term {
  enum class Kind {
    kConstant,
    kVariable,  // a variable, ?x
    kFunction,  // a function, f(x, y), whose value is an object or a number
    kNumber,    // an interval; the number 2 is [2, 2]
    kSum,       // the sum of two numeric terms
    kDifference,
  };
  Kind kind = Kind::kConstant;
  std::string name = {};
  std::vector<Term> arguments = {};
  Interval value = {};
  Place place = {};
};

enum class Relation { kPredicate, kExtern, kEqual, kLess, kLessOrEqual, kGreater, kGreaterOrEqual };

// An atom or its negation. The arguments are the arguments of the predicate, or the two sides of a
// comparison.
struct Literal {
  bool is_positive = true;
  Relation relation = Relation::kPredicate;
  std::string predicate = {};
  std::vector<Term> arguments = {};
  Place place = {};
};

// A query to a knowledge state, built from K, Kw and Kv (Petrick and Bacchus 2002, section 3).
struct Query {
  enum class Kind {
    kAnd,  // all operands hold; without operands it is always true
    kOr,
    kNot,
    kKnown,         // K(l & ...): every literal is known
    kKnownWhether,  // Kw(l & ...): it is known whether all literals hold together
    kValueKnown,    // Kv(f(x))
    kForAll,        // forallK(?x: type) operand
    kExists,        // existsK
  };
  Kind kind = Kind::kAnd;
  std::vector<Literal> literals = {};
  std::vector<Term> terms = {};  // one term, for kValueKnown only
  // for kValueKnown: the greatest half width of the interval known to contain the value
  std::optional<double> within = {};
  std::vector<TypedName> variables = {};
  std::vector<Query> operands = {};
  Place place = {};
};

enum class Store { kFacts, kWhether, kValues, kExclusive, kClosed };  // Kf, Kw, Kv, Kx, LCW

// A change of the knowledge state, such as add(Kf, ...) or del(Kf, ...).
struct Change {
  bool is_addition = true;
  Store store = Store::kFacts;
  // The literals of the effect: for Kf one literal, for Kw those of the conjunction, for Kx the
  // alternatives, and for LCW one literal with free variables.
  std::vector<Literal> literals = {};
  std::vector<Term> terms = {};  // Kv: one term
  // Kv: the greatest error of the sensor; none for an exact sensor
  std::optional<double> within = {};
  std::vector<TypedName> variables = {};  // LCW: the free variables of the literal
  // True for a Kx written some(...), of which one or more alternatives hold. False if exactly one
  // alternative holds.
  bool is_inclusive = false;
  Place place = {};
};

// The effect forall (?x: type) condition => changes, for each value of the variables.
struct Effect {
  std::vector<TypedName> variables;
  Query condition;
  std::vector<Change> changes;
  Place place;
};

struct Action {
  std::string name;
  std::vector<TypedName> parameters;
  Query precondition;
  std::vector<Effect> effects;
  Place place;
};

// A predicate, function or extern with the types of its arguments.
struct Symbol {
  std::string name;
  std::vector<TypedName> parameters = {};  // the names may be empty
  std::string range = {};                  // the type of a function's value
  Place place = {};
};

struct Domain {
  std::string file;
  std::string name;
  std::vector<TypedName> types;  // types with their parents
  std::vector<Symbol> predicates;
  std::vector<Symbol> functions;
  std::vector<Symbol> externs;
  std::vector<TypedName> constants;
  std::vector<Action> actions;
  std::vector<Effect> updates;  // rules that are applied after every action until nothing changes
};

struct Problem {
  std::string file;
  std::string name;
  std::string domain;
  Place domain_place;  // the place where the problem names its domain
  std::vector<TypedName> objects;
  std::vector<Literal> extern_facts;  // the facts of externs for which no procedure is given
  std::vector<Change> init;
  Query goal;
};

}  // namespace assay::contingent
