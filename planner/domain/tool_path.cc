#include "planner/domain/tool_path.h"

#include <Eigen/Geometry>
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
constexpr double kTurnStep = 0.1;     // radians between looks
constexpr double kLargestTurn = 0.4;  // radians of a joint from one look to the next

const InverseSolution* Find(const InverseSolutions& solutions, const Indicators& indicators) {
  const auto found = std::ranges::find_if(
      solutions, [&](const InverseSolution& s) { return s.indicators == indicators; });
  return found == solutions.end() ? nullptr : found;
}

Pose PoseOf(const Matrix3& R_WorldTool, const Vector3& p_World) {
  Pose X_WorldTool = geometry::Translation(p_World);
  X_WorldTool.linear() = R_WorldTool;
  return X_WorldTool;
}

// The configurations in which the arm has come along a path so far, each with its joint values.
class Configurations {
 public:
  explicit Configurations(const Workcell& workcell) : workcell_(workcell) {}

  bool empty() const { return size_ == 0; }
  // At the start of the path; of the one that was the nearest to home there.
  std::optional<JointVector> start() const {
    const auto turn = [&](const Configuration& c) { return (c.start - workcell_.home()).norm(); };
    const auto nearest = std::ranges::min_element(std::span(alive_.data(), size_), {}, turn);
    return empty() ? std::nullopt : std::optional(nearest->start);
  }

  void StartAt(const Pose& X_WorldTool) {
    for (const InverseSolution& s : SolutionsAt(X_WorldTool, workcell_.home())) {
      if (const auto q = workcell_.arm().NearestInRange(s.q, workcell_.home())) {
        alive_[size_++] = {s.indicators, *q, *q};
      }
    }
  }

  void MoveTo(const Pose& X_WorldTool) {
    const InverseSolutions solutions = SolutionsAt(X_WorldTool, alive_[0].q);
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
    JointVector start;
  };

  InverseSolutions SolutionsAt(const Pose& X_WorldTool, const JointVector& reference) const {
    return workcell_.arm().Inverse(workcell_.FlangeFor(X_WorldTool), reference);
  }

  std::optional<Configuration> Moved(const Configuration& from,
                                     const InverseSolutions& solutions) const {
    const InverseSolution* solution = Find(solutions, from.indicators);
    if (solution == nullptr) return std::nullopt;
    const auto q = workcell_.arm().NearestInRange(solution->q, from.q);
    if (!q || (*q - from.q).cwiseAbs().maxCoeff() > kLargestTurn) return std::nullopt;
    return Configuration{from.indicators, *q, from.start};
  }

  const Workcell& workcell_;
  std::array<Configuration, 8> alive_;
  std::size_t size_ = 0;
};

void MoveAlong(const Pose& from, const Pose& to, Configurations& configurations) {
  const Vector3 line = to.translation() - from.translation();
  const Eigen::AngleAxisd turn(Matrix3(from.linear().transpose() * to.linear()));
  const int steps =
      static_cast<int>(std::ceil(std::max({1.0, line.norm() / kStep, turn.angle() / kTurnStep})));
  for (int i = 1; i <= steps && !configurations.empty(); ++i) {
    const double share = static_cast<double>(i) / steps;
    configurations.MoveTo(
        PoseOf(from.linear() * Eigen::AngleAxisd(share * turn.angle(), turn.axis()),
               from.translation() + share * line));
  }
}

}  // namespace

bool CanFollow(const Workcell& workcell, const Matrix3& R_WorldTool,
               std::span<const Vector3> corners) {
  ASSAY_CHECK(!corners.empty());
  Configurations configurations(workcell);
  configurations.StartAt(PoseOf(R_WorldTool, corners[0]));
  for (std::size_t c = 1; c < corners.size(); ++c) {
    MoveAlong(PoseOf(R_WorldTool, corners[c - 1]), PoseOf(R_WorldTool, corners[c]), configurations);
  }
  return !configurations.empty();
}

PathReach ReachAlong(const Workcell& workcell, std::span<const Pose> X_WorldTools) {
  ASSAY_CHECK(!X_WorldTools.empty());
  Configurations configurations(workcell);
  configurations.StartAt(X_WorldTools[0]);
  PathReach reach;
  while (!configurations.empty()) {
    if (++reach.reached == X_WorldTools.size()) break;
    MoveAlong(X_WorldTools[reach.reached - 1], X_WorldTools[reach.reached], configurations);
  }
  reach.start = configurations.start();
  return reach;
}

}  // namespace assay::domain
