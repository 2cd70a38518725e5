#pragma once

#include <string>

#include "planner/contingent/language/domain.h"

namespace assay::contingent {

// ReadPddlDomain and ReadPddlProblem read the fragment of PDDL that public contingent planners use:
// typing, constants, negative and disjunctive conditions, conditional effects (when), and
//   :observe ATOM              in an action: add(Kw, ATOM)
//   (unknown ATOM)             in :init
//   (oneof LITERAL ...)        in :init: exactly one holds
//   (or LITERAL ...)           in :init: at least one holds
//
// Atoms that :init does not name are false. :requirements and :hidden are ignored. Names are not
// case-sensitive. The result has the form of a .pks domain: conditions become K of literals, and
// effects become add(Kf, ...). Both functions throw InputError with file, line and column.
Domain ReadPddlDomain(const std::string& text, const std::string& file);
// Reads a problem. `domain` provides the predicates that are needed to close the world. The
// domain's name in the problem may have a slip (NearestName), but another name is an error.
Problem ReadPddlProblem(const std::string& text, const std::string& file, const Domain& domain);

}  // namespace assay::contingent
