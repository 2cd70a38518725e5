#include "sim/check/falsification/main_effects.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "planner/base/check.h"

namespace assay::check {
namespace {

// An error whose effect is below this share of the greatest effect is left at its low end.
constexpr double kNegligible = 1e-3;

struct Mean {
  double sum = 0;
  int count = 0;

  void Add(double value) {
    sum += value;
    ++count;
  }
  double value() const { return count == 0 ? 0 : sum / count; }
};

// Returns the main effect of an error, or 0 if the error was always at the same end.
double EffectOf(std::size_t error, std::span<const CornerResponse> responses) {
  Mean low;
  Mean high;
  for (const CornerResponse& response : responses) {
    ((*response.corner)[error] > 0 ? high : low).Add(response.observed);
  }
  return low.count == 0 || high.count == 0 ? 0 : high.value() - low.value();
}

double SumAt(const std::vector<double>& corner, const std::vector<double>& effects) {
  double sum = 0;
  for (std::size_t i = 0; i < effects.size(); ++i) sum += corner[i] * effects[i];
  return sum;
}

LikelyExtreme Toward(double sign, const std::vector<double>& effects,
                     const std::map<std::size_t, Mean>& left) {
  double greatest = 0;
  for (const double effect : effects) greatest = std::max(greatest, std::abs(effect));
  LikelyExtreme extreme;
  for (const double effect : effects) {
    extreme.corner.push_back(sign * effect > kNegligible * greatest ? 1 : 0);
  }
  const auto better = [&](const auto& a, const auto& b) {
    return sign * a.second.value() < sign * b.second.value();
  };
  const auto best = std::max_element(left.begin(), left.end(), better);
  extreme.start = best->first;
  extreme.expected = best->second.value() + SumAt(extreme.corner, effects);
  return extreme;
}

}  // namespace

LikelyExtremes ByMainEffects(std::span<const CornerResponse> responses) {
  ASSAY_CHECK(!responses.empty(), "no responses");
  std::vector<double> effects;
  for (std::size_t i = 0; i < responses.front().corner->size(); ++i) {
    effects.push_back(EffectOf(i, responses));
  }
  // For each start, the mean of what is left of the observed values after all effects of errors are
  // subtracted.
  std::map<std::size_t, Mean> left;
  for (const CornerResponse& response : responses) {
    left[response.start].Add(response.observed - SumAt(*response.corner, effects));
  }
  return {Toward(-1, effects, left), Toward(1, effects, left)};
}

}  // namespace assay::check
