#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "planner/base/document/input_error.h"
#include "planner/base/interval.h"

// What a contingent planning domain and problem say, before anything is checked or grounded: both
// readers (.pks and PDDL) make it. Semantics: Petrick and Bacchus, AIPS 2002 and ICAPS 2004, as
// restated in scenarios/know/README.md.
namespace assay::contingent {

// Lines and columns count from 1; 0 where the reader made it up.
struct Place {
  int line = 0;
  int column = 0;

  bool operator==(const Place&) const = default;
};

// A name with its type: a parameter, a constant, a type with its parent. Type "" is any.
struct TypedName {
  std::string name;
  std::string type = {};
  Place place = {};
};

// Levels of conditions, effects and lists in a file: so none overflows the stack.
inline constexpr int kDeepestNesting = 100;
// Characters of a word in a file: messages repeat words.
inline constexpr std::size_t kLongestWord = 1000;

inline constexpr const char* kNumberType = "number";  // of functions whose value is an interval

struct Term {
  enum class Kind {
    kConstant,
    kVariable,  // ?x
    kFunction,  // f(x, y): of objects, or of numbers
    kNumber,    // an interval, [2, 2] for the number 2
    kSum,       // of two numeric terms
    kDifference,
  };
  Kind kind = Kind::kConstant;
  std::string name;
  std::vector<Term> arguments;
  Interval value;
  Place place;
};

enum class Relation { kPredicate, kExtern, kEqual, kLess, kLessOrEqual, kGreater, kGreaterOrEqual };

// An atom or its negation. The arguments are those of the predicate, or the two sides.
struct Literal {
  bool is_positive = true;
  Relation relation = Relation::kPredicate;
  std::string predicate;
  std::vector<Term> arguments;
  Place place;
};

// What is asked of a knowledge state (facts on K, Kw and Kv: Petrick and Bacchus 2002, section 3).
struct Query {
  enum class Kind {
    kAnd,  // of all operands; of none: always true
    kOr,
    kNot,
    kKnown,         // K(l & ...): every literal is known
    kKnownWhether,  // Kw(l & ...): it is known whether all of them hold
    kValueKnown,    // Kv(f(x))
    kForAll,        // forallK(?x: type) operand
    kExists,        // existsK
  };
  Kind kind = Kind::kAnd;
  std::vector<Literal> literals;
  std::vector<Term> terms;  // of kValueKnown: one
  std::optional<double>
      within;  // of kValueKnown: half the width of the interval it is known to be in
  std::vector<TypedName> variables;
  std::vector<Query> operands;
  Place place;
};

enum class Store { kFacts, kWhether, kValues, kExclusive, kClosed };  // Kf, Kw, Kv, Kx, LCW

// add(Kf, ...) or del(Kf, ...) and so on.
struct Change {
  bool is_addition = true;
  Store store = Store::kFacts;
  // Kf: one. Kw: the conjunction. Kx: the alternatives. LCW: one, with free variables.
  std::vector<Literal> literals;
  std::vector<Term> terms;           // Kv: one
  std::optional<double> within;      // Kv: the sensor errs by so much at most; not at all if none
  std::vector<TypedName> variables;  // LCW: free in the literal
  // Of Kx: one or more of the alternatives hold, written some(...), instead of exactly one.
  bool is_inclusive = false;
  Place place;
};

// forall (?x: type) condition => changes, for each value of the variables.
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
  std::vector<TypedName> parameters;  // names may be empty
  std::string range;                  // of functions
  Place place;
};

struct Domain {
  std::string file;
  std::string name;
  std::vector<TypedName> types;  // with their parents
  std::vector<Symbol> predicates;
  std::vector<Symbol> functions;
  std::vector<Symbol> externs;
  std::vector<TypedName> constants;
  std::vector<Action> actions;
  std::vector<Effect> updates;  // applied after every action until nothing changes
};

struct Problem {
  std::string file;
  std::string name;
  std::string domain;
  Place domain_place;  // where the problem names it
  std::vector<TypedName> objects;
  std::vector<Literal> extern_facts;  // what externs say that no procedure is given for
  std::vector<Change> init;
  Query goal;
};

}  // namespace assay::contingent
