#pragma once

#include <string>
#include <vector>

#include "planner/contingent/grounding/ground_task.h"

namespace assay::contingent {

// Queries without variables, simplified while they are made: what is always true or false is told
// by GroundQuery::IsTrue and IsFalse.
GroundQuery ConstantQuery(bool value);
GroundQuery Negated(GroundQuery operand);
// kAnd or kOr of the operands, flattened, without what does not matter.
GroundQuery Joined(GroundQuery::Kind kind, std::vector<GroundQuery> operands);
GroundQuery Known(GroundLiteral literal);
GroundQuery BoundKnown(const Bound& bound);

// Whether it asks K alone, of literals and bounds, so that it can be asked of a world.
bool AsksOfTheWorld(const GroundQuery& query);
bool HasBound(const GroundQuery& query);
bool HasNegation(const GroundQuery& query);
// Whether anything of the task asks for what is not known: only then can more knowledge do harm.
bool AsksForIgnorance(const GroundTask& task);

// "K(on(a, b))", "!(Kw(p) | K(n > 2))".
std::string TextOf(const GroundTask& task, const GroundQuery& query);

}  // namespace assay::contingent
