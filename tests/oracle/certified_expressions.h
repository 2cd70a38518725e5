#pragma once

#include <vector>

#include "planner/algebra/expression/expression.h"
#include "planner/algebra/expression/parse.h"
#include "planner/algebra/expression/text.h"
#include "planner/plan/certificates/certificate.h"

namespace assay::oracle {

// Returns the expressions of a certificate's preconditions, read from their texts. `pool` must be
// empty, and gets the certificate's variables.
inline std::vector<algebra::Expression> CertifiedExpressions(const plan::Certificate& certificate,
                                                             algebra::ExpressionPool& pool) {
  for (const plan::ErrorVariable& variable : certificate.variables) {
    pool.Declare(variable.name, variable.range);
  }
  const std::vector<algebra::Expression> shared =
      algebra::ParseShared(certificate.shared, pool, {});
  std::vector<algebra::Expression> expressions;
  for (const plan::CertifiedPrecondition& claim : certificate.preconditions) {
    expressions.push_back(
        algebra::Parse(claim.expression, pool, {}, algebra::Layout::kOther, shared));
  }
  return expressions;
}

}  // namespace assay::oracle
