#include "sim/cli/proof.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "planner/algebra/sensitivity.h"
#include "planner/algebra/text.h"
#include "planner/base/input_error.h"

namespace assay::cli {
namespace {

using algebra::BoundRequest;
using algebra::Expression;
using plan::CertifiedPrecondition;
using plan::Relation;

// The questions are many, and asked of the cheap rungs: what they say of a remedy is proved, but a
// milder one may do.
constexpr BoundRequest kCheap = {.highest = algebra::Rung::kMonotone};

bool IsName(const std::string& text) {
  const auto is_letter = [](unsigned char c) { return std::isalpha(c) != 0 || c == '_'; };
  return !text.empty() && is_letter(static_cast<unsigned char>(text[0])) &&
         std::ranges::all_of(text,
                             [&](unsigned char c) { return is_letter(c) || std::isdigit(c) != 0; });
}

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

CertificateProofs::CertificateProofs(const plan::PlannedStep& step)
    : step_(step), pool_(std::make_unique<algebra::ExpressionPool>()) {
  for (const plan::ErrorVariable& variable : step.certificate.variables) {
    if (!IsName(variable.name) || pool_->Find(variable.name)) {
      throw InputError({.file = "certificate of " + step.name},
                       fmt::format("'{}' is no new variable", variable.name),
                       "names of letters, digits and _, each once");
    }
    pool_->Declare(variable.name, variable.range);
  }
  box_ = algebra::DeclaredBox(*pool_);
}

Expression CertificateProofs::Read(const std::string& text) const {
  return algebra::Parse(text, *pool_, {"an expression in the certificate of " + step_.name, 1, 1});
}

Proof CertificateProofs::Of(const CertifiedPrecondition& claim) const {
  const Expression e = Read(claim.expression);
  const bool less = claim.relation == Relation::kLess;
  std::vector<double> point;
  for (const Interval& range : box_.box) point.push_back(MiddleOf(range));
  Proof proof = {.claim = claim, .nominal = algebra::Evaluate(e, point)};
  proof.terms = TermTexts(e, box_);
  std::vector<std::optional<double>> worst(box_.box.size());
  for (const plan::ErrorVariable& corner : claim.worst) {
    const auto variable = pool_->Find(corner.name);
    if (!variable) continue;
    worst[variable->index()] = point[variable->index()] = MiddleOf(corner.range);
  }
  if (!claim.worst.empty()) proof.at_worst = algebra::Evaluate(e, point);
  if (std::isfinite(claim.bound)) {
    for (const algebra::Share& share :
         less ? SharesOfSup(e, box_, kCheap) : SharesOfInf(e, box_, kCheap)) {
      proof.variables.push_back({.name = pool_->name(share.variable),
                                 .range = box_.box[share.variable.index()],
                                 .worst = worst[share.variable.index()],
                                 .cost = share.cost});
    }
  }
  if (claim.holds()) return proof;
  const auto tightenings = less ? TighteningsToBringSupBelow(claim.limit, e, box_, kCheap)
                                : TighteningsToBringInfAbove(claim.limit, e, box_, kCheap);
  if (!tightenings.empty()) {
    const Interval& range = box_.box[tightenings.front().variable.index()];
    proof.remedy = {.name = pool_->name(tightenings.front().variable),
                    .range = range,
                    .enough = Shrunk(range, tightenings.front().factor)};
  }
  return proof;
}

}  // namespace assay::cli
