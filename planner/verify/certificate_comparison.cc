#include "planner/verify/certificate_comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "planner/algebra/expression/evaluation.h"
#include "planner/assembly/travel/way_conditions.h"
#include "planner/base/random.h"
#include "planner/constraint_posting/uncertainty_phase/verification.h"
#include "planner/domain/matings/shaft_fit.h"
#include "planner/plan/certificates/coverage.h"
#include "planner/plan/plan_files/certificate_file.h"
#include "planner/plan/plan_files/recovery_file.h"
#include "planner/uncertainty/preconditions/certify.h"
#include "planner/verify/certificate_algebra.h"
#include "planner/verify/certificate_check.h"
#include "planner/verify/resolution_check.h"

namespace assay::verify {
namespace {

using Json = nlohmann::ordered_json;
using plan::Certificate;
using plan::Flaw;
using plan::PlannedStep;

constexpr double kSameNumber = 1e-9;  // for numbers: absolute below 1, relative above
constexpr double kFarthest = 1e3;     // metres and radians, used where ranges are infinite
constexpr int kPoints = 32;           // number of points at which expressions are compared

bool AreClose(double a, double b) {
  return a == b ||
         std::abs(a - b) <= kSameNumber * std::max(1.0, std::min(std::abs(a), std::abs(b)));
}

// Compares two JSON trees of the same form.
class Comparison {
 public:
  void Compare(const std::string& at, const Json& given, const Json& anew) {
    if (given.is_number() && anew.is_number()) {
      if (!AreClose(given.get<double>(), anew.get<double>())) Add(at, given, anew);
    } else if (given.is_array() && anew.is_array() && given.size() == anew.size()) {
      for (std::size_t i = 0; i < given.size(); ++i) {
        Compare(fmt::format("{}[{}]", at, i), given[i], anew[i]);
      }
    } else if (given.is_object() && anew.is_object()) {
      CompareKeys(at, given, anew);
    } else if (given != anew) {
      Add(at, given, anew);
    }
  }

  void Add(const std::string& at, const Json& given, const Json& anew) {
    differences_.push_back(
        fmt::format("{}: {} in the file, {} computed anew", at, Shown(given), Shown(anew)));
  }

  std::vector<std::string> Take() { return std::move(differences_); }

 private:
  void CompareKeys(const std::string& at, const Json& given, const Json& anew) {
    for (const auto& [key, value] : anew.items()) {
      const auto found = given.find(key);
      Compare(fmt::format("{}.{}", at, key), found == given.end() ? Json() : *found, value);
    }
    for (const auto& [key, value] : given.items()) {
      if (!anew.contains(key)) Add(fmt::format("{}.{}", at, key), value, Json());
    }
  }

  static std::string Shown(const Json& value) {
    if (value.is_null()) return "nothing";
    return value.is_array() ? fmt::format("{} entries", value.size()) : value.dump();
  }

  std::vector<std::string> differences_;
};

// Returns points of the box that the variables span, by VariableId.
std::vector<std::vector<double>> PointsIn(const std::vector<Interval>& box) {
  RandomStream random(1, "points at which expressions are compared");
  std::vector<std::vector<double>> points(kPoints, std::vector<double>(box.size()));
  for (std::vector<double>& point : points) {
    for (std::size_t v = 0; v < box.size(); ++v) {
      point[v] = random.Uniform(std::clamp(box[v].low, -kFarthest, kFarthest),
                                std::clamp(box[v].high, -kFarthest, kFarthest));
    }
  }
  return points;
}

// Compares the functions in a step's certificate with those in the one computed anew, over the same
// variables.
class Functions {
 public:
  Functions(const PlannedStep& given, const PlannedStep& anew, const std::string& file)
      : given_(given, file), anew_(anew, file), points_(PointsIn(anew_.box().box)) {}

  bool AreSame(const std::string& given, const std::string& anew) const {
    const algebra::Expression a = given_.Read(given);
    const algebra::Expression b = anew_.Read(anew);
    return std::ranges::all_of(points_, [&](const std::vector<double>& point) {
      return AreClose(algebra::Evaluate(a, point), algebra::Evaluate(b, point));
    });
  }

 private:
  CertificateAlgebra given_;
  CertificateAlgebra anew_;
  std::vector<std::vector<double>> points_;
};

// Compares the certificate of one step with the one computed anew.
class CertificateComparison {
 public:
  CertificateComparison(const domain::Problem& problem, const PlannedStep& step,
                        const Certificate& anew, const std::string& file)
      : problem_(problem), step_(step), anew_(anew), file_(file) {}

  std::vector<std::string> Differences() {
    comparison_.Compare("certificate", WithoutExpressions(step_.certificate),
                        WithoutExpressions(anew_));
    const bool same_variables = step_.certificate.variables == anew_.variables;
    const bool same_number = step_.certificate.preconditions.size() == anew_.preconditions.size();
    if (same_variables && same_number) CompareExpressions();
    return comparison_.Take();
  }

 private:
  Json WithoutExpressions(Certificate certificate) const {
    certificate.shared.clear();
    certificate.resolutions.clear();
    for (plan::CertifiedPrecondition& claim : certificate.preconditions) claim.expression.clear();
    return plan::ToJson(certificate, problem_, {});
  }

  void CompareExpressions() {
    const auto text = &plan::CertifiedPrecondition::expression;
    if (step_.certificate.shared == anew_.shared &&
        std::ranges::equal(step_.certificate.preconditions, anew_.preconditions, {}, text, text)) {
      return;
    }
    PlannedStep anew = step_;
    anew.certificate = anew_;
    const Functions functions(step_, anew, file_);
    for (std::size_t i = 0; i < anew_.preconditions.size(); ++i) {
      const std::string& given = step_.certificate.preconditions[i].expression;
      const std::string& expected = anew_.preconditions[i].expression;
      if (functions.AreSame(given, expected)) continue;
      comparison_.Add(fmt::format("certificate.preconditions[{}].expression", i), given, expected);
    }
  }

  const domain::Problem& problem_;
  const PlannedStep& step_;
  const Certificate& anew_;
  const std::string& file_;
  Comparison comparison_;
};

Json VerificationsToJson(const plan::Plan& plan) {
  std::vector<std::string> names;
  for (const PlannedStep& step : plan.steps) names.push_back(step.name);
  Json json = {{"verifications", Json::array()}, {"recoveries", Json::array()}};
  for (const auto& check : plan.verifications) {
    json["verifications"].push_back(plan::ToJson(check, names));
  }
  for (const auto& recovery : plan.recoveries) {
    json["recoveries"].push_back(plan::ToJson(recovery, names));
  }
  return json;
}

// Returns the differences in the verifications that follow steps that are not proved.
std::vector<Flaw> DifferencesOfVerifications(const domain::Problem& problem,
                                             const plan::Plan& plan) {
  plan::Plan anew = plan;
  anew.verifications.clear();
  anew.recoveries.clear();
  for (const plan::StepId id : plan.ExecutionOrder()) {
    const PlannedStep& step = plan.step(id);
    if (IsUnproved(step)) {
      constraint_posting::AddVerification(problem, id, step.action, step.certificate, anew);
    }
  }
  Comparison comparison;
  comparison.Compare("plan", VerificationsToJson(plan), VerificationsToJson(anew));
  std::vector<Flaw> flaws;
  for (std::string& what : comparison.Take()) flaws.push_back({plan::StepId(), std::move(what)});
  return flaws;
}

// Returns the steps that make a mating about which nothing could be proved.
std::vector<Flaw> FlawsOfMatings(const domain::Problem& problem, const plan::Plan& plan) {
  std::vector<Flaw> flaws;
  for (std::size_t i = 0; i < plan.steps.size(); ++i) {
    const domain::MatingId mating = plan.steps[i].action.mating;
    if (mating.IsNone() || domain::HasShaftInHole(problem, problem.mating(mating))) continue;
    flaws.push_back({plan::StepId(i), "it puts no shaft into a hole that holds it all around"});
  }
  return flaws;
}

}  // namespace

std::vector<Flaw> DifferencesFromAnew(const domain::Problem& problem, const plan::Plan& plan,
                                      const std::string& file) {
  std::vector<Flaw> flaws = FlawsOfMatings(problem, plan);
  if (!flaws.empty()) return flaws;
  const uncertainty::Propagation propagation = plan::IsAsPublished(plan)
                                                   ? uncertainty::Propagation::kPaper
                                                   : uncertainty::Propagation::kSound;
  std::vector<Certificate> anew = uncertainty::CertificatesAnew(problem, plan, propagation, {});
  for (std::size_t i = 0; i < plan.steps.size(); ++i) {
    PlannedStep step = plan.steps[i];
    assembly::RemoveWayConditions(step.certificate);
    assembly::RemoveWayConditions(anew[i]);
    for (std::string& what : CertificateComparison(problem, step, anew[i], file).Differences()) {
      flaws.push_back({plan::StepId(i), std::move(what)});
    }
  }
  std::ranges::move(DifferencesOfVerifications(problem, plan), std::back_inserter(flaws));
  if (!flaws.empty()) return flaws;
  return FlawsOfResolutions(problem, plan, propagation);
}

}  // namespace assay::verify
