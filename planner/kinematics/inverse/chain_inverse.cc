#include "planner/kinematics/inverse/chain_inverse.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/base/check.h"
#include "planner/base/random.h"
#include "planner/kinematics/arm_solutions.h"

namespace assay::kinematics {
namespace {

constexpr double kWholeTurn = 2 * std::numbers::pi;
constexpr double kSolved = 1e-9;        // greatest error of a solution, m and entries of rotations
constexpr double kRefined = 1e-13;      // an error that needs no refinement
constexpr double kSameSolution = 1e-6;  // rad
constexpr double kNearSolution = 1e-5;  // rad
constexpr double kNearlySolved = 0.05;  // greatest error of the class's solution for such an arm
// Let an arm deviate by d from its class (ArmClass::deviation). Two of its solutions that are near
// to each other are then at a distance of about the square root of d from the place where they
// would coincide. At such solutions, the least singular value of the Jacobian is below
// kSingularMotion times the square root of d.
constexpr double kSingularMotion = 20;
// Beside a singular pose, more joint values than this can reach the pose to within the error.
constexpr double kBeyondLimit = 1e-9;  // rad
constexpr double kAnyValue = 0.7;      // rad; a joint value without meaning

// The twist that moves the tip from one pose to another, to first order.
Eigen::Matrix<double, 6, 1> PoseError(const Pose& from, const Pose& to) {
  Vector3 turn = Vector3::Zero();
  for (int i = 0; i < 3; ++i) {
    turn += Vector3(from.linear().col(i)).cross(Vector3(to.linear().col(i))) / 2;
  }
  Eigen::Matrix<double, 6, 1> error;
  error << to.translation() - from.translation(), turn;
  return error;
}

// The damping keeps steps short where the Jacobian is singular, and vanishes at a solution.
SixAngles DampedStep(const Eigen::Matrix<double, 6, 6>& J,
                     const Eigen::Matrix<double, 6, 1>& twist) {
  Eigen::Matrix<double, 6, 6> normal = J.transpose() * J;
  normal.diagonal().array() += std::min(twist.squaredNorm(), 1e-3) + 1e-15;
  return normal.ldlt().solve(J.transpose() * twist);
}

// The motion of the joints that moves the tip least.
struct LeastMotion {
  double tip = 0;    // singular value of the Jacobian
  SixAngles joints;  // unit vector
};
LeastMotion LeastMotionAt(const SerialChain& chain, const SixAngles& q) {
  const Eigen::Matrix<double, 6, 6> J = chain.Jacobian(q);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> eigen(J.transpose() * J);
  return {std::sqrt(std::max(0.0, eigen.eigenvalues()[0])), eigen.eigenvectors().col(0)};
}

double LargestError(const Pose& a, const Pose& b) {
  return (a.matrix() - b.matrix()).cwiseAbs().maxCoeff();
}

double InHalfOpenTurn(double angle) {
  const double wrapped = std::remainder(angle, kWholeTurn);
  return wrapped <= -std::numbers::pi ? std::numbers::pi : wrapped;
}

bool AreSame(const SixAngles& a, const SixAngles& b, double tolerance) {
  for (int i = 0; i < 6; ++i) {
    if (std::abs(std::remainder(a[i] - b[i], kWholeTurn)) > tolerance) return false;
  }
  return true;
}

// Returns the index of a known solution, or the number of them if there is none.
std::size_t Find(const SixAngles& q, const std::vector<SixAngles>& solutions, double tolerance) {
  const auto known = std::ranges::find_if(
      solutions, [&](const SixAngles& other) { return AreSame(other, q, tolerance); });
  return static_cast<std::size_t>(known - solutions.begin());
}

ChainVector RandomAngles(RandomStream& random, int size) {
  ChainVector q(size);
  for (double& angle : q) angle = random.Uniform(-std::numbers::pi, std::numbers::pi);
  return q;
}

// Returns false if the tip cannot be moved in all directions at any posture. An arm with a
// spherical shoulder and a spherical wrist is such an arm while its elbow is locked.
bool MovesInAllDirections(const SerialChain& chain) {
  RandomStream random(1, "postures");
  for (int i = 0; i < 10; ++i) {
    const ChainJacobian J = chain.Jacobian(RandomAngles(random, 6));
    if (Eigen::FullPivLU<ChainJacobian>(J).setThreshold(1e-6).rank() == 6) return true;
  }
  return false;
}

// Adds the refined solution, if it is one and is new. Returns its index, or nothing if there is no
// solution.
std::optional<std::size_t> AddRefined(const SerialChain& chain, const Pose& X_BaseTip,
                                      const SixAngles& q, const NewtonLimits& limits,
                                      std::vector<SixAngles>& solutions) {
  std::optional<SixAngles> refined = RefineByNewton(chain, X_BaseTip, q, limits);
  if (!refined) return std::nullopt;
  for (double& angle : *refined) angle = InHalfOpenTurn(angle);
  const std::size_t index = Find(*refined, solutions, kSameSolution);
  if (index == solutions.size()) {
    if (index == kMostSolutions) return std::nullopt;
    solutions.push_back(*refined);
  }
  return index;
}

}  // namespace

std::optional<SixAngles> RefineByNewton(const SerialChain& chain, const Pose& X_BaseTip,
                                        SixAngles q, const NewtonLimits& limits) {
  Pose reached;
  Eigen::Matrix<double, 6, 6> J = chain.Jacobian(q, &reached);
  double error = LargestError(reached, X_BaseTip);
  if (!(error < limits.start_error)) return std::nullopt;
  for (int i = 0; i < limits.steps && error > kRefined; ++i) {
    SixAngles step = DampedStep(J, PoseError(reached, X_BaseTip));
    const double most = step.cwiseAbs().maxCoeff();
    if (!(most < 1e3)) return std::nullopt;
    if (most > 0.5) step *= 0.5 / most;
    const SixAngles next = q + step;
    J = chain.Jacobian(next, &reached);
    const double next_error = LargestError(reached, X_BaseTip);
    if (error < kSolved && next_error > error / 2) break;
    q = next;
    error = next_error;
  }
  return error < kSolved ? std::optional(q) : std::nullopt;
}

ChainInverse::ChainInverse(SerialChain chain) : chain_(std::move(chain)) {
  ASSAY_CHECK(chain_.size() == 6);
  for (int i = 0; i < 6; ++i) axes_[static_cast<std::size_t>(i)] = chain_.axis(i);
  X_TipBase_ = chain_.X_BaseTipAtZero().inverse();
  arm_ = ClassOf(chain_);
  const SerialChain ideal = Idealized(chain_, arm_);
  for (int i = 0; i < 6; ++i) ideal_axes_[static_cast<std::size_t>(i)] = ideal.axis(i);
  if (arm_.kind == ArmKind::kGeneral || !arm_.IsExact()) RankSearches();
}

// Searches over different joints differ where several solutions have the same value of a joint,
// which special arms cause. The search that finds most solutions of a few poses is the best.
void ChainInverse::RankSearches() {
  RandomStream random(1, "searched joint");
  std::array<Pose, 12> poses;
  for (Pose& pose : poses) pose = chain_.Forward(RandomAngles(random, 6));
  std::vector<std::pair<std::size_t, SearchedJoint>> ranked;
  for (int start = 0; start < 6; ++start) {
    for (int searched = 0; searched < 3; ++searched) {
      const SearchedJoint joint{start, searched};
      std::size_t found = 0;
      for (const Pose& pose : poses) {
        std::vector<SixAngles> solutions;
        found += AddSearched(joint, pose, solutions);
      }
      ranked.emplace_back(found, joint);
    }
  }
  std::ranges::stable_sort(ranked, [](const auto& a, const auto& b) { return a.first > b.first; });
  for (const auto& [found, joint] : ranked) {
    const bool known = std::ranges::any_of(
        searches_, [&](const SearchedJoint& other) { return other.joint() == joint.joint(); });
    if (!known) searches_.push_back(joint);
  }
}

// Adds the solutions of one search to the known ones. Returns how many it found.
std::size_t ChainInverse::AddSearched(const SearchedJoint& joint, const Pose& X_BaseTip,
                                      std::vector<SixAngles>& known) const {
  std::array<bool, kMostSolutions> found = {};
  for (const SixAngles& q : SolveByElimination(axes_, joint, X_BaseTip * X_TipBase_)) {
    // The search comes nearer to its solutions than solutions are to each other.
    std::optional<std::size_t> index = Find(q, known, kNearSolution);
    if (index == known.size()) {
      index = AddRefined(chain_, X_BaseTip, q, {.steps = 25, .start_error = 0.5}, known);
    }
    if (index) found[*index] = true;
  }
  return static_cast<std::size_t>(std::ranges::count(found, true));
}

void ChainInverse::AddBySearches(const Pose& X_BaseTip, std::vector<SixAngles>& known) const {
  for (const SearchedJoint& joint : searches_) {
    const std::size_t before = known.size();
    const std::size_t found = AddSearched(joint, X_BaseTip, known);
    const bool agree = before == known.size() && found == before;
    if (&joint != &searches_.front() && agree && before % 2 == 0) break;
  }
}

ClosedFormSolutions ChainInverse::ClosedForm(const Pose& X_BaseTip,
                                             const SixAngles& reference) const {
  const Pose motion = X_BaseTip * X_TipBase_;
  return arm_.kind == ArmKind::kConcurrent ? SolveConcurrent(ideal_axes_, arm_, motion, reference)
                                           : SolveParallel(ideal_axes_, arm_, motion, reference);
}

// A closed form is exact up to rounding, which is worst beside singular poses.
std::vector<SixAngles> ChainInverse::SolveInClosedForm(const Pose& X_BaseTip,
                                                       const SixAngles& reference) const {
  std::vector<SixAngles> solutions;
  for (const SixAngles& q : ClosedForm(X_BaseTip, reference)) {
    AddRefined(chain_, X_BaseTip, q, {.steps = 10, .start_error = 1e-3}, solutions);
  }
  return solutions;
}

// Near each solution of the class there is exactly one solution of the arm, except where two
// solutions are near to each other.
std::vector<SixAngles> ChainInverse::SolveFromClosedForm(const Pose& X_BaseTip,
                                                         const SixAngles& reference) const {
  const NewtonLimits limits = {.start_error = kNearlySolved};
  const double singular = kSingularMotion * std::sqrt(arm_.deviation);
  std::vector<SixAngles> solutions;
  bool is_regular = true;
  for (const SixAngles& q : ClosedForm(X_BaseTip, reference)) {
    const auto index = AddRefined(chain_, X_BaseTip, q, limits, solutions);
    const SixAngles at = index ? solutions[*index] : q;
    if (LargestError(chain_.Forward(at), X_BaseTip) > kNearlySolved) continue;
    const LeastMotion least = LeastMotionAt(chain_, at);
    if (least.tip > singular) continue;
    is_regular = false;
    for (const double step : {0.003, 0.01, 0.03, 0.1, 0.3, 1.0, 2.0}) {
      for (const double side : {-step, step}) {
        AddRefined(chain_, X_BaseTip, at + side * least.joints, limits, solutions);
      }
    }
  }
  if (!is_regular) AddBySearches(X_BaseTip, solutions);
  return solutions;
}

std::vector<SixAngles> ChainInverse::Solve(const Pose& X_BaseTip,
                                           const SixAngles& reference) const {
  if (arm_.kind != ArmKind::kGeneral) {
    return arm_.IsExact() ? SolveInClosedForm(X_BaseTip, reference)
                          : SolveFromClosedForm(X_BaseTip, reference);
  }
  std::vector<SixAngles> solutions;
  AddBySearches(X_BaseTip, solutions);
  return solutions;
}

std::vector<ChainVector> WithinLimits(const SerialChain& chain, const ChainVector& q) {
  std::vector<ChainVector> found = {q};
  for (int i = 0; i < chain.size(); ++i) {
    const JointLimits& limits = chain.joints()[static_cast<std::size_t>(i)].limits;
    const double first =
        q[i] + kWholeTurn * std::ceil((limits.lower - kBeyondLimit - q[i]) / kWholeTurn);
    std::vector<ChainVector> extended;
    for (ChainVector base : found) {
      for (double angle = first; angle <= limits.upper + kBeyondLimit; angle += kWholeTurn) {
        base[i] = std::clamp(angle, limits.lower, limits.upper);
        extended.push_back(base);
      }
    }
    found = std::move(extended);
  }
  return found;
}

// A joint's class is that at a value without meaning, because axes may meet by chance at others.
RedundantInverse::RedundantInverse(SerialChain chain) : chain_(std::move(chain)), locked_(-1) {
  ASSAY_CHECK(chain_.size() == 7);
  ArmClass best;
  for (int joint = 0; joint < 7; ++joint) {
    const SerialChain rest = chain_.Locked(joint, kAnyValue);
    if (!MovesInAllDirections(rest)) continue;
    const ArmClass arm = ClassOf(rest);
    if (locked_ >= 0 && IsHarder(arm, best)) continue;
    best = arm;
    locked_ = joint;
  }
  locked_ = std::max(locked_, 0);
}

std::vector<ChainVector> RedundantInverse::Solve(const Pose& X_BaseTip, double value,
                                                 const SixAngles& reference) const {
  std::vector<ChainVector> solutions;
  for (const SixAngles& six : At(value).Solve(X_BaseTip, reference)) {
    ChainVector q(7);
    q << six.head(locked_), value, six.tail(6 - locked_);
    solutions.push_back(q);
  }
  return solutions;
}

}  // namespace assay::kinematics
