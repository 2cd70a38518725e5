#pragma once

#include "planner/contingent/grounding/ground_task.h"
#include "planner/contingent/language/domain.h"
#include "planner/contingent/language/externs.h"

namespace assay::contingent {

// Which of the facts that are known initially become atoms.
enum class KnownFacts {
  kAsked,  // the facts that occur in queries and changes
  kAll,    // all facts, so that the knowledge base contains all of init
};

// Returns the task without variables. Queries about facts that are known from the start and never
// change are answered, externs are called, and actions whose precondition cannot hold are left out.
//
// A parameter ?x with a precondition K(?x = f(a)) stands for each constant. If some action senses
// f(a), the parameter can be a run-time variable too, which stands for the value that f(a) has at
// run time. In that instance the argument is the text of f(a), the precondition asks Kv(f(a)), and
// ?x may stand only in equalities.
//
// Checks types first (type_check.h). Throws InputError where the domain or the problem is wrong.
GroundTask Ground(Domain domain, Problem problem, Externs& externs,
                  KnownFacts facts = KnownFacts::kAsked);

}  // namespace assay::contingent
