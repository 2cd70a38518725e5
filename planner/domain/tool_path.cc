#include "planner/domain/tool_path.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "planner/base/check.h"

namespace assay::domain {
namespace {

using geometry::Matrix3;
using geometry::Pose;
using geometry::Vector3;
using kinematics::Indicators;
using kinematics::InverseSolution;
using kinematics::InverseSolutions;
using kinematics::JointVector;

constexpr double kStep = 0.025;       // metres between looks
constexpr double kLargestTurn = 0.4;  // radians of a joint from one look to the next

const InverseSolution* Find(const InverseSolutions& solutions, const Indicators& indicators) {
  const auto found = std::ranges::find_if(
      solutions, [&](const InverseSolution& s) { return s.indicators == indicators; });
  return found == solutions.end() ? nullptr : found;
}

// The configurations in which the arm has come along a path so far, each with its joint values.
class Configurations {
 public:
  Configurations(const Workcell& workcell, const Matrix3& R_WorldTool)
      : workcell_(workcell), R_WorldTool_(R_WorldTool) {}

  bool empty() const { return size_ == 0; }

  void StartAt(const Vector3& p_World) {
    for (const InverseSolution& s : SolutionsAt(p_World, workcell_.home())) {
      if (const auto q = workcell_.arm().NearestInRange(s.q, workcell_.home())) {
        alive_[size_++] = {s.indicators, *q};
      }
    }
  }

  void MoveTo(const Vector3& p_World) {
    const InverseSolutions solutions = SolutionsAt(p_World, alive_[0].q);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < size_; ++i) {
      if (const auto moved = Moved(alive_[i], solutions)) alive_[kept++] = *moved;
    }
    size_ = kept;
  }

 private:
  struct Configuration {
    Indicators indicators;
    JointVector q;
  };

  InverseSolutions SolutionsAt(const Vector3& p_World, const JointVector& reference) const {
    Pose X_WorldTool = geometry::Translation(p_World);
    X_WorldTool.linear() = R_WorldTool_;
    return workcell_.arm().Inverse(workcell_.FlangeFor(X_WorldTool), reference);
  }

  std::optional<Configuration> Moved(const Configuration& from,
                                     const InverseSolutions& solutions) const {
    const InverseSolution* solution = Find(solutions, from.indicators);
    if (solution == nullptr) return std::nullopt;
    const auto q = workcell_.arm().NearestInRange(solution->q, from.q);
    if (!q || (*q - from.q).cwiseAbs().maxCoeff() > kLargestTurn) return std::nullopt;
    return Configuration{from.indicators, *q};
  }

  const Workcell& workcell_;
  Matrix3 R_WorldTool_;
  std::array<Configuration, 8> alive_;
  std::size_t size_ = 0;
};

}  // namespace

bool CanFollow(const Workcell& workcell, const Matrix3& R_WorldTool,
               std::span<const Vector3> corners) {
  ASSAY_CHECK(!corners.empty());
  Configurations configurations(workcell, R_WorldTool);
  configurations.StartAt(corners[0]);
  for (std::size_t c = 1; c < corners.size(); ++c) {
    const Vector3 line = corners[c] - corners[c - 1];
    const int steps = static_cast<int>(std::ceil(line.norm() / kStep));
    for (int i = 1; i <= steps && !configurations.empty(); ++i) {
      configurations.MoveTo(corners[c - 1] + static_cast<double>(i) / steps * line);
    }
  }
  return !configurations.empty();
}

}  // namespace assay::domain
