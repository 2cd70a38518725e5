#pragma once

#include <string>

#include "planner/contingent/language/domain.h"

namespace assay::contingent {

// Read the fragment of PDDL that public contingent planners use: typing, constants, negative and
// disjunctive conditions, conditional effects (when), and
//   :observe ATOM              in an action: add(Kw, ATOM)
//   (unknown ATOM)             in :init
//   (oneof LITERAL ...)        in :init: exactly one holds
//   (or LITERAL ...)           in :init: at least one holds
// What :init does not name is false. :requirements and :hidden are ignored. Names are not
// case-sensitive. The result reads as a .pks domain: conditions become K of literals, effects
// add(Kf, ...). Throw InputError with file, line and column.
Domain ReadPddlDomain(const std::string& text, const std::string& file);
// The problem needs the domain's predicates, to close the world. It may name the domain with a slip
// (NearestName), but no other.
Problem ReadPddlProblem(const std::string& text, const std::string& file, const Domain& domain);

}  // namespace assay::contingent
