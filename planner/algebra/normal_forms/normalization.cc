#include "planner/algebra/normal_forms/normalization.h"

#include <memory>
#include <optional>

#include "planner/algebra/normal_forms/expansion.h"

namespace assay::algebra {

class KeptNormalForms {
 public:
  Expansion& ExpansionFor(const Expression& e, int most_terms, AtomArguments arguments) {
    std::optional<Expansion>& kept = arguments == AtomArguments::kExact ? exact_ : rounded_;
    const bool is_full = kept && kept->kept_terms() > kMostTerms;
    if (!kept || is_full || kept->most_terms() != most_terms) {
      kept.emplace(e.pool(), most_terms, arguments);
    }
    return *kept;
  }

 private:
  static constexpr std::size_t kMostTerms = 1'000'000;  // about 30 MB

  std::optional<Expansion> exact_;
  std::optional<Expansion> rounded_;
};

void KeepNormalForms(ExpressionPool& pool) {
  pool.kept_normal_forms_ = std::make_shared<KeptNormalForms>();
}

NormalForm NormalFormOf(const Expression& e, int most_terms, AtomArguments arguments) {
  if (e.IsConstant(0)) return {};
  if (e.IsConstant()) {
    return {.terms = {{.coefficient = {e.constant(), e.constant()}, .factors = {}}}};
  }
  if (KeptNormalForms* const kept = e.pool()->kept_normal_forms()) {
    Expansion& many = kept->ExpansionFor(e, most_terms, arguments);
    return many.FormOf(many.OfOneOfMany(e));
  }
  Expansion one(e.pool(), most_terms, arguments);
  return one.FormOf(one.Of(e));
}

Expression SimplifiedExpression(const Expression& e, int most_terms) {
  if (e.IsConstant()) return e;
  if (KeptNormalForms* const kept = e.pool()->kept_normal_forms()) {
    return kept->ExpansionFor(e, most_terms, AtomArguments::kRounded).WrittenOneOfMany(e);
  }
  Expansion one(e.pool(), most_terms, AtomArguments::kRounded);
  return one.Written(one.Of(e));
}

}  // namespace assay::algebra
