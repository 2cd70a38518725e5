#include "planner/algebra/bounds/branch_and_bound.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <queue>
#include <utility>

#include "planner/algebra/bounding_methods/centred.h"
#include "planner/algebra/bounding_methods/monotone.h"
#include "planner/algebra/bounds/ascent.h"
#include "planner/algebra/bounds/feasible_ascent.h"
#include "planner/base/stop.h"
#include "planner/numeric/interval_arithmetic.h"

namespace assay::algebra {
namespace {

constexpr double kFarthestSplit = 1e100;  // infinite intervals are not split beyond it

// A part of the box in which the form may exceed the best point so far.
struct Part {
  Box box;
  double upper_bound = kInfinity;
  int split = -1;        // a variable, or -1 if none can be split further
  std::int64_t age = 0;  // breaks ties: of parts with the same bound the oldest comes first
};

struct IsLessPromising {
  bool operator()(const Part& a, const Part& b) const {
    if (a.upper_bound != b.upper_bound) return a.upper_bound < b.upper_bound;
    return a.age > b.age;
  }
};

bool IsFree(const Interval& interval) { return interval.low < interval.high; }

// Returns a point inside the interval at which to split it. Returns nothing if the interval is too
// narrow or too far from zero.
std::optional<double> SplitPoint(const Interval& x) {
  const bool is_infinite = std::isinf(x.low) || std::isinf(x.high);
  if (!is_infinite) {
    const double scale = 1 + std::max(std::abs(x.low), std::abs(x.high));
    const double middle = x.low + (x.high - x.low) / 2;
    const bool is_inside = x.low < middle && middle < x.high;
    if (!is_inside || x.high - x.low < kNarrowest * scale) return std::nullopt;
    return middle;
  }
  if (std::isinf(x.low) && std::isinf(x.high)) return 0;
  const double end = std::isinf(x.low) ? x.high : x.low;
  if (std::abs(end) > kFarthestSplit) return std::nullopt;
  const double step = 1 + 9 * std::abs(end);
  return std::isinf(x.low) ? end - step : end + step;
}

class Search {
 public:
  Search(Probe& probe, const StopRule& stop)
      : probe_(probe), problem_(probe.problem()), stop_(stop) {}

  double Run(double upper_bound) {
    Add(problem_.box, upper_bound);
    while (!parts_.empty()) {
      StopIfRequested();
      const double top = parts_.top().upper_bound;
      if (parts_.top().split < 0 || stop_.IsMet(top, probe_.best_value()) ||
          probe_.evaluations() >= stop_.evaluations) {
        return std::max(top, probe_.best_value());
      }
      const Part part = parts_.top();
      parts_.pop();
      Split(part);
    }
    return probe_.best_value();
  }

 private:
  // A form that is affine in a variable is largest at one of the variable's two ends, for any
  // values of the others. Places between the ends need no search, unless an inequality may forbid
  // an end.
  bool HasOnlyItsEnds(int variable) const {
    const Interval& x = problem_.box[variable];
    return problem_.objective.affine[variable] && !problem_.constrained[variable] &&
           std::isfinite(x.low) && std::isfinite(x.high);
  }

  void Split(const Part& part) {
    probe_.CountSplit();
    const Interval x = part.box[part.split];
    Interval lower = {x.low, x.low};
    Interval upper = {x.high, x.high};
    if (!HasOnlyItsEnds(part.split)) lower.high = upper.low = *SplitPoint(x);
    for (const Interval& half : {lower, upper}) {
      Box box = part.box;
      box[part.split] = half;
      Add(std::move(box), part.upper_bound);
    }
  }

  // Bounds a part, and keeps it if the form may exceed the best point there.
  void Add(Box box, double upper_bound) {
    if (probe_.SurelyInfeasible(box)) return;
    MonotoneBox part = SetMonotoneVariables(probe_, std::move(box), problem_.constrained);
    if (!probe_.over_box().DefinedSomewhere()) return;
    const bool is_defined = probe_.over_box().DefinedEverywhere();
    Lower(upper_bound, part.range.high);
    Improve(part.box);
    if (upper_bound <= probe_.best_value()) return;
    if (is_defined) LowerByDerivatives(upper_bound, part);
    if (upper_bound <= probe_.best_value()) return;
    const int split = SplitVariable(part);
    parts_.push({std::move(part.box), upper_bound, split, ++age_});
  }

  // Ignores NaN, which comes from infinite intermediate results.
  static void Lower(double& upper_bound, double other) {
    if (other < upper_bound) upper_bound = other;
  }

  void LowerByDerivatives(double& upper_bound, const MonotoneBox& part) {
    // Variables of inequalities keep their intervals in the part, so that the inequalities can be
    // tested over it. If only the form is bounded, these variables may be set as if there were no
    // inequality.
    const MonotoneBox relaxed =
        problem_.slacks.empty() ? part : SetMonotoneVariables(probe_, part.box);
    Lower(upper_bound, relaxed.range.high);
    Lower(upper_bound, UpperBoundByDerivatives(probe_, relaxed.box, relaxed.gradient));
  }

  // Looks for a better feasible point if the middle of the part promises one.
  void Improve(const Box& box) {
    std::vector<double> middle = CentreOf(box);
    const double value = probe_.Value(middle);
    if (!(value > probe_.best_value())) return;
    if (problem_.slacks.empty()) {
      probe_.Offer(AscendFrom(std::move(middle), probe_, problem_.box));
    } else if (probe_.Offer(middle)) {
      probe_.Offer(AscendFeasibly(std::move(middle), probe_));
    }
  }

  // Returns the variable that varies the form most: the one with the largest product of derivative
  // and width. If several products are infinite, the variable with the widest interval is taken.
  int SplitVariable(const MonotoneBox& part) const {
    int best = -1;
    std::pair<double, double> largest = {-1, -1};
    for (std::size_t i = 0; i < part.box.size(); ++i) {
      const int variable = static_cast<int>(i);
      const Interval& x = part.box[i];
      if (!IsFree(x) || (!HasOnlyItsEnds(variable) && !SplitPoint(x))) continue;
      const double steepest = std::max(-part.gradient[i].low, part.gradient[i].high);
      const double width = x.high - x.low;
      const double variation = steepest > 0 ? steepest * width : 0;
      const std::pair<double, double> smear = {variation, width};
      if (smear > largest && (variation > 0 || problem_.constrained[i])) {
        best = variable;
        largest = smear;
      }
    }
    return best;
  }

  Probe& probe_;
  const Maximization& problem_;
  const StopRule& stop_;
  std::priority_queue<Part, std::vector<Part>, IsLessPromising> parts_;
  std::int64_t age_ = 0;
};

}  // namespace

bool StopRule::IsMet(double upper_bound, double best_value) const {
  return upper_bound - best_value <= gap || upper_bound < limit || best_value >= limit;
}

double BranchAndBound(Probe& probe, double upper_bound, const StopRule& stop) {
  return Search(probe, stop).Run(upper_bound);
}

}  // namespace assay::algebra
