#include "planner/algebra/multiaffine/multiaffine_part.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace assay::algebra {

namespace {

// Returns the centre c at which slope.high * (high - c), the greatest gain to the right of c,
// equals the greatest gain to the left of c (Baumann 1988).
double BestCentre(const Sector& x, const numeric::NearestInterval& slope) {
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

MultiaffinePart::MultiaffinePart(MultiaffineQuestion& question)
    : question_(question),
      slopes_(question.form.variables.size()),
      least_curvature_(slopes_.size()) {}

void MultiaffinePart::Begin(double upper_bound, std::vector<Sector> sectors) {
  sectors_ = std::move(sectors);
  upper_bound_ = upper_bound;
  method_ = BoundingMethod::kMonotone;
  polynomials_.Clear();
  number_ = -1;
  slack_ = 0;
}

void MultiaffinePart::Continue(const OpenParts::Part& part) {
  upper_bound_ = part.upper_bound;
  slack_ = part.slack;
  number_ = part.polynomial;
}

void MultiaffinePart::EnterSector(int variable) {
  const Sector& sector = sectors_[variable];
  if (question_.IsAngle(variable)) {
    question_.over_box.SetAngle(variable, Cosines(sector), Sines(sector));
  } else {
    question_.over_box.SetDisplacement(variable, {sector.low, sector.high});
  }
}

void MultiaffinePart::Lower(double upper_bound, BoundingMethod method) {
  if (!(upper_bound < upper_bound_)) return;
  upper_bound_ = upper_bound;
  method_ = method;
}

// Slopes are tighter over the smaller part, so the remaining variables are tried again.
void MultiaffinePart::Settle() {
  live_.clear();
  for (const int variable : question_.free) {
    EnterSector(variable);
    if (sectors_[variable].IsFree()) live_.push_back(variable);
  }
  bool is_smaller = true;
  while (is_smaller && !live_.empty()) {
    ++question_.evaluations;
    number_ < 0 ? EvaluateNested() : EvaluatePolynomial();
    is_smaller = std::erase_if(live_, [&](int variable) { return SettleBySlope(variable); }) > 0;
  }
}

void MultiaffinePart::EvaluateNested() {
  const numeric::NearestInterval range = question_.over_box.Value(question_.reduced);
  Lower(range.high + question_.error + slack_, BoundingMethod::kMonotone);
  question_.over_box.Differentiate(question_.reduced);
  for (const int variable : live_) {
    slopes_[variable] = question_.over_box.Slope(variable);
    if (question_.IsAngle(variable))
      least_curvature_[variable] = question_.over_box.Curvature(variable).low;
  }
}

void MultiaffinePart::EvaluatePolynomial() {
  const TrigonometricEvaluation& evaluation = polynomials_.Evaluate(number_, sectors_);
  Lower(evaluation.range().high + polynomials_.Error(number_) + slack_, BoundingMethod::kMonotone);
  int place = 0;
  for (const int angle : polynomials_.Angles(number_)) {
    slopes_[angle] = evaluation.Slope(place);
    least_curvature_[angle] = evaluation.LeastCurvature(place++);
  }
}

double MultiaffinePart::SlopeError(int variable) const {
  return number_ < 0 ? question_.slope_error[variable] : polynomials_.Error(number_);
}

bool MultiaffinePart::SettleBySlope(int variable) {
  const numeric::NearestInterval slope = slopes_[variable];
  const double error = SlopeError(variable);
  const bool rises = slope.low >= -error;
  const bool falls = slope.high <= error;
  if (!rises && !falls) return false;
  Sector& sector = sectors_[variable];
  const bool is_sure = slope.low >= error || slope.high <= -error;
  if (!is_sure) slack_ += 2 * error * sector.Width();
  rises ? sector.SetToHigh() : sector.SetToLow();
  EnterSector(variable);
  return true;
}

void MultiaffinePart::Examine() {
  if (live_.empty()) return LowerAtPoint();
  if (live_.size() == 1 && question_.IsAngle(live_[0])) return LowerByOneAngle();
  LowerByCentre();
  if (IsHopeless()) return;
  if (TurnToPolynomial()) {
    Settle();
    if (!IsHopeless()) Examine();
  } else if (number_ >= 0) {
    LowerByCurvature();
  }
}

// Turns the form into a trigonometric polynomial if only angles are free and it is not one yet.
bool MultiaffinePart::TurnToPolynomial() {
  const bool has_displacements =
      std::ranges::any_of(live_, [&](int variable) { return !question_.IsAngle(variable); });
  if (number_ >= 0 || has_displacements) return false;
  PutAtLow();
  question_.reduction.Reduce(question_.reduced, 1, question_.AtomsOf(live_),
                             question_.point.derivatives().atoms(), angles_only_);
  const int number =
      polynomials_.Add(angles_only_, question_.form, live_, question_.error, question_.angle_reach);
  if (number < 0) return false;
  slack_ += polynomials_.LeftOut(number);
  number_ = number;
  return true;
}

void MultiaffinePart::LowerAtPoint() {
  PutAtLow();
  const double value = question_.Value();
  Lower(value + question_.error + slack_, BoundingMethod::kMonotone);
  if (value > question_.attained) question_.Offer();
}

// A cos + B sin + C is largest at its summit, if that is in the sector, and at an end otherwise.
void MultiaffinePart::LowerByOneAngle() {
  const int angle = live_[0];
  const Sector& sector = sectors_[angle];
  PutAtLow();
  const double at_low = question_.Value();
  question_.point.derivatives().Differentiate(question_.reduced);
  const double a = question_.point.derivatives().SlopeByAtom(question_.form.AtomOf(angle));
  const double b = question_.point.derivatives().SlopeByAtom(question_.form.AtomOf(angle) + 1);
  const auto value_at = [&](const Phasor& phasor) {
    return at_low + a * (phasor.cosine - sector.at_low.cosine) +
           b * (phasor.sine - sector.at_low.sine);
  };
  double best = at_low;
  if (const double at_high = value_at(sector.at_high); at_high > best) {
    best = at_high;
    question_.point.SetToHigh(angle, sector);
  }
  if (const double summit = Summit(a, b, sector); summit <= sector.high) {
    const Phasor phasor = PhasorAt(summit);
    best = std::max(best, value_at(phasor));
    question_.point.Set(angle, summit, phasor);
  }
  Lower(best + 2 * question_.error + slack_,
        BoundingMethod::kCentred);  // errors of the value, and of a and b
  if (best > question_.attained) question_.Offer();
}

// Bounds the part by the form's value at a centre plus the greatest sum of slopes times distances
// from it.
void MultiaffinePart::LowerByCentre() {
  PutAtLow();
  double most = question_.error + slack_;
  for (const int variable : live_) {
    const numeric::NearestInterval slope = slopes_[variable];
    const Sector& sector = sectors_[variable];
    const double centre = BestCentre(sector, slope);
    question_.point.Set(variable, centre);
    most += std::max(slope.high * (sector.high - centre), slope.low * (sector.low - centre)) +
            SlopeError(variable) * sector.Width();
  }
  const double value = question_.Value();
  Lower(value + most, BoundingMethod::kCentred);
  if (value > question_.attained) question_.Climb(question_.free, question_.whole);
}

// Bounds the part by the form's value at the middle plus the greatest rise that its slopes there
// and the greatest curvature in the part allow (Taylor).
void MultiaffinePart::LowerByCurvature() {
  PutAtMiddle();
  const double value = question_.Value();
  question_.point.derivatives().Differentiate(question_.reduced);
  middle_slopes_.clear();
  double error = polynomials_.Error(number_) + slack_;
  for (const int angle : polynomials_.Angles(number_)) {
    if (!sectors_[angle].IsFree()) continue;
    middle_slopes_.push_back(question_.point.derivatives().Slope(angle));
    error += question_.error * sectors_[angle].Width();
  }
  const double rise = polynomials_.GreatestRise(number_, sectors_, middle_slopes_);
  Lower(value + rise + error, BoundingMethod::kCentred);
  if (!IsHopeless() && polynomials_.IsConcave()) LowerByConcavity();
}

// Bounds the part by the greatest value of the tangent plane at the summit. This plane is nowhere
// below a concave form.
void MultiaffinePart::LowerByConcavity() {
  question_.evaluations += question_.ascent.Climb(question_.reduced, live_, sectors_);
  Lower(TangentBound(), BoundingMethod::kCentred);
  question_.Offer();
}

double MultiaffinePart::TangentBound() {
  double bound = question_.Value() + question_.error + slack_;
  question_.point.derivatives().Differentiate(question_.reduced);
  for (const int angle : live_) {
    const double slope = question_.point.derivatives().Slope(angle);
    const double x = question_.point.coordinates()[angle];
    bound += slope > 0 ? slope * (sectors_[angle].high - x) : slope * (sectors_[angle].low - x);
    bound += question_.slope_error[angle] * sectors_[angle].Width();
  }
  return bound;
}

OpenParts::Part MultiaffinePart::Suspended() const {
  OpenParts::Part part = {.upper_bound = upper_bound_, .slack = slack_, .polynomial = number_};
  double largest = -1;  // the variable that varies the form most is split
  for (const int variable : live_) {
    const Sector& sector = sectors_[variable];
    const bool has_only_ends = HasOnlyItsEnds(variable);
    if (!has_only_ends && sector.Width() < kNarrowest * (1 + std::abs(sector.low))) continue;
    const numeric::NearestInterval slope = slopes_[variable];
    const double variation = std::max(-slope.low, slope.high) * sector.Width();
    if (variation <= largest) continue;
    largest = variation;
    part.split = variable;
    part.has_only_ends = has_only_ends;
  }
  return part;
}

// Returns whether the form has its greatest value at an end of the variable's interval. Every
// displacement has this property, because the form is affine in it. An angle has it if the form is
// convex in the angle for all values of the other variables.
bool MultiaffinePart::HasOnlyItsEnds(int variable) const {
  return !question_.IsAngle(variable) || least_curvature_[variable] >= SlopeError(variable);
}

void MultiaffinePart::PutAtLow() {
  for (const int variable : question_.free) question_.point.SetToLow(variable, sectors_[variable]);
}

void MultiaffinePart::PutAtMiddle() {
  PutAtLow();
  for (const int variable : live_) {
    question_.point.Set(variable, sectors_[variable].low + sectors_[variable].Width() / 2);
  }
}

}  // namespace assay::algebra
