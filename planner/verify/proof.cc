#include "planner/verify/proof.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "planner/algebra/bounds/sensitivity.h"
#include "planner/algebra/expression/evaluation.h"
#include "planner/algebra/expression/simplify.h"
#include "planner/algebra/expression/text.h"

namespace assay::verify {
namespace {

using algebra::BoundRequest;
using algebra::Expression;
using plan::CertifiedPrecondition;
using plan::Relation;

// Only the cheap bounding methods are used, because there are many questions. A remedy that they
// find is proved, but a milder one may exist.
constexpr BoundRequest kCheap = {.highest = algebra::BoundingMethod::kMonotone};

double MiddleOf(const Interval& range) {
  if (std::isfinite(range.low) && std::isfinite(range.high)) return (range.low + range.high) / 2;
  return std::clamp(0.0, range.low, range.high);
}

void CollectTerms(const Expression& e, std::vector<Expression>& terms) {
  if (e.op() != algebra::Operator::kSum) {
    terms.push_back(e);
    return;
  }
  for (const Expression& operand : e.operands()) CollectTerms(operand, terms);
}

std::vector<std::string> TermTexts(const Expression& e, const algebra::ConstraintSet& box) {
  std::vector<Expression> terms;
  CollectTerms(e, terms);
  const auto width = [&](const Expression& term) -> double {
    const Interval range = algebra::Evaluate(term, box.box);
    return range.low == range.high ? 0 : range.high - range.low;
  };
  std::ranges::stable_sort(terms, std::greater(), width);
  std::vector<std::string> texts;
  for (const Expression& term : terms) texts.push_back(algebra::Text(term));
  return texts;
}

Interval Shrunk(const Interval& range, double factor) {
  const double middle = MiddleOf(range);
  if (factor == 0) return {middle, middle};
  return {middle - factor * (middle - range.low), middle + factor * (range.high - middle)};
}

}  // namespace

bool Proof::IsRefuted() const {
  if (!at_worst) return false;
  return claim.relation == Relation::kLess ? *at_worst >= claim.limit : *at_worst <= claim.limit;
}

CertificateProofs::CertificateProofs(const plan::PlannedStep& step, const std::string& file)
    : algebra_(step, file) {}

std::string CertificateProofs::ExpressionText(const CertifiedPrecondition& claim) const {
  return algebra::Text(algebra::Simplify(algebra_.Read(claim.expression)));
}

bool CertificateProofs::IsNumber(const CertifiedPrecondition& claim) const {
  return algebra::Simplify(algebra_.Read(claim.expression)).IsConstant();
}

Proof CertificateProofs::Of(const CertifiedPrecondition& claim) const {
  const algebra::ExpressionPool& pool = algebra_.pool();
  const algebra::ConstraintSet& box = algebra_.box();
  const Expression e = algebra::Simplify(algebra_.Read(claim.expression));
  const bool less = claim.relation == Relation::kLess;
  std::vector<double> point;
  for (const Interval& range : box.box) point.push_back(MiddleOf(range));
  Proof proof = {
      .claim = claim, .is_number = e.IsConstant(), .nominal = algebra::Evaluate(e, point)};
  proof.terms = TermTexts(e, box);
  std::vector<std::optional<double>> worst(box.box.size());
  for (const auto& [name, value] : claim.worst) {
    if (const auto variable = pool.Find(name)) {
      worst[variable->index()] = point[variable->index()] = value;
    }
  }
  if (!claim.worst.empty()) proof.at_worst = algebra::Evaluate(e, point);
  if (std::isfinite(claim.bound)) {
    for (const algebra::Share& share :
         less ? SharesOfSup(e, box, kCheap) : SharesOfInf(e, box, kCheap)) {
      proof.variables.push_back({.name = pool.name(share.variable),
                                 .dimension = algebra_.DimensionOf(share.variable),
                                 .range = box.box[share.variable.index()],
                                 .worst = worst[share.variable.index()],
                                 .cost = share.cost});
    }
  }
  if (claim.holds()) return proof;
  const auto tightenings = less ? TighteningsToBringSupBelow(claim.limit, e, box, kCheap)
                                : TighteningsToBringInfAbove(claim.limit, e, box, kCheap);
  if (!tightenings.empty()) {
    const algebra::VariableId variable = tightenings.front().variable;
    const Interval& range = box.box[variable.index()];
    proof.remedy = {.name = pool.name(variable),
                    .dimension = algebra_.DimensionOf(variable),
                    .range = range,
                    .enough = Shrunk(range, tightenings.front().factor)};
  }
  return proof;
}

}  // namespace assay::verify
