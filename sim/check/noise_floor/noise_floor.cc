#include "sim/check/noise_floor/noise_floor.h"

#include <algorithm>
#include <cmath>

namespace assay::check {
namespace {

using domain::Dimension;

constexpr double kRounding = 1e-9;  // metres or radians, after products of dozens of poses

const ClaimNoiseFloor* Find(Claimed about, const std::string& name, const StepNoiseFloor& gate) {
  const auto same = std::ranges::find_if(gate.components, [&](const ClaimNoiseFloor& component) {
    return component.about == about && component.name == name;
  });
  return same == gate.components.end() ? nullptr : &*same;
}

// Returns by how much the fixed part of a mating moved without noise, at most kMostCreep. A
// certificate says that the fixed part stays. The engine's contacts yield a little along a face on
// which friction holds a part.
double CreepOf(const Claim& claim, const StepNoiseFloor& gate) {
  const ClaimNoiseFloor* const before = Find(Claimed::kBefore, claim.name, gate);
  const ClaimNoiseFloor* const after = Find(Claimed::kAfter, claim.name, gate);
  if (!claim.is_of_fixed || claim.about != Claimed::kAfter || !before || !after) return 0;
  const double most = claim.dimension == Dimension::kAngle ? kMostCreep / gate.arm : kMostCreep;
  return std::min(std::abs(after->offset - before->offset), most);
}

// Returns the engine's error that widens a prediction at both ends. Contacts that are not equally
// deep tilt a part, which moves an origin that is far from the part's body.
double EitherWay(const Claim& claim, const StepNoiseFloor& gate) {
  if (claim.dimension == Dimension::kLength) {
    const double turn = gate.lag_turn + gate.penetration / claim.lever.arm;
    return gate.lag + gate.penetration + claim.lever.length * turn + CreepOf(claim, gate) +
           kRounding;
  }
  if (claim.dimension == Dimension::kAngle) {
    return gate.lag_turn + gate.penetration / gate.arm + CreepOf(claim, gate) + kRounding;
  }
  return 0;
}

double StepSize(const Claim& claim, const StepNoiseFloor& gate) {
  const ClaimNoiseFloor* const own = Find(claim.about, claim.name, gate);
  return own == nullptr ? 0 : own->step_size;
}

double ResolutionOf(const Claim& claim) {
  if (claim.dimension == Dimension::kLength) return kLengthResolution;
  return claim.dimension == Dimension::kAngle ? kAngleResolution : 0;
}

// Returns the deviation outside of a widened prediction that means nothing.
double GateOf(const Claim& claim, const StepNoiseFloor& gate) {
  return std::abs(StepSize(claim, gate)) + ResolutionOf(claim);
}

}  // namespace

Claim NoiseFloor::Passed(Claim claim) const {
  const StepNoiseFloor gate = steps.empty() ? StepNoiseFloor{} : steps[claim.step.index()];
  const double either_way = EitherWay(claim, gate);
  const double step_size = StepSize(claim, gate);
  claim.predicted.low -= either_way + std::max(0.0, -step_size);
  claim.predicted.high += either_way + std::max(0.0, step_size);
  claim.gate = GateOf(claim, gate);
  return claim;
}

double NoiseFloor::Floor(const Claim& claim) const {
  const StepNoiseFloor gate = steps.empty() ? StepNoiseFloor{} : steps[claim.step.index()];
  return EitherWay(claim, gate) + 2 * GateOf(claim, gate);
}

bool NoiseFloor::Hides(const Claim& passed, double clearance) const {
  const bool is_length = passed.dimension == Dimension::kLength;
  if (!is_length && passed.dimension != Dimension::kAngle) return false;
  const StepNoiseFloor gate = steps.empty() ? StepNoiseFloor{} : steps[passed.step.index()];
  const double either_way = EitherWay(passed, gate);
  const double width = passed.predicted.high - passed.predicted.low - 2 * either_way -
                       std::abs(StepSize(passed, gate));
  const bool has_width = std::isfinite(width) && width > 2 * (either_way + ResolutionOf(passed));
  if (has_width) return Floor(passed) > width;
  return Floor(passed) > (is_length ? clearance : clearance / gate.arm);
}

}  // namespace assay::check
