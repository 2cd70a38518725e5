#include "planner/kinematics/inverse/arm_survey.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <numeric>

#include "planner/base/random.h"

namespace assay::kinematics {
namespace {

constexpr int kReachPostures = 20000;
constexpr double kReturned = 1e-5;  // rad

ChainVector RandomPosture(const SerialChain& chain, RandomStream& random) {
  ChainVector q(chain.size());
  for (int i = 0; i < chain.size(); ++i) {
    const JointLimits& limits = chain.joints()[static_cast<std::size_t>(i)].limits;
    q[i] = random.Uniform(limits.lower, limits.upper);
  }
  return q;
}

double GreatestDifference(const ChainVector& a, const ChainVector& b) {
  double greatest = 0;
  for (int i = 0; i < a.size(); ++i) {
    greatest = std::max(greatest, std::abs(std::remainder(a[i] - b[i], 2 * std::numbers::pi)));
  }
  return greatest;
}

void SurveyReach(const SerialChain& chain, RandomStream random, ArmSurvey& survey) {
  survey.nearest = survey.lowest = std::numeric_limits<double>::infinity();
  survey.highest = -survey.lowest;
  for (int i = 0; i < kReachPostures; ++i) {
    const Vector3 tip = chain.Forward(RandomPosture(chain, random)).translation();
    survey.nearest = std::min(survey.nearest, tip.norm());
    survey.farthest = std::max(survey.farthest, tip.norm());
    survey.lowest = std::min(survey.lowest, tip.z());
    survey.highest = std::max(survey.highest, tip.z());
  }
}

// Solves the pose of a posture of either kind of arm.
class SurveyedInverse {
 public:
  explicit SurveyedInverse(const SerialChain& chain) {
    if (chain.size() == 7) {
      redundant_ = std::make_unique<RedundantInverse>(chain);
    } else {
      inverse_ = std::make_unique<ChainInverse>(chain);
    }
  }

  // The numbers of the six axes that are solved for, counted from 1.
  std::array<int, 6> Axes() const {
    std::array<int, 6> axes;
    std::iota(axes.begin(), axes.end(), 1);
    if (!redundant_) return axes;
    for (int& axis : axes) axis += axis > redundant_->locked_joint() ? 1 : 0;
    return axes;
  }

  ArmClass Class() const {
    return redundant_ ? redundant_->At(0.7).arm_class() : inverse_->arm_class();
  }

  std::string LockedJoint() const {
    if (!redundant_) return "";
    return redundant_->chain().joints()[static_cast<std::size_t>(redundant_->locked_joint())].name;
  }

  std::vector<ChainVector> Solve(const Pose& X, const ChainVector& posture) const {
    if (redundant_) return redundant_->Solve(X, posture[redundant_->locked_joint()]);
    std::vector<ChainVector> solutions;
    for (const SixAngles& q : inverse_->Solve(X)) solutions.emplace_back(q);
    return solutions;
  }

 private:
  std::unique_ptr<ChainInverse> inverse_;
  std::unique_ptr<RedundantInverse> redundant_;
};

void SurveyPose(const SerialChain& chain, const ChainVector& q,
                const std::vector<ChainVector>& solutions, ArmSurvey& survey) {
  const Pose X = chain.Forward(q);
  double nearest = std::numeric_limits<double>::infinity();
  for (const ChainVector& solution : solutions) {
    const Pose reached = chain.Forward(solution);
    survey.pose_error =
        std::max(survey.pose_error, (reached.matrix() - X.matrix()).cwiseAbs().maxCoeff());
    nearest = std::min(nearest, GreatestDifference(q, solution));
    if (!WithinLimits(chain, solution).empty()) survey.mean_within_limits += 1;
  }
  if (nearest > kReturned) {
    ++survey.not_returned;
  } else {
    survey.return_error = std::max(survey.return_error, nearest);
  }
  survey.fewest = std::min(survey.fewest, solutions.size());
  survey.most = std::max(survey.most, solutions.size());
  survey.mean += static_cast<double>(solutions.size());
}

std::vector<std::string> SingularPostures(const ArmClass& arm, const std::array<int, 6>& axes) {
  const auto at = [&](int i) { return axes[static_cast<std::size_t>(i % 6)]; };
  const int a = at(arm.first), b = at(arm.first + 1), c = at(arm.first + 2);
  const int d = at(arm.first + 3), e = at(arm.first + 4), f = at(arm.first + 5);
  switch (arm.kind) {
    case ArmKind::kConcurrent:
      return {
          fmt::format("The axes {}, {} and {} lie in one plane: joints {} and {} are not "
                      "independent, and one of them is free.",
                      a, b, c, a, c),
          fmt::format("The joints {}, {} and {} cannot move the point in which these axes meet "
                      "in all directions: the arm is stretched or folded, or the point is on "
                      "an axis. On an axis, its joint is free.",
                      std::min({d, e, f}), d + e + f - std::min({d, e, f}) - std::max({d, e, f}),
                      std::max({d, e, f}))};
    case ArmKind::kParallel:
      return {
          fmt::format("The axes {}, {} and {} lie in one plane: the arm is stretched or folded.", a,
                      b, c),
          fmt::format("The axis {} is parallel to them: joint {} is free.", e, e),
          fmt::format("The joints {} and {} have a double solution: the tip is at the border of "
                      "its reach beside the axis {}.",
                      std::min(d, f), std::max(d, f), std::min(d, f))};
    case ArmKind::kGeneral:
      return {"The determinant of the Jacobian is 0. This class has no simpler description."};
  }
  return {};
}

}  // namespace

ArmSurvey Survey(const SerialChain& chain, int poses, std::uint64_t seed) {
  const SurveyedInverse inverse(chain);
  ArmSurvey survey{.arm = inverse.Class(), .locked_joint = inverse.LockedJoint(), .poses = poses};
  survey.description = Describe(survey.arm, inverse.Axes());
  survey.singular = SingularPostures(survey.arm, inverse.Axes());
  survey.fewest = std::numeric_limits<std::size_t>::max();
  RandomStream random(seed, "arm survey");
  for (int i = 0; i < poses; ++i) {
    const ChainVector q = RandomPosture(chain, random);
    SurveyPose(chain, q, inverse.Solve(chain.Forward(q), q), survey);
  }
  survey.mean /= poses;
  survey.mean_within_limits /= poses;
  SurveyReach(chain, RandomStream(seed, "reach"), survey);
  return survey;
}

}  // namespace assay::kinematics
