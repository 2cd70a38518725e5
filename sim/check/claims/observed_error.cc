#include "sim/check/claims/observed_error.h"

#include <algorithm>
#include <cmath>

#include "planner/base/check.h"

namespace assay::check {
namespace {

using geometry::Matrix3;
using geometry::Pose;
using geometry::Vector3;

class Components {
 public:
  explicit Components(const std::string& part) : part_(part) {}

  void Add(const char* name, Unit unit, const Interval& predicted, double observed) {
    found_.push_back({std::string(name) + " of " + part_, unit, predicted, observed});
  }
  std::vector<ObservedError> Take() { return std::move(found_); }

 private:
  const std::string& part_;
  std::vector<ObservedError> found_;
};

void AddInHand(const plan::ErrorSet& set, const Pose& X_ToolGrasp, Components& components) {
  const Vector3 p = X_ToolGrasp.translation();
  // The order of rotations is R = R_z(theta) R_x(tip) R_y(twist).
  const Matrix3 R = X_ToolGrasp.linear();
  components.Add("x", Unit::kMetre, set.x, p.x());
  components.Add("y", Unit::kMetre, set.y, p.y());
  components.Add("z", Unit::kMetre, set.z, p.z());
  components.Add("theta", Unit::kRadian, set.theta, std::atan2(-R(0, 1), R(1, 1)));
  components.Add("tip", Unit::kRadian, set.tip, std::asin(std::clamp(R(2, 1), -1.0, 1.0)));
  components.Add("twist", Unit::kRadian, set.twist, std::atan2(-R(2, 0), R(2, 2)));
}

void AddAtRest(const plan::ErrorSet& set, const exec::TrueAndBelieved& part,
               Components& components) {
  const Vector3 d = part.truth.translation() - part.believed.translation();
  components.Add("x", Unit::kMetre, set.x, d.x());
  components.Add("y", Unit::kMetre, set.y, d.y());
  components.Add("z", Unit::kMetre, set.z, d.z());
  components.Add("theta", Unit::kRadian, set.theta,
                 YawOf(part.truth.linear() * part.believed.linear().transpose()));
}

}  // namespace

double YawOf(const Matrix3& rotation) {
  return std::atan2(rotation(1, 0) - rotation(0, 1), rotation(0, 0) + rotation(1, 1));
}

const plan::Hold& HoldOf(const plan::Action& action) {
  const plan::Hold* hold = HoldIn(action);
  ASSAY_CHECK(hold != nullptr, "a look leaves no part in the hand");
  return *hold;
}

std::vector<ObservedError> ObservedErrors(const domain::Problem& problem,
                                          const plan::Action& action, const plan::ErrorSet& set,
                                          const exec::Snapshot& moment) {
  Components components(problem.part(set.part).name);
  const exec::TrueAndBelieved& part = moment.parts[set.part.index()];
  if (set.in_hand) {
    AddInHand(set, moment.tool.believed.inverse() * part.truth * HoldOf(action).X_PartTool,
              components);
  } else {
    AddAtRest(set, part, components);
  }
  return components.Take();
}

}  // namespace assay::check
