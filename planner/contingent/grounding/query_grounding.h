#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner/contingent/grounding/term_grounding.h"
#include "planner/contingent/language/externs.h"

namespace assay::contingent {

// Makes queries without variables. It answers queries about facts that are known from the start and
// never change, and it calls externs.
class QueryGrounding {
 public:
  QueryGrounding(TermGrounding& terms, Externs& externs) : terms_(terms), externs_(externs) {}

  GroundQuery QueryOf(const Query& query, Bindings bindings);
  // Returns the query that asks whether the literal is known.
  GroundQuery KnownLiteral(const Literal& literal, const Bindings& bindings);
  // Returns the conjunction of the literals as a formula for Kw. Returns none if it is always known
  // whether the conjunction holds.
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
