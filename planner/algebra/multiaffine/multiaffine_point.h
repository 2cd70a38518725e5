#pragma once

#include <vector>

#include "planner/algebra/multiaffine/multiaffine_derivatives.h"

namespace assay::algebra {

// A point at which a multi-affine form can be evaluated. Coordinates are indexed by the form's
// variables.
class MultiaffinePoint {
 public:
  explicit MultiaffinePoint(const MultiaffineForm& form)
      : form_(form), coordinates_(form.variables.size()), derivatives_(form) {}

  bool IsAngle(int variable) const { return variable < form_.angle_count; }
  const std::vector<double>& coordinates() const { return coordinates_; }
  MultiaffineDerivatives<double>& derivatives() { return derivatives_; }

  void Set(int variable, double x) { Set(variable, x, IsAngle(variable) ? PhasorAt(x) : Phasor()); }
  void Set(int variable, double x, const Phasor& phasor) {
    coordinates_[variable] = x;
    if (IsAngle(variable)) {
      derivatives_.SetAngle(variable, phasor.cosine, phasor.sine);
    } else {
      derivatives_.SetDisplacement(variable, x);
    }
  }
  void SetToLow(int variable, const Sector& sector) { Set(variable, sector.low, sector.at_low); }
  void SetToHigh(int variable, const Sector& sector) { Set(variable, sector.high, sector.at_high); }

 private:
  const MultiaffineForm& form_;
  std::vector<double> coordinates_;
  MultiaffineDerivatives<double> derivatives_;
};

}  // namespace assay::algebra
