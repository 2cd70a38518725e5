#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner/contingent/grounding/term_grounding.h"
#include "planner/contingent/language/externs.h"

namespace assay::contingent {

// Queries without variables. What is known from the first and never changes is answered, externs
// are asked.
class QueryGrounding {
 public:
  QueryGrounding(TermGrounding& terms, Externs& externs) : terms_(terms), externs_(externs) {}

  GroundQuery QueryOf(const Query& query, Bindings bindings);
  // Whether the literal is known.
  GroundQuery KnownLiteral(const Literal& literal, const Bindings& bindings);
  // The conjunction of the literals, as Kw can hold it; none if it is always known whether it
  // holds.
  std::optional<FormulaId> FormulaOf(const std::vector<Literal>& literals,
                                     const Bindings& bindings);

 private:
  GroundQuery KnownWhether(const Query& query, const Bindings& bindings);
  GroundQuery ValueKnown(FunctionId function, std::optional<double> within = std::nullopt);
  GroundQuery KnownAtom(const Literal& literal, const Bindings& bindings);
  GroundQuery KnownEqual(const Literal& literal, const Bindings& bindings);
  bool NeverHolds(const Formula& formula) const;
  GroundQuery FunctionsEqual(FunctionId f, FunctionId g, bool is_positive);

  TermGrounding& terms_;
  Externs& externs_;
};

}  // namespace assay::contingent
