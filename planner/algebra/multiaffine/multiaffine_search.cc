#include "planner/algebra/multiaffine/multiaffine_search.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "planner/base/check.h"
#include "planner/numeric/interval_arithmetic.h"

namespace assay::algebra {
namespace {

// Products of coordinates stay below this, so that what is lost by underflow is negligible.
constexpr double kLargestProduct = 1e30;

}  // namespace

MultiaffineSearch::MultiaffineSearch(MultiaffineForm form)
    : question_(std::move(form)),
      part_(question_),
      box_(question_.form.variables.size()),
      slopes_(box_.size()) {}

bool MultiaffineSearch::Enter(std::span<const Interval> box) {
  double reach = 1;
  for (std::size_t i = 0; i < box_.size(); ++i) {
    const VariableId id = question_.form.variables[i].id;
    ASSAY_CHECK(id.index() < static_cast<int>(box.size()),
                "the box has no interval for variable {}", id.index());
    const Interval& x = box[id.index()];
    ASSAY_CHECK(x.low <= x.high, "bounds of variable {} are [{}, {}]", id.index(), x.low, x.high);
    reach *= std::max({1.0, std::abs(x.low), std::abs(x.high)});
    if (!(reach < kLargestProduct)) return false;
    const bool is_angle = question_.IsAngle(static_cast<int>(i));
    box_[i] = is_angle ? AngleBetween(x.low, x.high) : Sector{x.low, x.high, {}, {}};
  }
  question_.BoundErrors(box_);
  part_.sectors() = box_;
  for (std::size_t i = 0; i < box_.size(); ++i) part_.EnterSector(static_cast<int>(i));
  range_ = question_.over_box.Value(question_.form.nested);
  question_.over_box.Differentiate(question_.form.nested);
  for (std::size_t i = 0; i < box_.size(); ++i)
    slopes_[i] = question_.over_box.Slope(static_cast<int>(i));
  return true;
}

Bound MultiaffineSearch::Maximize(int sign, const BoundRequest& request,
                                  std::vector<double> elsewhere) {
  StopRule stop = {.gap = request.gap, .evaluations = request.evaluations};
  if (request.limit) stop.limit = sign * *request.limit;
  splits_ = 0;
  parts_.Clear();
  question_.Begin(sign);
  part_.Begin((sign > 0 ? range_.high : -range_.low) + question_.error, box_);
  const auto [upper_bound, method] = Climb(stop, request.highest);
  for (std::size_t i = 0; i < question_.best_point.size(); ++i) {
    elsewhere[question_.form.variables[i].id.index()] = question_.best_point[i];
  }
  return {.value = sign * upper_bound,
          .method = method,
          .gap = std::max(0.0, RoundedUp(upper_bound - question_.attained)),
          .at = question_.attained > -kInfinity ? std::move(elsewhere) : std::vector<double>(),
          .evaluations = question_.evaluations,
          .splits = splits_};
}

// Settles variables by monotonicity and substitutes them in the form, until nothing changes.
void MultiaffineSearch::SettleWhole() {
  SettleBySlopesOfBox();
  while (!question_.free.empty()) {
    question_.PutInSettled();
    part_.Settle();
    if (part_.live().size() == question_.free.size()) return;
    part_.PutAtLow();
    question_.free = part_.live();
  }
}

// Settles variables by the slopes over the whole box, which Enter has computed.
void MultiaffineSearch::SettleBySlopesOfBox() {
  question_.free.clear();
  for (std::size_t i = 0; i < box_.size(); ++i) {
    const int variable = static_cast<int>(i);
    Sector& sector = part_.sectors()[i];
    const numeric::NearestInterval slope = question_.sign > 0 ? slopes_[i] : -slopes_[i];
    if (slope.low >= question_.slope_error[i]) sector.SetToHigh();
    if (slope.high <= -question_.slope_error[i]) sector.SetToLow();
    if (sector.IsFree()) question_.free.push_back(variable);
    question_.point.SetToLow(variable, sector);
  }
}

// Bounds the form after all variables are settled. If no product has two variables, bounding each
// product alone gives the same value.
MultiaffineSearch::UpperBound MultiaffineSearch::BoundAtCorner() {
  const double termwise = part_.upper_bound();
  const double corner = RoundedUp(question_.Offer() + question_.point_error + part_.slack());
  const bool is_termwise =
      question_.form.nested.node_count() == 1 && termwise <= corner + 4 * question_.error;
  return {std::min(termwise, corner),
          is_termwise ? BoundingMethod::kTermwise : BoundingMethod::kMonotone};
}

MultiaffineSearch::UpperBound MultiaffineSearch::Climb(const StopRule& stop,
                                                       BoundingMethod highest) {
  const auto is_met = [&] { return stop.IsMet(part_.upper_bound(), question_.attained); };
  SettleWhole();
  question_.whole = part_.sectors();
  if (question_.free.empty()) return BoundAtCorner();
  if (highest == BoundingMethod::kMonotone || is_met()) {
    question_.Climb(question_.free, question_.whole);
    return {part_.upper_bound(), part_.method()};
  }
  part_.Examine();
  const UpperBound examined = {part_.upper_bound(), part_.method()};
  if (highest == BoundingMethod::kCentred || is_met()) return examined;
  Keep();
  const double found = Search(stop);
  return {found, found < examined.value ? BoundingMethod::kBranchAndBound : examined.method};
}

double MultiaffineSearch::Search(const StopRule& stop) {
  while (!parts_.IsEmpty()) {
    const OpenParts::Part& best = parts_.Best();
    const bool is_done = best.split < 0 || stop.IsMet(best.upper_bound, question_.attained) ||
                         question_.evaluations >= stop.evaluations;
    if (is_done) return std::max(best.upper_bound, question_.attained);
    Split(parts_.Take());
  }
  return question_.attained;
}

void MultiaffineSearch::Split(const OpenParts::Part& part) {
  ++splits_;
  const auto place = std::ranges::find(question_.free, part.split) - question_.free.begin();
  Sector lower = parts_.SectorOf(part, static_cast<std::size_t>(place));
  Sector upper = lower;
  if (part.has_only_ends) {
    lower.SetToLow();
    upper.SetToHigh();
  } else {
    lower.high = upper.low = lower.low + lower.Width() / 2;
    lower.at_high = upper.at_low = PhasorAt(lower.high);
  }
  Open(part, lower);
  Open(part, upper);
  parts_.Forget(part);
}

// Examines the part in which `half` replaces the split variable's sector.
void MultiaffineSearch::Open(const OpenParts::Part& part, const Sector& half) {
  for (std::size_t i = 0; i < question_.free.size(); ++i) {
    part_.sectors()[question_.free[i]] = parts_.SectorOf(part, i);
  }
  part_.sectors()[part.split] = half;
  part_.Continue(part);
  part_.Settle();
  if (part_.IsHopeless()) return;
  part_.Examine();
  if (!part_.IsHopeless()) Keep();
}

void MultiaffineSearch::Keep() {
  const std::span<Sector> sectors = parts_.Add(part_.Suspended(), question_.free.size());
  for (std::size_t i = 0; i < question_.free.size(); ++i) {
    sectors[i] = part_.sectors()[question_.free[i]];
  }
}

}  // namespace assay::algebra
