#include "planner/algebra/multiaffine/multiaffine_ascent.h"

#include <algorithm>
#include <cmath>

#include "planner/algebra/bounds/ascent.h"

namespace assay::algebra {
namespace {

constexpr int kMostSteps = 40;
constexpr double kMostDamping = 1e6;

}  // namespace

int MultiaffineAscent::Climb(const NestedForm& form, std::span<const int> variables,
                             std::span<const Sector> sectors) {
  form_ = &form;
  variables_ = variables;
  sectors_ = sectors;
  evaluations_ = 0;
  value_ = Value();
  for (int step = 0; step < kMostSteps && Improve(); ++step) {
  }
  return evaluations_;
}

double MultiaffineAscent::Value() {
  ++evaluations_;
  return point_.derivatives().Value(*form_);
}

bool MultiaffineAscent::Improve() {
  point_.derivatives().Differentiate(*form_);
  start_ = point_.coordinates();
  return ImproveByEnds() || ImproveByNewton();
}

// Keeps the step if the value grows, and undoes it otherwise.
bool MultiaffineAscent::KeepIfBetter() {
  const double value = Value();
  if (value > value_ + kNegligible * std::abs(value_)) {
    value_ = value;
    return true;
  }
  for (const int variable : variables_) {
    if (point_.coordinates()[variable] != start_[variable]) point_.Set(variable, start_[variable]);
  }
  return false;
}

bool MultiaffineAscent::ImproveByEnds() {
  bool moved = false;
  for (const int variable : variables_) {
    if (point_.IsAngle(variable)) continue;
    const double slope = point_.derivatives().Slope(variable);
    const Sector& sector = sectors_[variable];
    const double end = slope > 0 ? sector.high : sector.low;
    if (slope == 0 || point_.coordinates()[variable] == end) continue;
    point_.Set(variable, end);
    moved = true;
  }
  if (!moved) return false;
  if (KeepIfBetter()) return true;
  Value();  // evaluates again at the restored point
  point_.derivatives().Differentiate(*form_);
  return false;
}

void MultiaffineAscent::FindMovableAngles() {
  movable_.clear();
  slope_.clear();
  for (const int variable : variables_) {
    if (!point_.IsAngle(variable)) continue;
    const double slope = point_.derivatives().Slope(variable);
    const double x = point_.coordinates()[variable];
    const Sector& sector = sectors_[variable];
    if ((slope > 0 && x < sector.high) || (slope < 0 && x > sector.low)) {
      movable_.push_back(variable);
      slope_.push_back(slope);
    }
  }
}

void MultiaffineAscent::FindCurvature() {
  const int n = static_cast<int>(movable_.size());
  curvature_.Reset(n);
  for (int i = 0; i < n; ++i) {
    curvature_(i, i) = -point_.derivatives().Curvature(movable_[i]);
    if (i == 0) continue;
    ++evaluations_;
    point_.derivatives().DifferentiateSlopes(*form_, movable_[i]);
    for (int j = 0; j < i; ++j) {
      curvature_(i, j) = -point_.derivatives().MixedCurvature(movable_[j]);
    }
  }
}

bool MultiaffineAscent::ImproveByNewton() {
  FindMovableAngles();
  double steepest = 0;
  for (const double slope : slope_) steepest = std::max(steepest, std::abs(slope));
  if (!(steepest > kNegligible * (1 + std::abs(value_)))) return false;
  FindCurvature();
  for (double damping = 0; damping <= kMostDamping; damping = std::max(damping * 8, 1e-3)) {
    damped_ = curvature_;
    for (int i = 0; i < damped_.size(); ++i) damped_(i, i) += damping * steepest;
    if (!FactorPositiveDefinite(damped_)) continue;
    step_ = slope_;
    SolveFactored(damped_, step_);
    MoveBy(step_);
    if (IsLast()) {
      value_ = Value();
      return false;
    }
    if (KeepIfBetter()) return true;
  }
  return false;
}

// Returns true if the step gains too little to be visible in the value. The step is taken
// nevertheless, because it brings the slopes nearer to zero than the value can show.
bool MultiaffineAscent::IsLast() const {
  double gain = 0;
  for (std::size_t i = 0; i < step_.size(); ++i) gain += step_[i] * slope_[i] / 2;
  return gain < kInvisible * (1 + std::abs(value_));
}

void MultiaffineAscent::MoveBy(std::span<const double> step) {
  for (std::size_t i = 0; i < movable_.size(); ++i) {
    const int variable = movable_[i];
    const Sector& sector = sectors_[variable];
    const double x = std::clamp(start_[variable] + step[i], sector.low, sector.high);
    if (x == sector.low) {
      point_.SetToLow(variable, sector);
    } else if (x == sector.high) {
      point_.SetToHigh(variable, sector);
    } else {
      point_.Set(variable, x);
    }
  }
}

}  // namespace assay::algebra
