#include <gtest/gtest.h>

#include <cstdlib>
#include <optional>
#include <span>
#include <vector>

#include "planner/algebra/expression/evaluation.h"
#include "planner/base/random.h"
#include "planner/domain/matings/shaft_fit.h"
#include "planner/uncertainty/error_sets/mating_end.h"
#include "planner/uncertainty/preconditions/bounded_claim.h"
#include "planner/uncertainty/preconditions/certify.h"
#include "tests/planner/constraint_posting/scenarios.h"

// What is proved of a round shaft in its hole, against sampled poses of a leaning cylinder.
namespace assay::uncertainty::round_fit_test {
namespace {

using geometry::Vector3;

constexpr std::uint64_t kSeed = 30;

int Samples() {
  const char* const asked = std::getenv("ASSAY_ROUND_SAMPLES");
  return asked == nullptr ? 20'000 : std::stoi(asked);
}

Interval Times(double multiple, const Interval& range) {
  return {multiple * range.low, multiple * range.high};
}

domain::PoseError Times(double multiple, const domain::PoseError& error) {
  return {Times(multiple, error.x), Times(multiple, error.y), Times(multiple, error.z),
          Times(multiple, error.theta)};
}

// A dowel that is held and goes into a plate, with known errors of both and of the hand.
domain::Problem RoundProblem(double multiple) {
  domain::Problem problem = constraint_posting::LoadScenario("dowel");
  const domain::PoseError error = {{-1e-4, 1e-4}, {-1e-4, 1e-4}, {0, 0}, {-2e-3, 2e-3}};
  for (domain::Part& part : problem.parts) part.error = Times(multiple, error);
  problem.gripper_error = Times(multiple, error);
  return problem;
}

// The mating of a plan, just before it begins.
class Mating {
 public:
  explicit Mating(double multiple)
      : problem_(RoundProblem(multiple)),
        world_(problem_, Propagation::kSound),
        fits_(domain::FitsOf(problem_, problem_.mating(kFirst))) {
    for (const plan::Action& action :
         constraint_posting::ActionsOf(constraint_posting::FirstInstance(problem_))) {
      if (action.kind->leaves == domain::Leaves::kMated) {
        Prepare(action);
        return;
      }
      Propagate(world_, action);
    }
  }

  const std::vector<Interval>& box() const { return world_.constraints().box; }

  // Returns whether the certificate proves that the shaft stays inside the walls.
  bool IsProved() const {
    for (const Precondition& precondition : preconditions_) {
      if (!ClaimOf(precondition, ToldBound(precondition, world_, {})).holds()) return false;
    }
    return true;
  }

  // Returns the corners of the box at which the bounds of unproved preconditions are worst.
  std::vector<std::vector<double>> WorstCorners() const {
    std::vector<std::vector<double>> corners;
    for (const Precondition& precondition : preconditions_) {
      const algebra::Bound bound = ToldBound(precondition, world_, {});
      if (!ClaimOf(precondition, bound).holds() && !bound.at.empty()) corners.push_back(bound.at);
    }
    return corners;
  }

  // Returns whether the shaft's cylinder is inside the walls, from its tip to the mouth, in its
  // seat. The rim of a circle that leans is an ellipse, whose extent is computed exactly.
  bool IsInside(const std::vector<double>& values) const {
    for (const domain::ShaftFit& fit : fits_) {
      const auto [position, axis] = ShaftAt(fit, values);
      const double radius = *domain::RadiusOfRound(domain::CrossSection(fit));
      for (const domain::SideWall& wall : domain::SideWalls(fit, 0)) {
        const double reach = radius * wall.normal.cross(axis).norm();
        for (const double behind : {0.0, fit.depth}) {
          if (wall.normal.dot(position - behind * axis) - reach < wall.offset) return false;
        }
      }
    }
    return true;
  }

 private:
  static constexpr domain::MatingId kFirst{0};

  void Prepare(const plan::Action& assemble) {
    const ManipulatorError draw = world_.DrawManipulator();
    const Transform X_ToolGrasp = PossibleGrasp(world_.held(), draw, Propagation::kSound);
    const MatingEnd end = MatingEndOf(world_, kFirst, assemble.hold, X_ToolGrasp);
    relative_ = algebra::Inverse(end.fixed) * end.Seated();
    for (Precondition& precondition :
         MatingPreconditions(world_, kFirst, assemble.hold, X_ToolGrasp)) {
      if (precondition.condition == plan::condition::kSlideIn)
        preconditions_.push_back(std::move(precondition));
    }
  }

  // Returns the tip of the shaft and the direction of its axis, in the frame of the hole's part.
  std::pair<Vector3, Vector3> ShaftAt(const domain::ShaftFit& fit,
                                      const std::vector<double>& values) const {
    geometry::Pose X_HoleShaft = geometry::Pose::Identity();
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column) {
        X_HoleShaft.linear()(row, column) = Value(relative_.rotation[row][column], values);
      }
      X_HoleShaft.translation()(row) = Value(relative_.translation[row], values);
    }
    const geometry::Pose X_HoleTip = X_HoleShaft * fit.shaft.X_PartFeature;
    return {X_HoleTip.translation(), X_HoleTip.linear().col(2)};
  }

  static double Value(const Expression& expression, const std::vector<double>& values) {
    return algebra::Evaluate(expression, std::span<const double>(values));
  }

  domain::Problem problem_;
  UncertainWorld world_;
  std::vector<domain::ShaftFit> fits_;
  Transform relative_;
  std::vector<Precondition> preconditions_;
};

// Returns the greatest multiple of the errors for which the certificate holds, to a thousandth.
double GreatestProved() {
  double proved = 0;
  double unproved = 100;
  while (unproved - proved > 1e-3 * unproved) {
    const double middle = (proved + unproved) / 2;
    (Mating(middle).IsProved() ? proved : unproved) = middle;
  }
  return proved;
}

// Draws values of the errors, half of the time at a corner of the box.
std::vector<double> Drawn(const std::vector<Interval>& box, RandomStream& random) {
  std::vector<double> values;
  const bool at_corner = random.Index(2) == 0;
  for (const Interval& range : box) {
    values.push_back(!at_corner             ? random.Uniform(range.low, range.high)
                     : random.Index(2) == 0 ? range.low
                                            : range.high);
  }
  return values;
}

// ASSAY_ROUND_SAMPLES sets the number of sampled poses.
TEST(RoundFit, NoSampledPoseBeatsWhatIsProved) {
  const Mating mating(GreatestProved());
  RandomStream random(kSeed, "poses of a round shaft");
  for (int i = 0; i < Samples(); ++i) {
    ASSERT_TRUE(mating.IsInside(Drawn(mating.box(), random))) << "seed " << kSeed << ", pose " << i;
  }
}

TEST(RoundFit, TheProofComesWithinTwoPercentOfTheTruth) {
  const double proved = GreatestProved();
  EXPECT_GT(proved, 0.1);
  const Mating more(proved / 0.98);
  const auto corners = more.WorstCorners();
  ASSERT_FALSE(corners.empty());
  bool is_beaten = false;
  for (const std::vector<double>& corner : corners) is_beaten = is_beaten || !more.IsInside(corner);
  EXPECT_TRUE(is_beaten) << "the shaft is inside with 1.02 times the errors that are proved";
}

}  // namespace
}  // namespace assay::uncertainty::round_fit_test
