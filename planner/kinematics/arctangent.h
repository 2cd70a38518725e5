#pragma once

#include <numbers>

namespace assay::kinematics {

// Returns the angle of (x, y) in [-pi, pi], to within 5e-16 radians. x and y must not both be 0.
// `Real` is double, or one of GCC's vectors of doubles. Unlike std::atan2, the function has no
// branches and no tables.
//
// The direction is mirrored into [0, pi/4] and turned back by pi/16 or 3 pi/16, so that an angle of
// at most pi/16 remains. There, a Chebyshev fit of atan(t) / t as a polynomial in t^2 is exact to
// 2e-20.
template <typename Real>
[[gnu::always_inline]] inline Real Arctangent(const Real& y, const Real& x) {
  constexpr double kPi = std::numbers::pi;
  constexpr double kTangentEighth = 0.41421356237309503;  // tan(pi/8), where the two sectors meet
  constexpr double kCosine1 = 0.98078528040323043;        // cos(pi/16)
  constexpr double kSine1 = 0.19509032201612828;
  constexpr double kCosine3 = 0.83146961230254524;  // cos(3 pi/16)
  constexpr double kSine3 = 0.55557023301960222;
  const Real zero = x - x;
  const Real across = y < 0 ? -y : y;
  const Real along = x < 0 ? -x : x;
  const Real greater = across > along ? across : along;
  const Real lesser = across > along ? along : across;
  const auto outer = lesser > kTangentEighth * greater;
  const Real cosine = outer ? zero + kCosine3 : zero + kCosine1;
  const Real sine = outer ? zero + kSine3 : zero + kSine1;
  const Real t = (lesser * cosine - greater * sine) / (greater * cosine + lesser * sine);
  const Real z = t * t;
  Real fit = z * 0.050273062752334695 - 0.0660516727229625;
  fit = fit * z + 0.0768988435768423;
  fit = fit * z - 0.0909085307967067;
  fit = fit * z + 0.11111110348139375;
  fit = fit * z - 0.14285714279864764;
  fit = fit * z + 0.19999999999977505;
  fit = fit * z - 0.333333333333333;
  const Real sector = outer ? zero + 3 * kPi / 16 : zero + kPi / 16;
  const Real octant = sector + (t + t * z * fit);
  const Real quadrant = across > along ? kPi / 2 - octant : octant;
  const Real half = x < 0 ? kPi - quadrant : quadrant;
  return y < 0 ? -half : half;
}

}  // namespace assay::kinematics
