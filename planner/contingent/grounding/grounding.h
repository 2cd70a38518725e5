#pragma once

#include "planner/contingent/grounding/ground_task.h"
#include "planner/contingent/language/domain.h"
#include "planner/contingent/language/externs.h"

namespace assay::contingent {

// Which of the facts that are known at first become atoms.
enum class KnownFacts {
  kAsked,  // those that queries and changes are about
  kAll,    // also those that nothing asks or changes, so that the knowledge base has all of init
};

// The task without variables. Queries of what is known from the first and never changes are
// answered, externs are asked, and actions whose precondition cannot hold are left out.
//
// A parameter ?x with a precondition K(?x = f(a)) stands for each constant, and, if some action
// comes to know f(a), for the value that f(a) has at run time (a run-time variable): then its
// argument is the text of f(a), the precondition asks Kv(f(a)), and ?x may stand in equalities
// alone.
//
// Checks types first (type_check.h). Throws InputError where domain or problem are wrong.
GroundTask Ground(Domain domain, Problem problem, Externs& externs,
                  KnownFacts facts = KnownFacts::kAsked);

}  // namespace assay::contingent
