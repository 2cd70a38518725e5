#pragma once

#include "planner/algebra/normal_forms/normal_form.h"

namespace assay::algebra {

// Returns the normal form of e. A product is expanded only if the result has at most `most_terms`
// terms and the expansion takes at most 100 * `most_terms` multiplications of terms.
NormalForm NormalFormOf(const Expression& e, int most_terms = 20'000,
                        AtomArguments arguments = AtomArguments::kExact);

// From this call on, sub-expressions that the pool's expressions share are expanded once, and their
// normal forms are kept, up to a limit. This pays for many expressions with common parts. It does
// not change any normal form.
void KeepNormalForms(ExpressionPool& pool);

// Returns ToExpression of the normal form with rounded arguments, without building that form.
Expression SimplifiedExpression(const Expression& e, int most_terms);

}  // namespace assay::algebra
