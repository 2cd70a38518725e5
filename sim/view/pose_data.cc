#include "sim/view/pose_data.h"

#include <cmath>
#include <nlohmann/json.hpp>

namespace assay::view {
namespace {

double Rounded(double value) { return std::round(1e6 * value) / 1e6 + 0.0; }

}  // namespace

nlohmann::ordered_json ToJson(const Vector3& vector) {
  return {Rounded(vector.x()), Rounded(vector.y()), Rounded(vector.z())};
}

nlohmann::ordered_json ToJson(const Pose& pose) {
  nlohmann::ordered_json numbers = ToJson(Vector3(pose.translation()));
  Eigen::Quaterniond turn(pose.linear());
  if (turn.w() < 0) turn.coeffs() = -turn.coeffs();
  for (const double value : {turn.w(), turn.x(), turn.y(), turn.z()}) {
    numbers.push_back(Rounded(value));
  }
  return numbers;
}

}  // namespace assay::view
