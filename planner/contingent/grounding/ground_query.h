#pragma once

#include <set>
#include <string>
#include <vector>

#include "planner/contingent/grounding/ground_task.h"

namespace assay::contingent {

// The functions below make queries without variables and simplify them. GroundQuery::IsTrue and
// IsFalse identify queries that always or never hold.
GroundQuery ConstantQuery(bool value);
GroundQuery Negated(GroundQuery operand);
// Returns the kAnd or kOr of the operands, flattened, without operands that make no difference.
GroundQuery Joined(GroundQuery::Kind kind, std::vector<GroundQuery> operands);
GroundQuery Known(GroundLiteral literal);
GroundQuery BoundKnown(const Bound& bound);

// Returns true if the query asks only K of literals and of bounds, so it has an answer in each
// world.
bool AsksOfTheWorld(const GroundQuery& query);
bool HasBound(const GroundQuery& query);
// Returns true if anything in the task asks that something is not known. More knowledge can do harm
// only if this is true.
bool AsksForIgnorance(const GroundTask& task);

// Returns the functions of whose values anything in the task asks K(f = c), or K of a bound. A
// run-time variable asks for no value.
std::set<FunctionId> FunctionsAskedFor(const GroundTask& task);

// Returns true if some effect depends on what is known or not known, so the change of one world
// depends on the other worlds.
bool HappensByKnowledge(const GroundTask& task);

// Returns true if more knowledge never does harm: no effect depends on what is known, and no query
// asks that something is not known.
bool IsMonotone(const GroundTask& task);

// Returns the text of a query: "K(on(a, b))", "!(Kw(p) | K(n > 2))".
std::string TextOf(const GroundTask& task, const GroundQuery& query);

}  // namespace assay::contingent
