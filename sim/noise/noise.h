#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sim/noise/error_box.h"

namespace assay::noise {

// One point of an error box: the errors in one trial. A channel that the box lacks has the value 0.
class Noise {
 public:
  Noise() : Noise({}, {}) {}                                    // no errors at all
  Noise(std::vector<Channel> box, std::vector<double> values);  // of one length (checked)

  const std::vector<Channel>& box() const { return *box_; }
  const std::vector<double>& values() const { return values_; }
  void Set(std::size_t channel, double value) { values_[channel] = value; }

  // Returns the true pose of a part at the start. X_WorldPart is its pose without errors. The part
  // is displaced in the world, turned about the world's z axis through its own origin (Spar,
  // equation 2), and raised by as much as the table under it.
  Pose TruePose(PartId part, const Pose& X_WorldPart) const;
  double TableHeight(PartId part) const;  // at the start
  // Returns the height error, in metres, where the part is put down or mated in this step. The
  // result is empty if no height error was drawn, and the table then stays as it was.
  std::optional<double> TableHeight(StepId step) const;
  // Returns T_dM: the hand's true pose in the frame of its commanded pose (Spar, equation 1).
  Pose HandError(StepId step) const;
  // The true pose relative to the pose that the sensor measures.
  struct SensingError {
    geometry::Vector3 displacement = geometry::Vector3::Zero();  // metres, world's axes
    double yaw = 0;
  };
  SensingError Sensed(StepId step) const;
  double Of(Effect effect) const;  // of the whole workcell: clearance and frictions

 private:
  double Value(Effect effect, PartId part, StepId step) const;

  std::shared_ptr<const std::vector<Channel>> box_;  // shared by copies
  std::vector<double> values_;
};

// Returns the values that differ from 0, with all digits: "dx_block=0.002794
// theta_block=-0.0959931". ParseNoise reads this form.
std::string Text(const Noise& noise);
// Parses the form of Text. Throws InputError for a name that is no channel of the box, and for a
// value that is outside of its range by more than rounding.
Noise ParseNoise(const std::string& text, std::vector<Channel> box);

}  // namespace assay::noise
