#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner/contingent/language/domain.h"

// Functions that build domains and problems in a program. They return what the readers of files
// return for the texts in the comments, without places.
namespace assay::contingent {

Term Constant(const std::string& name);                             // name
Term NumberTerm(const Interval& value);                             // [low, high]
Term Of(const std::string& function, const std::string& argument);  // function(argument)

// predicate(argument, ...)
Literal Atom(const std::string& predicate, const std::vector<std::string>& arguments);
Literal Not(Literal literal);                 // !literal
Literal Equal(const Term& a, const Term& b);  // a = b

Query Known(const Literal& literal);                // K(literal)
Query ValueKnown(const Term& term, double within);  // Kv(term within ...)
Query All(std::vector<Query> operands);             // operand & ...; true without operands
Query Any(std::vector<Query> operands);             // operand | ...

Change Know(const Literal& fact);                     // add(Kf, fact)
Change KnowWhether(const Literal& fact);              // add(Kw, fact)
Change KnowOneOf(std::vector<Literal> alternatives);  // add(Kx, alternative | ...)
// add(Kv, term within ...); without `within`, the value becomes known exactly.
Change KnowValue(const Term& term, std::optional<double> within);
Change Forget(const Literal& fact);  // del(Kf, fact)

}  // namespace assay::contingent
