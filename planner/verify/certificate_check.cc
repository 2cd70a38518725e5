#include "planner/verify/certificate_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <variant>

#include "planner/algebra/bounding_methods/glance.h"
#include "planner/algebra/bounds/bounds.h"
#include "planner/algebra/expression/evaluation.h"
#include "planner/algebra/expression/nodes.h"
#include "planner/base/counted.h"
#include "planner/plan/certificates/condition_table.h"
#include "planner/uncertainty/error_sets/tip_error.h"
#include "planner/verify/certificate_algebra.h"

namespace assay::verify {
namespace {

using algebra::VariableId;
using plan::CertifiedPrecondition;
using plan::Relation;

// The tolerance for numbers that are computed from other numbers of the file in doubles, in metres
// or radians.
constexpr double kDifference = 1e-9;  // absolute below 1, relative above
constexpr double kRounding = 1e-12;   // of an expression's value at a point

// Returns whether two numbers agree. Infinite numbers agree only if they are equal, and NaN never
// does.
bool AreSame(double a, double b) {
  return a == b ||
         std::abs(a - b) <= kDifference * std::max(1.0, std::min(std::abs(a), std::abs(b)));
}

const char* NameOfBound(const CertifiedPrecondition& claim) {
  return claim.relation == Relation::kLess ? "SUP" : "INF";
}

// Checks one claim of a certificate against its expression.
class ClaimCheck {
 public:
  ClaimCheck(const CertifiedPrecondition& claim, const CertificateAlgebra& algebra)
      : claim_(claim), algebra_(algebra), expression_(algebra.Read(claim.expression)) {}

  std::vector<std::string> Flaws() {
    CheckMargin();
    CheckCorner();
    if (claim_.holds()) CheckProof();
    return std::move(flaws_);
  }

 private:
  bool is_less() const { return claim_.relation == Relation::kLess; }
  double MarginOf(double bound) const {
    return is_less() ? claim_.limit - bound : bound - claim_.limit;
  }
  // Returns whether a value that the expression attains contradicts the stated bound.
  bool IsCrossedBy(double value) const {
    return is_less() ? value > claim_.bound + kRounding : value < claim_.bound - kRounding;
  }

  void CheckMargin() {
    const double margin = MarginOf(claim_.bound);
    if (AreSame(margin, claim_.margin)) return;
    Add("the margin is said to be {:.9g}, but from the bound {:.9g} to the limit {:.9g} it is "
        "{:.9g}",
        claim_.margin, claim_.bound, claim_.limit, margin);
  }

  void CheckCorner() {
    if (claim_.worst.empty()) return;
    const std::optional<std::vector<double>> corner = Corner();
    if (!corner) return;
    const double attained = algebra::Evaluate(expression_, *corner);
    if (std::isnan(attained)) return Add("the expression has no value at the worst corner");
    if (IsCrossedBy(attained)) {
      return Add("the bound is said to be {:.9g}, but the expression is {:.9g} at the worst corner",
                 claim_.bound, attained);
    }
    const double gap = std::abs(claim_.bound - attained);
    if (gap > claim_.gap && !AreSame(gap, claim_.gap)) {
      Add("the gap is said to be {:.9g}, but from the bound {:.9g} to the worst corner it is "
          "{:.9g}",
          claim_.gap, claim_.bound, gap);
    }
  }

  // Returns the worst corner by VariableId, or nothing if it is not a point of the ranges.
  std::optional<std::vector<double>> Corner() {
    std::vector<std::optional<double>> given(algebra_.box().box.size());
    for (const auto& [name, value] : claim_.worst) {
      const std::optional<VariableId> variable = algebra_.pool().Find(name);
      if (!variable) return NoCorner("names '{}', which is no variable of the certificate", name);
      const Interval& allowed = algebra_.box().box[variable->index()];
      if (!(allowed.low <= value && value <= allowed.high)) {
        return NoCorner("is not in the range of {}", name);
      }
      given[variable->index()] = value;
    }
    std::vector<double> point(given.size());
    for (const VariableId variable : algebra::VariablesOf(expression_)) {
      if (!given[variable.index()]) return NoCorner("lacks {}", algebra_.pool().name(variable));
      point[variable.index()] = *given[variable.index()];
    }
    return point;
  }

  // The bounding methods work on normal forms. GlanceAbove and GlanceBelow work on the expression
  // as it is stored, and prove some claims that the bounding methods do not prove.
  void CheckProof() {
    const std::vector<Interval>& box = algebra_.box().box;
    const algebra::Bound bound = BoundAnew();
    if (!bound.at.empty()) {
      const double attained = algebra::Evaluate(expression_, bound.at);
      if (IsCrossedBy(attained)) {
        Add("the bound is said to be {:.9g}, but the expression attains {:.9g}", claim_.bound,
            attained);
      }
    }
    if (MarginOf(bound.value) > 0) return;
    const double glance = is_less() ? GlanceAbove(expression_, box, claim_.limit).bound
                                    : GlanceBelow(expression_, box, claim_.limit).bound;
    if (MarginOf(glance) > 0) return;
    Add("it is said to be proved, but {} computed anew is {:.9g}, must be {} {:.9g}",
        NameOfBound(claim_), bound.value, is_less() ? '<' : '>', claim_.limit);
  }

  // Bounds the expression as tightly as needed to tell on which side of the limit it is.
  algebra::Bound BoundAnew() const {
    algebra::BoundRequest request = {.gap = 0};
    request.limit = claim_.limit;
    return is_less() ? BoundAbove(expression_, algebra_.box(), request)
                     : BoundBelow(expression_, algebra_.box(), request);
  }

  template <class... Values>
  void Add(fmt::format_string<Values...> text, Values&&... values) {
    flaws_.push_back(fmt::format(text, std::forward<Values>(values)...));
  }
  template <class... Values>
  std::nullopt_t NoCorner(fmt::format_string<Values...> text, Values&&... values) {
    Add("the worst corner {}", fmt::format(text, std::forward<Values>(values)...));
    return std::nullopt;
  }

  const CertifiedPrecondition& claim_;
  const CertificateAlgebra& algebra_;
  algebra::Expression expression_;
  std::vector<std::string> flaws_;
};

// A strategy absorbs errors only within the tip errors that it is certain for. Each step with a
// strategy must therefore have claims about the tip errors.
bool LacksTipErrors(const plan::PlannedStep& step) {
  if (!step.strategy || step.certificate == plan::Certificate{}) return false;
  const auto is_claimed = [&](plan::Condition condition) {
    return std::ranges::count(step.certificate.preconditions, condition,
                              &CertifiedPrecondition::condition) > 0;
  };
  return !is_claimed(plan::condition::kTipShift) || !is_claimed(plan::condition::kTipTurn);
}

// Each axis in turn has two claims, one for each sign.
bool IsProvedWithin(const plan::PlannedStep& step, plan::Condition condition,
                    const geometry::Vector3& most) {
  int claims = 0;
  return std::ranges::all_of(step.certificate.preconditions, [&](const auto& claim) {
    if (claim.condition != condition) return true;
    const int axis = claims++ / 2 % 3;
    return std::abs(claim.limit) <= most[axis] + kDifference;
  });
}

// The proved bounds of the tip's errors must lie within the errors for which the strategy is
// certain. Returns true if they do not.
bool ExceedsTipErrors(const plan::PlannedStep& step) {
  if (!step.strategy) return false;
  const plan::StrategyCertificate& certificate = step.strategy->certificate;
  return !IsProvedWithin(step, plan::condition::kTipShift, certificate.d) ||
         !IsProvedWithin(step, plan::condition::kTipTurn, uncertainty::SinesWithin(certificate.w));
}

void CheckClaims(plan::StepId id, const plan::PlannedStep& step, const std::string& file,
                 std::vector<plan::Flaw>& flaws) {
  const CertificateAlgebra algebra(step, file);
  const std::vector<CertifiedPrecondition>& claims = step.certificate.preconditions;
  for (std::size_t i = 0; i < claims.size(); ++i) {
    for (const std::string& flaw : ClaimCheck(claims[i], algebra).Flaws()) {
      flaws.push_back(
          {id, fmt::format("precondition {}, {}: {}", i + 1, claims[i].condition.name(), flaw)});
    }
  }
}

}  // namespace

bool IsUnproved(const plan::PlannedStep& step) {
  return !std::ranges::all_of(step.certificate.preconditions, [&](const auto& claim) {
    return claim.holds() || plan::Absorbs(step.strategy, claim.condition);
  });
}

std::vector<plan::Flaw> CertificateFlaws(const plan::Plan& plan, const std::string& file) {
  std::vector<plan::Flaw> flaws;
  if (!IsCertified(plan)) return flaws;
  const auto unproved = std::ranges::count_if(plan.steps, IsUnproved);
  if (plan.errors != unproved) {
    flaws.push_back(
        {plan::StepId(),
         fmt::format("the error count is said to be {}, but preconditions of {} are not "
                     "proved",
                     plan.errors, Counted(unproved, "step"))});
  }
  for (const plan::StepId id : plan.ExecutionOrder()) {
    CheckClaims(id, plan.step(id), file, flaws);
    if (LacksTipErrors(plan.step(id))) {
      flaws.push_back(
          {id, "the certificate lacks limits for the errors that its strategy assumes"});
    }
    if (ExceedsTipErrors(plan.step(id))) {
      flaws.push_back(
          {id, "limits of the tip's errors are wider than what its strategy is certain for"});
    }
  }
  return flaws;
}

}  // namespace assay::verify
