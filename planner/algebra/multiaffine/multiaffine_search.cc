#include "planner/algebra/multiaffine/multiaffine_search.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "planner/algebra/numeric/interval_arithmetic.h"
#include "planner/base/check.h"

namespace assay::algebra {
namespace {

// Products of coordinates stay below kLargestProduct, so that anything lost by underflow is below
// kVanishing.
constexpr double kLargestProduct = 1e30;
constexpr double kVanishing = 1e-280;

double Size(const Interval& x) { return std::max(std::abs(x.low), std::abs(x.high)); }

// Returns the centre c at which slope.high * (high - c), the greatest gain on its right, equals the
// greatest gain on its left (Baumann 1988).
double BestCentre(const Sector& x, const NearestInterval& slope) {
  if (slope.low >= 0) return x.high;
  if (slope.high <= 0) return x.low;
  const double right = slope.high / (slope.high - slope.low);
  return std::clamp(right * x.high + (1 - right) * x.low, x.low, x.high);
}

// Returns the first angle at or above the sector's low end at which A cos + B sin is largest.
double Summit(double a, double b, const Sector& sector) {
  constexpr double kTurn = 2 * std::numbers::pi;
  const double summit = std::atan2(b, a);
  return std::max(sector.low, summit + kTurn * std::ceil((sector.low - summit) / kTurn));
}

}  // namespace

MultiaffineSearch::MultiaffineSearch(MultiaffineForm form)
    : form_(std::move(form)),
      over_box_(form_),
      point_(form_),
      ascent_(point_),
      box_(form_.variables.size()),
      slopes_(box_.size()),
      slope_error_(box_.size()),
      part_slopes_(box_.size()),
      least_curvature_(box_.size()) {}

bool MultiaffineSearch::Enter(std::span<const Interval> box) {
  double reach = 1;
  for (std::size_t i = 0; i < box_.size(); ++i) {
    const VariableId id = form_.variables[i].id;
    ASSAY_CHECK(id.index() < static_cast<int>(box.size()),
                "the box has no interval for variable {}", id.index());
    const Interval& x = box[id.index()];
    ASSAY_CHECK(x.low <= x.high, "bounds of variable {} are [{}, {}]", id.index(), x.low, x.high);
    reach *= std::max(1.0, Size(x));
    if (!(reach < kLargestProduct)) return false;
    const bool is_angle = IsAngle(static_cast<int>(i));
    box_[i] = is_angle ? AngleBetween(x.low, x.high) : Sector{x.low, x.high, {}, {}};
  }
  BoundErrors();
  part_ = box_;
  for (std::size_t i = 0; i < box_.size(); ++i) EnterSector(static_cast<int>(i));
  range_ = over_box_.Value(form_.nested);
  over_box_.Differentiate(form_.nested);
  for (std::size_t i = 0; i < box_.size(); ++i) slopes_[i] = over_box_.Slope(static_cast<int>(i));
  return true;
}

// Since sines and cosines of angles count as 1, a bound of the value's error also bounds the error
// of a derivative with respect to an angle.
void MultiaffineSearch::BoundErrors() {
  MultiaffineDerivatives<double>& magnitudes = point_.derivatives();
  for (std::size_t i = 0; i < box_.size(); ++i) {
    const int variable = static_cast<int>(i);
    if (!IsAngle(variable)) {
      magnitudes.SetDisplacement(variable, Size({box_[i].low, box_[i].high}));
    }
  }
  point_error_ = magnitudes.Value(form_.point_error) + kVanishing;
  error_ = magnitudes.Value(form_.error) + kVanishing;
  wave_reach_ = std::numbers::pi;
  for (int angle = 0; angle < form_.angle_count; ++angle) {
    wave_reach_ += Size({box_[angle].low, box_[angle].high});
  }
  magnitudes.Differentiate(form_.error);
  for (std::size_t i = 0; i < box_.size(); ++i) {
    const int variable = static_cast<int>(i);
    slope_error_[i] = IsAngle(variable) ? error_ : magnitudes.Slope(variable) + kVanishing;
  }
}

Bound MultiaffineSearch::Maximize(int sign, const BoundRequest& request,
                                  std::vector<double> elsewhere) {
  StopRule stop = {.gap = request.gap, .evaluations = request.evaluations};
  if (request.limit) stop.limit = sign * *request.limit;
  sign_ = sign;
  attained_ = -kInfinity;
  evaluations_ = 1;
  splits_ = 0;
  waves_count_ = 0;
  part_waves_ = -1;
  slack_ = 0;
  parts_.clear();
  sectors_.clear();
  unused_sectors_.clear();
  method_ = BoundingMethod::kMonotone;
  upper_bound_ = (sign > 0 ? range_.high : -range_.low) + error_;
  best_point_.clear();
  Climb(stop, request.highest);
  for (std::size_t i = 0; i < best_point_.size(); ++i) {
    elsewhere[form_.variables[i].id.index()] = best_point_[i];
  }
  return {.value = sign * upper_bound_,
          .method = method_,
          .gap = std::max(0.0, RoundedUp(upper_bound_ - attained_)),
          .at = attained_ > -kInfinity ? std::move(elsewhere) : std::vector<double>(),
          .evaluations = evaluations_,
          .splits = splits_};
}

// Settles variables by monotonicity and substitutes them in the form, until nothing changes.
void MultiaffineSearch::SettleWhole() {
  SettleBySlopesOfBox();
  while (!free_.empty()) {
    PutInSettled();
    Settle();
    if (live_.size() == free_.size()) return;
    PutAtLow();
    free_ = live_;
  }
}

// Settles variables by the slopes over the whole box, which Enter has computed.
void MultiaffineSearch::SettleBySlopesOfBox() {
  part_ = box_;
  free_.clear();
  for (std::size_t i = 0; i < part_.size(); ++i) {
    const int variable = static_cast<int>(i);
    const NearestInterval slope = sign_ > 0 ? slopes_[i] : -slopes_[i];
    if (slope.low >= slope_error_[i]) part_[i].SetToHigh();
    if (slope.high <= -slope_error_[i]) part_[i].SetToLow();
    if (part_[i].IsFree()) free_.push_back(variable);
    point_.SetToLow(variable, part_[i]);
  }
}

// Bounds the form after all variables are settled. If no product has two variables, bounding each
// product alone gives the same value.
void MultiaffineSearch::LowerAtCorner() {
  const double termwise = upper_bound_;
  const double corner = RoundedUp(Offer() + point_error_ + slack_);
  const bool is_termwise = form_.nested.node_count() == 1 && termwise <= corner + 4 * error_;
  upper_bound_ = std::min(upper_bound_, corner);
  method_ = is_termwise ? BoundingMethod::kTermwise : BoundingMethod::kMonotone;
}

void MultiaffineSearch::Climb(const StopRule& stop, BoundingMethod highest) {
  SettleWhole();
  whole_ = part_;
  if (free_.empty()) return LowerAtCorner();
  if (highest == BoundingMethod::kMonotone || stop.IsMet(upper_bound_, attained_)) {
    evaluations_ += ascent_.Climb(reduced_, free_, whole_);
    Offer();
    return;
  }
  Examine();
  if (highest == BoundingMethod::kCentred || stop.IsMet(upper_bound_, attained_)) return;
  const double upper_bound = upper_bound_;
  const BoundingMethod method = method_;
  Keep();
  upper_bound_ = Search(stop);
  method_ = upper_bound_ < upper_bound ? BoundingMethod::kBranchAndBound : method;
}

void MultiaffineSearch::PutInSettled() {
  reduction_.Reduce(form_.nested, sign_, AtomsOf(free_), point_.derivatives().atoms(), reduced_);
}

NestedForm::AtomSet MultiaffineSearch::AtomsOf(const std::vector<int>& variables) const {
  NestedForm::AtomSet atoms = 0;
  for (const int variable : variables) {
    const int atom = form_.AtomOf(variable);
    atoms |= NestedForm::SetOf(atom);
    if (IsAngle(variable)) atoms |= NestedForm::SetOf(atom + 1);
  }
  return atoms;
}

// ---- The current part ----

void MultiaffineSearch::EnterSector(int variable) {
  const Sector& sector = part_[variable];
  if (IsAngle(variable)) {
    over_box_.SetAngle(variable, Cosines(sector), Sines(sector));
  } else {
    over_box_.SetDisplacement(variable, {sector.low, sector.high});
  }
}

void MultiaffineSearch::Lower(double upper_bound, BoundingMethod method) {
  if (!(upper_bound < upper_bound_)) return;
  upper_bound_ = upper_bound;
  method_ = method;
}

// Sets variables to the end at which the form is largest if it does not fall on the way there.
// Slopes are tighter over the smaller part, so the remaining variables are tried again.
void MultiaffineSearch::Settle() {
  live_.clear();
  for (const int variable : free_) {
    EnterSector(variable);
    if (part_[variable].IsFree()) live_.push_back(variable);
  }
  bool is_smaller = true;
  while (is_smaller && !live_.empty()) {
    ++evaluations_;
    part_waves_ < 0 ? EvaluateNested() : EvaluateWaves();
    is_smaller = std::erase_if(live_, [&](int variable) { return SettleBySlope(variable); }) > 0;
  }
}

void MultiaffineSearch::EvaluateNested() {
  const NearestInterval range = over_box_.Value(reduced_);
  Lower(range.high + error_ + slack_, BoundingMethod::kMonotone);
  over_box_.Differentiate(reduced_);
  for (const int variable : live_) {
    part_slopes_[variable] = over_box_.Slope(variable);
    if (IsAngle(variable)) least_curvature_[variable] = over_box_.Curvature(variable).low;
  }
}

void MultiaffineSearch::EvaluateWaves() {
  const Waves& waves = waves_[part_waves_];
  wave_box_.clear();
  for (const int angle : waves.angles) wave_box_.emplace_back(part_[angle].low, part_[angle].high);
  wave_evaluation_.Enter(waves.sum, wave_box_);
  Lower(wave_evaluation_.range().high + waves.error + slack_, BoundingMethod::kMonotone);
  for (std::size_t i = 0; i < waves.angles.size(); ++i) {
    part_slopes_[waves.angles[i]] = wave_evaluation_.Slope(static_cast<int>(i));
    least_curvature_[waves.angles[i]] = wave_evaluation_.LeastCurvature(static_cast<int>(i));
  }
}

double MultiaffineSearch::SlopeError(int variable) const {
  return part_waves_ < 0 ? slope_error_[variable] : waves_[part_waves_].error;
}

bool MultiaffineSearch::SettleBySlope(int variable) {
  const NearestInterval slope = part_slopes_[variable];
  const double error = SlopeError(variable);
  const bool rises = slope.low >= -error;
  const bool falls = slope.high <= error;
  if (!rises && !falls) return false;
  Sector& sector = part_[variable];
  const bool is_sure = slope.low >= error || slope.high <= -error;
  if (!is_sure) slack_ += 2 * error * sector.Width();
  rises ? sector.SetToHigh() : sector.SetToLow();
  EnterSector(variable);
  return true;
}

// Bounds the part. Call Settle first.
void MultiaffineSearch::Examine() {
  if (live_.empty()) return LowerAtPoint();
  if (live_.size() == 1 && IsAngle(live_[0])) return LowerByOneAngle();
  LowerByCentre();
  if (IsHopeless()) return;
  if (TurnToWaves()) {
    Settle();
    if (!IsHopeless()) Examine();
  } else if (part_waves_ >= 0) {
    LowerByCurvature();
  }
}

// Turns the form into a trigonometric polynomial if only angles are free and it is not one yet.
bool MultiaffineSearch::TurnToWaves() {
  const bool has_displacements =
      std::ranges::any_of(live_, [&](int variable) { return !IsAngle(variable); });
  if (part_waves_ >= 0 || has_displacements) return false;
  if (waves_count_ == static_cast<int>(waves_.size())) waves_.emplace_back();
  Waves& waves = waves_[waves_count_];
  waves.angles = live_;
  cosines_.clear();
  for (const int angle : live_) cosines_.push_back(form_.AtomOf(angle));
  PutAtLow();
  reduction_.Reduce(reduced_, 1, AtomsOf(live_), point_.derivatives().atoms(), angles_only_);
  if (!waves.sum.Assign(angles_only_, cosines_)) return false;
  // error_ covers at least 64 roundings. The factors cover the rounding of the cosines' arguments
  // and the addition of the terms.
  waves.error = error_ * wave_reach_ * (1 + waves.sum.wave_count() / 64.0);
  slack_ += waves.sum.left_out();
  part_waves_ = waves_count_++;
  return true;
}

void MultiaffineSearch::LowerAtPoint() {
  PutAtLow();
  const double value = Value();
  Lower(value + error_ + slack_, BoundingMethod::kMonotone);
  if (value > attained_) Offer();
}

// A cos + B sin + C is largest at its summit, if that is in the sector, and at an end otherwise.
void MultiaffineSearch::LowerByOneAngle() {
  const int angle = live_[0];
  const Sector& sector = part_[angle];
  PutAtLow();
  const double at_low = Value();
  point_.derivatives().Differentiate(reduced_);
  const double a = point_.derivatives().SlopeByAtom(form_.AtomOf(angle));
  const double b = point_.derivatives().SlopeByAtom(form_.AtomOf(angle) + 1);
  const auto value_at = [&](const Wave& wave) {
    return at_low + a * (wave.cosine - sector.at_low.cosine) + b * (wave.sine - sector.at_low.sine);
  };
  double best = at_low;
  if (const double at_high = value_at(sector.at_high); at_high > best) {
    best = at_high;
    point_.SetToHigh(angle, sector);
  }
  if (const double summit = Summit(a, b, sector); summit <= sector.high) {
    const Wave wave = WaveAt(summit);
    best = std::max(best, value_at(wave));
    point_.Set(angle, summit, wave);
  }
  Lower(best + 2 * error_ + slack_,
        BoundingMethod::kCentred);  // errors of the value, and of a and b
  if (best > attained_) Offer();
}

// Bounds the part by the form's value at a centre plus the greatest sum of slopes times distances
// from it.
void MultiaffineSearch::LowerByCentre() {
  PutAtLow();
  double most = error_ + slack_;
  for (const int variable : live_) {
    const NearestInterval slope = part_slopes_[variable];
    const Sector& sector = part_[variable];
    const double centre = BestCentre(sector, slope);
    point_.Set(variable, centre);
    most += std::max(slope.high * (sector.high - centre), slope.low * (sector.low - centre)) +
            SlopeError(variable) * sector.Width();
  }
  const double value = Value();
  Lower(value + most, BoundingMethod::kCentred);
  if (value > attained_) {
    evaluations_ += ascent_.Climb(reduced_, free_, whole_);
    Offer();
  }
}

// Bounds the part by the form's value at the middle plus the greatest rise that its slopes there
// and the greatest curvature in the part allow (Taylor).
void MultiaffineSearch::LowerByCurvature() {
  PutAtMiddle();
  const double value = Value();
  point_.derivatives().Differentiate(reduced_);
  const Waves& waves = waves_[part_waves_];
  widths_.clear();
  middle_slopes_.clear();
  live_places_.clear();
  double error = waves.error + slack_;
  for (std::size_t i = 0; i < waves.angles.size(); ++i) {
    const int angle = waves.angles[i];
    if (!part_[angle].IsFree()) continue;
    live_places_.push_back(static_cast<int>(i));
    widths_.push_back(part_[angle].Width());
    middle_slopes_.push_back(point_.derivatives().Slope(angle));
    error += error_ * part_[angle].Width();
  }
  wave_evaluation_.greatest_curvature().CopyTo(curvature_, live_places_);
  quadratic_bound_.SetCurvature(curvature_, waves.error, widths_);
  Lower(value + quadratic_bound_.Most(middle_slopes_) + error, BoundingMethod::kCentred);
  if (!IsHopeless() && quadratic_bound_.IsConcave()) LowerByConcavity();
}

// Bounds the part by the greatest value of the tangent plane at the summit. This plane is nowhere
// below a concave form.
void MultiaffineSearch::LowerByConcavity() {
  evaluations_ += ascent_.Climb(reduced_, live_, part_);
  Lower(TangentBound(), BoundingMethod::kCentred);
  Offer();
}

double MultiaffineSearch::TangentBound() {
  double bound = Value() + error_ + slack_;
  point_.derivatives().Differentiate(reduced_);
  for (const int angle : live_) {
    const double slope = point_.derivatives().Slope(angle);
    const double x = point_.coordinates()[angle];
    bound += slope > 0 ? slope * (part_[angle].high - x) : slope * (part_[angle].low - x);
    bound += slope_error_[angle] * part_[angle].Width();
  }
  return bound;
}

// ---- The parts ----

double MultiaffineSearch::Search(const StopRule& stop) {
  while (!parts_.empty()) {
    const Part part = parts_.front();
    const bool is_done = part.split < 0 || stop.IsMet(part.upper_bound, attained_) ||
                         evaluations_ >= stop.evaluations;
    if (is_done) return std::max(part.upper_bound, attained_);
    std::pop_heap(parts_.begin(), parts_.end());
    parts_.pop_back();
    Split(part);
  }
  return attained_;
}

void MultiaffineSearch::Split(const Part& part) {
  ++splits_;
  const int place = static_cast<int>(std::ranges::find(free_, part.split) - free_.begin());
  Sector lower = sectors_[part.sectors + place];
  Sector upper = lower;
  if (part.has_only_ends) {
    lower.SetToLow();
    upper.SetToHigh();
  } else {
    lower.high = upper.low = lower.low + lower.Width() / 2;
    lower.at_high = upper.at_low = WaveAt(lower.high);
  }
  Open(part, lower);
  Open(part, upper);
  unused_sectors_.push_back(part.sectors);
}

// Examines the part in which `half` replaces the split variable's sector.
void MultiaffineSearch::Open(const Part& part, const Sector& half) {
  for (std::size_t i = 0; i < free_.size(); ++i) part_[free_[i]] = sectors_[part.sectors + i];
  part_[part.split] = half;
  upper_bound_ = part.upper_bound;
  slack_ = part.slack;
  part_waves_ = part.waves;
  Settle();
  if (IsHopeless()) return;
  Examine();
  if (!IsHopeless()) Keep();
}

void MultiaffineSearch::Keep() {
  Part part = {.upper_bound = upper_bound_, .age = ++age_, .slack = slack_, .waves = part_waves_};
  ChooseSplit(part);
  part.sectors = RoomForSectors();
  for (std::size_t i = 0; i < free_.size(); ++i) sectors_[part.sectors + i] = part_[free_[i]];
  parts_.push_back(part);
  std::push_heap(parts_.begin(), parts_.end());
}

int MultiaffineSearch::RoomForSectors() {
  if (unused_sectors_.empty()) {
    sectors_.resize(sectors_.size() + free_.size());
    return static_cast<int>(sectors_.size() - free_.size());
  }
  const int room = unused_sectors_.back();
  unused_sectors_.pop_back();
  return room;
}

// Chooses the variable that varies the form most.
void MultiaffineSearch::ChooseSplit(Part& part) const {
  double largest = -1;
  for (const int variable : live_) {
    const Sector& sector = part_[variable];
    const bool has_only_ends = HasOnlyItsEnds(variable);
    if (!has_only_ends && sector.Width() < kNarrowest * (1 + std::abs(sector.low))) continue;
    const NearestInterval slope = part_slopes_[variable];
    const double variation = std::max(-slope.low, slope.high) * sector.Width();
    if (variation <= largest) continue;
    largest = variation;
    part.split = variable;
    part.has_only_ends = has_only_ends;
  }
}

// Returns whether the form has its greatest value at an end of the variable's interval. Every
// displacement has this property, because the form is affine in it. An angle has it if the form is
// convex in the angle for all values of the other variables.
bool MultiaffineSearch::HasOnlyItsEnds(int variable) const {
  return !IsAngle(variable) || least_curvature_[variable] >= SlopeError(variable);
}

// ---- The point ----

void MultiaffineSearch::PutAtLow() {
  for (const int variable : free_) point_.SetToLow(variable, part_[variable]);
}

void MultiaffineSearch::PutAtMiddle() {
  PutAtLow();
  for (const int variable : live_) {
    point_.Set(variable, part_[variable].low + part_[variable].Width() / 2);
  }
}

double MultiaffineSearch::Value() {
  ++evaluations_;
  return point_.derivatives().Value(reduced_);
}

// Keeps the point if the given form surely attains more there than at the best point so far.
// Returns the form's value at the point.
double MultiaffineSearch::Offer() {
  ++evaluations_;
  const double value = sign_ * point_.derivatives().Value(form_.nested);
  const double attained = RoundedDown(value - point_error_);
  if (attained > attained_) {
    attained_ = attained;
    best_point_ = point_.coordinates();
  }
  return value;
}

}  // namespace assay::algebra
