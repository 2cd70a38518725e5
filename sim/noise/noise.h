#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sim/noise/error_box.h"

namespace assay::noise {

// One point of an error box: what the errors are in one trial. Channels that are not there are 0.
class Noise {
 public:
  Noise() : Noise({}, {}) {}                                    // no errors at all
  Noise(std::vector<Channel> box, std::vector<double> values);  // equally many (checked)

  const std::vector<Channel>& box() const { return *box_; }
  const std::vector<double>& values() const { return values_; }
  void Set(std::size_t channel, double value) { values_[channel] = value; }

  // Where a part truly is at the start if without errors it were at `X_WorldPart`: displaced in the
  // world and turned about the world's z through its own origin (Spar, equation 2), and as much
  // higher as the table under it.
  Pose TruePose(PartId part, const Pose& X_WorldPart) const;
  double TableHeight(PartId part) const;  // at the start
  // Where the part is put down or mated in this step; none drawn: as it was.
  std::optional<double> TableHeight(StepId step) const;
  // T_dM: the hand, in the frame in which it was told to be (Spar, equation 1).
  Pose HandError(StepId step) const;
  // Of the true pose about the one that the sensor tells.
  struct SensingError {
    geometry::Vector3 displacement = geometry::Vector3::Zero();  // world's axes
    double yaw = 0;
  };
  SensingError Sensed(StepId step) const;
  double Of(Effect effect) const;  // of the whole workcell: clearance and frictions

 private:
  double Value(Effect effect, PartId part, StepId step) const;

  std::shared_ptr<const std::vector<Channel>> box_;  // shared by copies
  std::vector<double> values_;
};

// "dx_block=0.002794 theta_block=-0.0959931": what differs from 0, with all digits; and back.
std::string Text(const Noise& noise);
// Throws InputError for a name that is no channel of the box, and for a value outside of it by more
// than rounding.
Noise ParseNoise(const std::string& text, std::vector<Channel> box);

}  // namespace assay::noise
