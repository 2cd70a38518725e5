#include "sim/execution/trial/mating_trial.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "planner/base/random.h"
#include "planner/geometry/pose.h"
#include "sim/mujoco/contact.h"
#include "tests/sim/execution/figure15.h"

namespace assay::execution::mating_trial_test {
namespace {

constexpr double kDegree = M_PI / 180;
constexpr double kHalfWidth = 0.01905;  // of the shaft, metres
constexpr double kMouth = 0.0762;       // of the hole along the block's x, metres
constexpr double kAxis = 0.08255;       // of the hole, z of the block, metres
constexpr double kSeat = 0.00635;       // x of the tip when seated, metres
constexpr double kClearance = 0.00025;  // on each side, metres
const Vector3 kNone = Vector3::Zero();

// Makes by hand a strategy that puts a square shaft into its hole, one vertex of the tip first.
class SquareStrategy {
 public:
  explicit SquareStrategy(const Pose& X_HeldTip) { strategy_.X_HeldTip = X_HeldTip; }

  // Returns the pose of the tip with these tilts about y and z and this turn about x. The vertex
  // (y, z) of its end is at `where`.
  static Pose VertexAt(const Vector3& tilts, int y, int z, const Vector3& where) {
    Pose X = geometry::RotationX(tilts.x()) * geometry::RotationY(-tilts.y()) *
             geometry::RotationZ(tilts.z());
    X.translation() = where - X.linear() * Vertex(y, z);
    return X;
  }
  static Vector3 Vertex(int y, int z) { return {0, y * kHalfWidth, z * kHalfWidth}; }

  void Start(const Pose& X_FixedTip) { strategy_.X_FixedStart = X_FixedTip; }
  int Contact(const std::string& name, const Vector3& normal, const Vector3& at) {
    strategy_.contacts.push_back({name, normal, at});
    return static_cast<int>(strategy_.contacts.size()) - 1;
  }
  void Go(const Pose& X_FixedTip, const std::vector<int>& kept = {},
          std::optional<int> until = std::nullopt, double beyond = 0) {
    strategy_.motions.push_back(
        {.kept = kept, .X_FixedTip = X_FixedTip, .until = until, .beyond = beyond});
  }
  void Slide(const Pose& X_FixedTip) {
    Go(X_FixedTip);
    strategy_.motions.back().slides = true;
  }
  const plan::Strategy& strategy() const { return strategy_; }

 private:
  plan::Strategy strategy_;
};

class MatingTrial : public testing::Test {
 protected:
  static const domain::Problem& problem() {
    static const domain::Problem problem = domain::ReadProblem(
        Document::Load(ASSAY_SOURCE_DIR "/scenarios/mate-square.yaml"), ASSAY_SOURCE_DIR "/models");
    return problem;
  }
  static const scene::Scene& scene() {
    static const scene::Scene scene(problem(),
                                    {.grasp = scene::GraspMode::kWeld, .part_friction = 0.2});
    return scene;
  }
  static MatingSetting Setting(const Vector3& d, const Vector3& w) {
    const domain::MatingId id(0);
    Pose X_HeldTip = Pose::Identity();
    X_HeldTip.linear() = problem().mating(id).X_FixedHeld.linear().transpose();
    X_HeldTip.translation().x() = kMouth - kSeat;
    return {id, HoldForMating(problem(), id), X_HeldTip, d, w};
  }
  static double Depth(const MatingResult& result) {
    return (result.X_FixedHeld * Setting(kNone, kNone).X_HeldTip).translation().x() - kSeat;
  }
};

// Returns a motion down from 4 mm above the block's front, beside the hole, until a vertex of the
// tip touches the front.
SquareStrategy ToTheFront(const Pose& X_HeldTip, double beyond) {
  SquareStrategy plan(X_HeldTip);
  const Vector3 tilts = Vector3(0, 16, 8) * kDegree;
  const Vector3 beside(kMouth, kHalfWidth, kAxis - 0.045 + kHalfWidth);
  const Pose end = SquareStrategy::VertexAt(tilts, 1, 1, beside);
  const int front = plan.Contact("vertex on front", Vector3::UnitX(),
                                 end.linear() * SquareStrategy::Vertex(1, 1));
  plan.Start(geometry::Translation(0.004, 0, 0) * end);
  plan.Go(end, {}, front, beyond);
  return plan;
}

// Returns a full insertion. The tip is laid flat on the block's front, which tells its height and
// both tilts. Then one vertex goes into the hole and finds two walls. The next vertex is lowered
// and finds a wall by a turn. The place of the hole is then known.
plan::Strategy Insertion(const Pose& X_HeldTip) {
  SquareStrategy plan = ToTheFront(X_HeldTip, 1);
  const auto tilted = [](double turn, double y, double z) -> Vector3 {
    return Vector3(turn, y, z) * kDegree;
  };
  const auto at = SquareStrategy::VertexAt;
  const auto vertex = [&](const Vector3& tilts, int y, int z) -> Vector3 {
    return Vector3(at(tilts, 1, 1, kNone).linear() * SquareStrategy::Vertex(y, z));
  };
  const Vector3 up = Vector3::UnitX();
  const Vector3 beside(kMouth, kHalfWidth, kAxis - 0.045 + kHalfWidth);
  const Vector3 one = tilted(0, 16, 0);
  const int second = plan.Contact("second vertex on front", up, vertex(one, -1, 1));
  const int third = plan.Contact("third vertex on front", up, vertex(kNone, 1, -1));
  plan.Go(at(one, 1, 1, beside), {0}, second, 0.5);
  plan.Go(at(kNone, 1, 1, beside), {0, second}, third, 0.5);
  plan.Go(at(kNone, 1, 1, beside + 0.002 * up));

  const Vector3 both = tilted(1.2, 16, 8);
  const double depth = 0.001;
  const double shift = 0.0035;
  const Vector3 corner(kMouth - depth, kHalfWidth + kClearance, kAxis + kHalfWidth + kClearance);
  const Vector3 inside = corner - Vector3(0, shift, shift);
  const int again = plan.Contact("vertex on front again", up, vertex(both, 1, 1));
  plan.Go(at(both, 1, 1, beside + 0.003 * up));
  plan.Go(at(both, 1, 1, beside), {}, again, 0.5);
  plan.Go(at(both, 1, 1, beside + 0.0015 * up));
  plan.Go(at(both, 1, 1, inside + (depth + 0.0015) * up));
  plan.Go(at(both, 1, 1, inside));

  const Vector3 rim = depth * up;
  const Vector3 turned = tilted(1.2, 16, 0);
  const int left = plan.Contact("vertex on left wall", {0, -1, 0}, vertex(both, 1, 1) + rim);
  const int top = plan.Contact("vertex on upper wall", {0, 0, -1}, vertex(both, 1, 1) + rim);
  const int level = plan.Contact("vertex on upper wall", {0, 0, -1}, vertex(one, 1, 1) + rim);
  const int other =
      plan.Contact("second vertex on upper wall", {0, 0, -1}, vertex(one, -1, 1) + rim);
  plan.Go(at(both, 1, 1, inside + Vector3(0, shift, 0)), {}, left, 1);
  plan.Go(at(both, 1, 1, corner), {left}, top, 1);
  plan.Go(at(turned, 1, 1, corner), {left, top});
  plan.Go(at(one, 1, 1, corner), {left, top}, other, 2);
  const Vector3 centred = corner - Vector3(0, kClearance, 0);
  plan.Go(at(one, 1, 1, centred), {level, other});
  plan.Go(at(kNone, 1, 1, centred), {level, other});
  const Vector3 free = centred - Vector3(0, 0, kClearance);
  plan.Go(at(kNone, 1, 1, free));
  plan.Slide(at(kNone, 1, 1, Vector3(kSeat, free.y(), free.z())));
  return plan.strategy();
}

MatingResult Insert(const domain::Problem& problem, const scene::Scene& scene,
                    const MatingSetting& setting) {
  return RunMatingTrial(problem, scene, setting, Insertion(setting.X_HeldTip));
}

TEST_F(MatingTrial, InsertsWithErrorsAtTheirBounds) {
  const Vector3 signs(-1, 1, 1);
  const MatingResult result = Insert(problem(), scene(), Setting(0.002 * signs, kDegree * signs));
  EXPECT_EQ(result.end.outcome, TrialOutcome::kSucceeded) << result.end.reason;
  EXPECT_NEAR(Depth(result), 0, 1e-3);
}

TEST_F(MatingTrial, AStraightLineDoesNotInsertWithSuchErrors) {
  const MatingSetting setting = Setting({0, 0.002, -0.002}, kNone);
  const MatingResult result = RunStraightMating(problem(), scene(), setting);
  EXPECT_EQ(result.end.outcome, TrialOutcome::kWrongContact);
  EXPECT_GT(Depth(result), 0.05);
}

// The motion ends 3 mm above the front.
TEST_F(MatingTrial, AContactThatDoesNotComeIsATimeout) {
  const MatingSetting setting = Setting(kNone, kNone);
  SquareStrategy plan = ToTheFront(setting.X_HeldTip, 0);
  plan::Strategy strategy = plan.strategy();
  strategy.motions[0].X_FixedTip =
      geometry::Translation(0.003, 0, 0) * strategy.motions[0].X_FixedTip;
  const MatingResult result = RunMatingTrial(problem(), scene(), setting, strategy);
  EXPECT_EQ(result.end.outcome, TrialOutcome::kTimeout);
  EXPECT_EQ(result.end.motion, 0);
  EXPECT_LT(result.greatest_force, 10) << "it touched nothing: that is the part's own weight";
}

// Without contact, no force decides anything. A strategy of free motions ends at the same time and
// place as with dynamics, whatever the hand's error. Soft servos lag by a tenth of a millimetre.
TEST_F(MatingTrial, FreeMotionsEndAsWithDynamics) {
  const MatingSetting setting = Setting({0.001, -0.002, 0.001}, Vector3(1, -1, 2) * kDegree);
  SquareStrategy plan(setting.X_HeldTip);
  const auto at = [](const Vector3& tilts, double height) {
    return SquareStrategy::VertexAt(tilts, 1, 1, {kMouth + height, kHalfWidth, kAxis - 0.03});
  };
  plan.Start(at(kNone, 0.02));
  plan.Go(at(Vector3(0, 10, 5) * kDegree, 0.015));
  plan.Go(at(Vector3(3, 2, 0) * kDegree, 0.025));
  const MatingResult quick = RunMatingTrial(problem(), scene(), setting, plan.strategy());
  const MatingResult exact =
      RunMatingTrial(problem(), scene(), setting, plan.strategy(), {.kinematic_step = 0});
  EXPECT_EQ(quick.end.outcome, TrialOutcome::kSucceeded) << quick.end.reason;
  EXPECT_EQ(exact.end.outcome, TrialOutcome::kSucceeded) << exact.end.reason;
  const Pose between = exact.X_FixedHeld.inverse() * quick.X_FixedHeld;
  EXPECT_LT(between.translation().norm(), 2e-4);
  EXPECT_LT(Eigen::AngleAxisd(between.linear()).angle(), 0.02 * kDegree);
  EXPECT_NEAR(quick.duration, exact.duration, 0.02);
  EXPECT_NEAR(quick.greatest_force, exact.greatest_force, 2);
}

TEST_F(MatingTrial, AnObstructedMotionStops) {
  const MatingSetting setting = Setting(kNone, kNone);
  plan::Strategy strategy = ToTheFront(setting.X_HeldTip, 0).strategy();
  strategy.motions[0].until.reset();
  strategy.motions[0].X_FixedTip =
      geometry::Translation(-0.02, 0, 0) * strategy.motions[0].X_FixedTip;
  const MatingResult result = RunMatingTrial(problem(), scene(), setting, strategy);
  EXPECT_TRUE(result.end.outcome == TrialOutcome::kWrongContact ||
              result.end.outcome == TrialOutcome::kOverload)
      << Name(result.end.outcome);
  EXPECT_GT(Depth(result), 0.06) << "it did not go through the block";
}

// The front is 3 mm lower than believed. The first attempt goes beyond the planned contact by half
// of its way, and does not reach the front.
TEST_F(MatingTrial, AContactThatIsTooFarAwayIsFoundAtTheSecondAttempt) {
  const MatingSetting setting = Setting({0.003, 0, 0}, kNone);
  const plan::Strategy strategy = ToTheFront(setting.X_HeldTip, 0.5).strategy();
  const MatingResult result = RunMatingTrial(problem(), scene(), setting, strategy);
  EXPECT_EQ(result.end.outcome, TrialOutcome::kSucceeded) << result.end.reason;
  ASSERT_EQ(result.end.recovered.size(), 1U);
  EXPECT_EQ(result.end.recovered[0].outcome, TrialOutcome::kTimeout);
  MatingTrialOptions once;
  once.law.attempts = 1;
  EXPECT_EQ(RunMatingTrial(problem(), scene(), setting, strategy, once).end.outcome,
            TrialOutcome::kTimeout);
}

// Records the contact points of the two parts at the last timestep in which they touch.
struct Pressed {
  std::vector<Vector3> points = {};  // metres, fixed part's frame

  void operator()(const scene::Scene& scene, const domain::Mating& mating,
                  const mujoco::Data& data) {
    const auto contacts =
        mujoco::ContactsBetween(data, scene.Body(mating.fixed), scene.Body(mating.held));
    if (contacts.empty()) return;
    points.clear();
    const Pose X_FixedWorld = scene.TruePose(data, mating.fixed).inverse();
    for (const mujoco::Contact& contact : contacts)
      points.push_back(X_FixedWorld * contact.position);
  }
};

std::string VertexName(int y, int z) { return fmt::format("vertex {} {} on front", y, z); }

// Returns a motion of the tilted tip down to 10 mm below the block's front. Contacts of its four
// vertices with the front are unwanted, and so is a contact with a wall that is nowhere near.
plan::Strategy ThroughTheFront(const Pose& X_HeldTip, const Vector3& tilts) {
  SquareStrategy plan(X_HeldTip);
  const Vector3 beside(kMouth, kHalfWidth, kAxis - 0.045 + kHalfWidth);
  Pose end = SquareStrategy::VertexAt(tilts, 1, 1, beside);
  double lowest = 0;
  for (const int y : {-1, 1}) {
    for (const int z : {-1, 1})
      lowest = std::min(lowest, (end * SquareStrategy::Vertex(y, z)).x() - kMouth);
  }
  end.translation().x() -= lowest;
  const Pose below = geometry::Translation(-0.01, 0, 0) * end;
  plan.Start(geometry::Translation(0.003, 0, 0) * end);
  plan.Go(below);
  plan::Strategy strategy = plan.strategy();
  const auto add = [&](const std::string& name, const Vector3& normal, const Vector3& at,
                       double gap) {
    strategy.contacts.push_back({name, normal, at});
    strategy.motions[0].unwanted.push_back(
        {.contact = static_cast<int>(strategy.contacts.size()) - 1,
         .scale = 2,
         .gap = gap,
         .separation = 1});
  };
  for (const int y : {-1, 1}) {
    for (const int z : {-1, 1}) {
      const Vector3 vertex = below * SquareStrategy::Vertex(y, z);
      add(VertexName(y, z), Vector3::UnitX(), vertex - below.translation(), vertex.x() - kMouth);
    }
  }
  add("wall", -Vector3::UnitY(), {0, kHalfWidth, 0}, 0.001);
  strategy.friction = 0.2;
  return strategy;
}

// The torques at the wrist must tell which vertex touches. The engine's contact points are the
// oracle.
TEST_F(MatingTrial, TheContactThatItRunsIntoIsRecognized) {
  RandomStream random(9, "tilts");
  const MatingSetting setting = Setting(kNone, kNone);
  const domain::Mating& mating = problem().mating(setting.mating);
  for (int trial = 0; trial < 6; ++trial) {
    const auto tilt = [&] { return std::copysign(random.Uniform(4, 12), random.Uniform(-1, 1)); };
    const Vector3 tilts = kDegree * Vector3(0, tilt(), tilt());
    const plan::Strategy strategy = ThroughTheFront(setting.X_HeldTip, tilts);
    Pressed pressed;
    MatingTrialOptions options;
    options.law.attempts = 1;
    options.observer = [&](const mujoco::Data& data, int) { pressed(scene(), mating, data); };
    const MatingResult result = RunMatingTrial(problem(), scene(), setting, strategy, options);
    SCOPED_TRACE(testing::Message() << "trial " << trial << ": " << result.end.reason);
    EXPECT_EQ(result.end.outcome, TrialOutcome::kWrongContact);
    ASSERT_TRUE(result.end.recognized);
    EXPECT_FALSE(result.end.recognized->is_loss);
    ASSERT_FALSE(pressed.points.empty());
    const Pose X_FixedTip = result.X_FixedHeld * setting.X_HeldTip;
    for (const int y : {-1, 1}) {
      for (const int z : {-1, 1}) {
        const Vector3 vertex = X_FixedTip * SquareStrategy::Vertex(y, z);
        const bool is_touched = (vertex - pressed.points[0]).norm() < 1e-3;
        EXPECT_EQ(result.end.recognized->name == VertexName(y, z), is_touched);
      }
    }
  }
}

// Returns a motion that brings the lowest vertex of the tilted tip 3 mm into the hole, at 3 mm from
// both walls. With a greater displacement the vertex lands on the front. The plan says that the
// likely error is then 5 mm along y.
plan::Strategy IntoTheCorner(const Pose& X_HeldTip) {
  const Vector3 tilts = Vector3(0, 16, 8) * kDegree;
  const double inside = kHalfWidth + kClearance - 0.003;
  const Pose end = SquareStrategy::VertexAt(tilts, 1, 1, {kMouth - 0.003, inside, kAxis + inside});
  SquareStrategy plan(X_HeldTip);
  plan.Start(geometry::Translation(0.006, 0, 0) * end);
  plan.Contact("vertex on front", Vector3::UnitX(), end.linear() * SquareStrategy::Vertex(1, 1));
  plan.Go(end);
  plan::Strategy strategy = plan.strategy();
  strategy.motions[0].unwanted = {{.contact = 0,
                                   .scale = 2,
                                   .gap = -0.003,
                                   .separation = 1,
                                   .likely = plan::TipError{{0, 0.005, 0}, kNone}}};
  strategy.friction = 0.2;
  return strategy;
}

// The contact with the front does not tell where the hole is. The likely error that the plan states
// for this contact tells it.
TEST_F(MatingTrial, WhatErrorsAreLikelyLeadsOutOfAnErrorState) {
  const MatingSetting setting = Setting({0.001, 0.0045, 0.001}, kNone);
  plan::Strategy strategy = IntoTheCorner(setting.X_HeldTip);
  const MatingResult result = RunMatingTrial(problem(), scene(), setting, strategy);
  EXPECT_EQ(result.end.outcome, TrialOutcome::kSucceeded) << result.end.reason;
  ASSERT_EQ(result.end.recovered.size(), 1U);
  ASSERT_TRUE(result.end.recovered[0].recognized);
  const Vector3 off = (result.X_FixedHeld * setting.X_HeldTip).translation() -
                      strategy.motions[0].X_FixedTip.translation();
  EXPECT_NEAR(off.x(), 0, 2e-4) << "which the front has told";
  EXPECT_NEAR(off.y(), -0.0005, 3e-4) << "5 mm were likely";
  EXPECT_NEAR(off.z(), 0.001, 3e-4) << "which nothing tells";
  strategy.motions[0].unwanted[0].likely.reset();
  const MatingResult without = RunMatingTrial(problem(), scene(), setting, strategy);
  EXPECT_EQ(without.end.outcome, TrialOutcome::kWrongContact);
  EXPECT_EQ(without.end.recovered.size(), 2U) << "in all three attempts";
}

// Returns a slide straight along the hole's axis, without feeling for the walls first.
plan::Strategy SlideOnly(const Pose& X_HeldTip, const Vector3& beside) {
  SquareStrategy plan(X_HeldTip);
  const Vector3 axis = Vector3(0, 0, kAxis) + beside;
  plan.Start(geometry::Translation(axis + Vector3(kMouth + 0.002, 0, 0)));
  plan.Slide(geometry::Translation(axis + Vector3(kSeat, 0, 0)));
  return plan.strategy();
}

// The whole face of the tip meets the block's front 10 mm before the end of the motion.
TEST_F(MatingTrial, AnImpactIsAsHardAsItIsFast) {
  const MatingSetting setting = Setting(kNone, kNone);
  SquareStrategy plan(setting.X_HeldTip);
  const Pose touching = geometry::Translation(kMouth, 0, kAxis - 0.06);
  plan.Start(geometry::Translation(0.003, 0, 0) * touching);
  plan.Go(geometry::Translation(-0.01, 0, 0) * touching);
  MatingTrialOptions options;
  options.law.attempts = 1;
  for (const double speed : {0.0025, 0.005, 0.01}) {
    options.law.free_speed = speed;
    const MatingResult result =
        RunMatingTrial(problem(), scene(), setting, plan.strategy(), options);
    EXPECT_EQ(result.end.outcome, TrialOutcome::kWrongContact) << result.end.reason;
    EXPECT_LT(result.greatest_force, options.law.impact * speed);
  }
}

TEST_F(MatingTrial, BesideTheHoleItJams) {
  const MatingSetting setting = Setting(kNone, kNone);
  const MatingResult result =
      RunMatingTrial(problem(), scene(), setting, SlideOnly(setting.X_HeldTip, {0, 0, 0.005}));
  EXPECT_EQ(result.end.outcome, TrialOutcome::kJammed) << result.end.reason;
  EXPECT_EQ(result.end.holding, Holding::kObstacle) << "it stands on the face";
  EXPECT_EQ(std::ssize(result.end.recovered), ControlLaw().attempts - 1)
      << "it was drawn back, and tried again";
  EXPECT_GT(Depth(result), 0.06);
  EXPECT_LT(result.greatest_force, ControlLaw().GreatestForce());
}

// A tilted shaft touches both walls at a depth of the play over the tilt. It can hold itself there
// if the line between the contacts is in both friction cones. That is the case if the friction is
// greater than the depth over the width (Whitney 1982). Otherwise the shaft can always be drawn
// back.
TEST_F(MatingTrial, WedgesOnlyWithFriction) {
  const double tilt = 2.5 * kDegree;
  const double ratio = 2 * kClearance / tilt / (2 * kHalfWidth);
  const MatingSetting setting = Setting(kNone, {0, tilt, 0});
  const auto mate = [&](double friction) {
    const scene::Scene rough(problem(),
                             {.grasp = scene::GraspMode::kWeld, .part_friction = friction});
    MatingTrialOptions once;
    once.law.attempts = 1;
    const MatingResult result =
        RunMatingTrial(problem(), rough, setting, SlideOnly(setting.X_HeldTip, kNone), once);
    EXPECT_LT(result.greatest_force, ControlLaw().GreatestForce());
    if (result.end.outcome == TrialOutcome::kWedged) {
      EXPECT_EQ(result.end.holding, Holding::kWedge);
    }
    return result.end.outcome;
  };
  ASSERT_GT(1.5, 2 * ratio);
  EXPECT_EQ(mate(1.5), TrialOutcome::kWedged);
  ASSERT_LT(0.02, ratio / 2);
  EXPECT_EQ(mate(0.02), TrialOutcome::kSucceeded);
}

// The whole end of the tip is 2 mm above the block's front and is not turned. Therefore only the
// depth decides whether a trial can begin.
TEST_F(MatingTrial, WithPartsThatOverlapItCannotStart) {
  const Pose X_HeldTip = Setting(kNone, kNone).X_HeldTip;
  SquareStrategy plan(X_HeldTip);
  plan.Start(SquareStrategy::VertexAt(kNone, 1, 1, {kMouth + 0.002, kHalfWidth, kAxis - 0.03}));
  for (const double down : {-0.01, 0.0, 0.0019, 0.0023, 0.01, 0.03}) {
    EXPECT_EQ(CanStart(problem(), Setting({-down, 0, 0}, kNone), plan.strategy()), down < 0.002)
        << down;
  }
  EXPECT_FALSE(CanStart(problem(), Setting({2, 0, 0}, kNone), plan.strategy()))
      << "the arm is not as long as that";
}

bool IsErrorState(TrialOutcome outcome) {
  return outcome == TrialOutcome::kJammed || outcome == TrialOutcome::kWedged ||
         outcome == TrialOutcome::kWrongContact || outcome == TrialOutcome::kTimeout;
}

// The errors are four times those that the strategy is made for. The trial must report how it ends,
// and nothing may be overloaded.
TEST_F(MatingTrial, BeyondItsRangeItEndsInAnErrorState) {
  RandomStream random(5, "beyond the range");
  const char* const asked = std::getenv("ASSAY_MATINGS");  // how many; for a longer test
  for (int trial = 0; trial < (asked == nullptr ? 1 : std::atoi(asked)); ++trial) {
    SCOPED_TRACE(testing::Message() << "trial " << trial << " of seed 5");
    Vector3 d;
    Vector3 w;
    for (double& x : d) x = std::copysign(0.008, random.Uniform(-1, 1));
    for (double& x : w) x = std::copysign(4 * kDegree, random.Uniform(-1, 1));
    d.x() = std::abs(d.x());  // a negative value would make the parts overlap at the start
    const MatingResult result = Insert(problem(), scene(), Setting(d, w));
    EXPECT_EQ(result.end.outcome == TrialOutcome::kSucceeded, std::abs(Depth(result)) < 1e-3);
    EXPECT_NE(result.end.outcome == TrialOutcome::kSucceeded, IsErrorState(result.end.outcome))
        << Name(result.end.outcome) << ": " << result.end.reason;
    EXPECT_LT(result.greatest_force, ControlLaw().GreatestForce());
  }
}

}  // namespace
}  // namespace assay::execution::mating_trial_test
