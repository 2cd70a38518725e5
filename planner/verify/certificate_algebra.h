#pragma once

#include <memory>
#include <string>
#include <vector>

#include "planner/algebra/expression/expression.h"
#include "planner/algebra/sup_inf/constraint_set.h"
#include "planner/plan/data/plan.h"

namespace assay::verify {

// The variables of a step's certificate and its expressions over them, parsed from their texts.
class CertificateAlgebra {
 public:
  // `file` is the plan's path, for error messages. Throws InputError if a variable of the
  // certificate has no proper name, or if a range holds no number.
  CertificateAlgebra(const plan::PlannedStep& step, const std::string& file);

  // Parses an expression. Throws InputError if the text is no expression over the variables.
  algebra::Expression Read(const std::string& text) const;

  const algebra::ExpressionPool& pool() const { return *pool_; }
  const algebra::ConstraintSet& box() const { return box_; }  // ranges of the variables
  domain::Dimension DimensionOf(algebra::VariableId variable) const {
    return dimensions_[static_cast<std::size_t>(variable.index())];
  }

 private:
  std::string place_;
  std::unique_ptr<algebra::ExpressionPool> pool_;
  algebra::ConstraintSet box_;
  std::vector<domain::Dimension> dimensions_;  // by VariableId
  std::vector<algebra::Expression> shared_;
};

}  // namespace assay::verify
