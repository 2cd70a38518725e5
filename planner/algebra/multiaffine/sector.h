#pragma once

#include "planner/numeric/nearest_interval.h"

namespace assay::algebra {

// The cosine and sine of an angle.
struct Phasor {
  double cosine = 1;
  double sine = 0;
};
Phasor PhasorAt(double angle);

// The interval of a variable of a multi-affine form. For an angle it has the cosines and sines at
// both ends. They determine the range between the ends.
struct Sector {
  double low = 0;
  double high = 0;
  Phasor at_low, at_high;

  bool IsFree() const { return low < high; }
  double Width() const { return high - low; }
  void SetToLow() { high = low, at_high = at_low; }
  void SetToHigh() { low = high, at_low = at_high; }
};
Sector AngleBetween(double low, double high);

numeric::NearestInterval Cosines(const Sector& angle);
numeric::NearestInterval Sines(const Sector& angle);

}  // namespace assay::algebra
