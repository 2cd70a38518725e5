#pragma once

#include <memory>
#include <string>
#include <vector>

#include "planner/algebra/expression/expression.h"
#include "planner/algebra/linear/constraint_set.h"
#include "planner/plan/data/plan.h"

namespace assay::verify {

// The variables of a step's certificate, and its expressions over them, read back from their texts.
class CertificateAlgebra {
 public:
  // `file`: where the plan comes from, for errors. Throws InputError if the certificate's variables
  // have no proper names, or a range holds no number.
  CertificateAlgebra(const plan::PlannedStep& step, const std::string& file);

  // Throws InputError if the text is no expression over the variables.
  algebra::Expression Read(const std::string& text) const;

  const algebra::ExpressionPool& pool() const { return *pool_; }
  const algebra::ConstraintSet& box() const { return box_; }  // the variables' ranges

 private:
  std::string place_;
  std::unique_ptr<algebra::ExpressionPool> pool_;
  algebra::ConstraintSet box_;
  std::vector<algebra::Expression> shared_;
};

}  // namespace assay::verify
