#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "planner/contingent/language/domain.h"
#include "planner/contingent/pks_and_pddl/s_expression.h"

namespace assay::contingent {

inline constexpr const char* kPddlRootType = "object";

// Reads what sections of a PDDL file consist of: words, typed names, literals and conditions. All
// errors are InputErrors with the element's place.
class PddlFormulas {
 public:
  using Items = std::span<const SExpression>;

  explicit PddlFormulas(const std::string& file) : file_(file) {}  // keeps a reference

  const std::string& file() const { return file_; }

  // Returns the items of a list from this index on.
  static Items Rest(const SExpression& list, std::size_t from);
  const std::string& Word(const SExpression& e, const std::string& what) const;
  // Returns the only item after the first.
  const SExpression& Only(const SExpression& list) const;
  // Reads a list of names with types. In `a b - type c`, the untyped name c gets the root type.
  std::vector<TypedName> TypedNames(Items items) const;
  // Reads a literal. `allowed` describes, for the message, what may stand there.
  Literal ReadLiteral(const SExpression& e, const std::string& allowed) const;
  // Returns the condition in negation normal form.
  Query Condition(const SExpression& e, bool is_positive) const;

  [[noreturn]] void Fail(const SExpression& at, const std::string& what,
                         const std::string& allowed) const;

 private:
  const std::string& file_;
};

}  // namespace assay::contingent
