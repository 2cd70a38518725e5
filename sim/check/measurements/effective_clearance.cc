#include "sim/check/measurements/effective_clearance.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "planner/domain/matings/shaft_fit.h"
#include "planner/geometry/pose.h"
#include "planner/geometry/solids/mass_properties.h"
#include "sim/scene/scene.h"

namespace assay::check {
namespace {

using domain::Mating;
using domain::Problem;
using geometry::Pose;
using geometry::Vector3;

constexpr double kPush = 5;  // m/s^2; the force is this times the part's mass
// The damping divided by the part's mass, in 1/s.
constexpr double kDamping = 1000;
constexpr double kSpeed = kPush / kDamping;  // m/s, of a part that nothing stops
constexpr double kStill = 1e-7;              // m/s
constexpr int kStillSteps = 20;
constexpr std::size_t kEveryDirection = std::numeric_limits<std::size_t>::max();
// The unmodified engine searches longer for the contacts of meshes.
constexpr std::size_t kExportedDirections = 4;
constexpr double kSettling = 4;  // seconds to come to rest at a wall

// The pose at which the fixed part is held, in the air beside the arm.
const Pose kX_WorldFixed = geometry::Translation(0.6, 0.7, 0.9);

// A simulation with the two parts of a mating in their mated pose. The fixed part is held fast, and
// the held part has a free joint.
struct MatedPair {
  mujoco::Data data;
  mujoco::BodyId fixed;
  mujoco::BodyId held;
  int dof = 0;  // first index of the free joint in qvel
  void (*step)(mujoco::Data&) = [](mujoco::Data& stepped) { stepped.Step(); };
};

MatedPair PairIn(mujoco::Data data, const std::string& fixed, const std::string& held) {
  const mujoco::Model model = data.model();
  return {std::move(data), model.Body(fixed), model.Body(held),
          model.DofAddress(model.Joint(held))};
}

// The fixed part is welded to the resting hand. This weld holds the part as firmly as a weld to the
// world would.
MatedPair PairInScene(const Problem& problem, const Mating& mating) {
  const scene::Scene scene(problem, {.grasp = scene::GraspMode::kWeld});
  mujoco::Data data = scene.Start();
  scene.SetPart(data, mating.fixed, kX_WorldFixed);
  scene.SetPart(data, mating.held, kX_WorldFixed * mating.X_FixedHeld);
  scene.AttachPart(data, mating.fixed);
  return PairIn(std::move(data), "part/" + problem.part(mating.fixed).name,
                "part/" + problem.part(mating.held).name);
}

MatedPair PairInFile(const Problem& problem, const Mating& mating, const std::string& mjcf) {
  mujoco::Data data(mujoco::Model::FromMjcf(mjcf));
  data.Forward();
  MatedPair pair =
      PairIn(std::move(data), problem.part(mating.fixed).name, problem.part(mating.held).name);
  pair.step = [](mujoco::Data& stepped) { stepped.StepUnmodified(); };
  return pair;
}

class PlayMeasurement {
 public:
  PlayMeasurement(const Problem& problem, const Mating& mating, const domain::ShaftFit& fit,
                  MatedPair pair)
      : problem_(problem),
        mating_(mating),
        middle_(Middle(fit, mating)),
        pair_(std::move(pair)),
        start_(pair_.data.Save()) {}

  double PlayAlong(const domain::FitGap& gap) {
    const Vector3& axis = gap.across;
    return Stop(axis, gap.high).dot(axis) - Stop(-axis, gap.low).dot(axis);
  }

 private:
  // Returns the middle between the tip of the shaft and the mouth of the hole, in the held part's
  // frame.
  static Vector3 Middle(const domain::ShaftFit& fit, const Mating& mating) {
    const Vector3 tip = fit.X_HoleShaft * fit.shaft.X_PartFeature.translation();
    const Vector3 in_hole = (tip + fit.hole.X_PartFeature.translation()) / 2;
    return fit.shaft_is_held ? mating.X_FixedHeld.inverse() * in_hole : in_hole;
  }

  // Returns where the middle comes to a stop when it is pushed in that direction, in the fixed
  // part's frame. `way` is the distance in metres at which a wall is expected.
  Vector3 Stop(const Vector3& direction_Fixed, double way) {
    mujoco::Data& data = pair_.data;
    data.Restore(start_);
    const double longest = kSettling + 2 * way / kSpeed;
    int still = 0;
    while (still < kStillSteps && data.time() < start_.time + longest) {
      Push(data.BodyPose(pair_.fixed).linear() * direction_Fixed);
      pair_.step(data);
      still = RateAt(0).norm() < kStill ? still + 1 : 0;
    }
    return data.BodyPose(pair_.fixed).inverse() * (data.BodyPose(pair_.held) * middle_);
  }

  // Returns three entries of qvel from this one of the free joint on: the velocity of the held
  // part's origin (0), or its angular velocity in its own frame (3).
  Vector3 RateAt(int entry) const {
    return Vector3::Map(pair_.data.qvel().data() + pair_.dof + entry);
  }

  // Sets the generalized forces of the free joint: a force at the part's origin in the world frame,
  // and a torque about the origin in the part's frame. These forces cancel the weight, damp the
  // motion and push. The damping of the centre's motion acts at the middle, like the push: the two
  // are equal while the part moves, and would tilt it if they acted at different points.
  void Push(const Vector3& direction_World) {
    const geometry::MassProperties& mass = problem_.part(mating_.held).model->mass();
    const geometry::Matrix3 R = pair_.data.BodyPose(pair_.held).linear();
    const Vector3 angular = R * RateAt(3);
    const Vector3 velocity = RateAt(0) + angular.cross(R * mass.center);
    const Vector3 at_center = mass.mass * Vector3(0, 0, scene::kGravity);
    const Vector3 at_middle = mass.mass * (kPush * direction_World - kDamping * velocity);
    const Vector3 force = at_center + at_middle;
    const Vector3 torque = mass.center.cross(R.transpose() * at_center) +
                           middle_.cross(R.transpose() * at_middle) -
                           kDamping * mass.inertia * R.transpose() * angular;
    for (int i = 0; i < 3; ++i) {
      pair_.data.qfrc_applied()[pair_.dof + i] = force[i];
      pair_.data.qfrc_applied()[pair_.dof + 3 + i] = torque[i];
    }
  }

  const Problem& problem_;
  const Mating& mating_;
  Vector3 middle_;
  MatedPair pair_;
  mujoco::State start_;
};

// Returns the play between pairs of walls, in at most `most` directions that are spread evenly.
// `pair` makes the simulation, only if there is a pair of walls.
std::vector<Play> PlaysOf(const Problem& problem, const Mating& mating, std::size_t most,
                          const std::function<MatedPair()>& pair) {
  const std::vector<domain::ShaftFit> fits = domain::FitsOf(problem, mating);
  if (fits.empty()) return {};
  PlayMeasurement measurement(problem, mating, fits.front(), pair());
  std::vector<Play> plays;
  const std::vector<domain::FitGap> gaps = domain::GapsOf(problem, mating);
  const std::size_t count = std::min(most, gaps.size());
  for (std::size_t i = 0; i < count; ++i) {
    const domain::FitGap& gap = gaps[i * gaps.size() / count];
    plays.push_back({.axis = gap.across,
                     .nominal = gap.low + gap.high,
                     .measured = measurement.PlayAlong(gap)});
  }
  return plays;
}

}  // namespace

double Play::RelativeDifference() const { return (measured - nominal) / nominal; }

std::vector<Play> EffectiveClearance(const Problem& problem, domain::MatingId id) {
  const Mating& mating = problem.mating(id);
  return PlaysOf(problem, mating, kEveryDirection, [&] { return PairInScene(problem, mating); });
}

std::vector<Play> ExportedClearance(const Problem& problem, domain::MatingId id,
                                    const std::string& mjcf) {
  const Mating& mating = problem.mating(id);
  return PlaysOf(problem, mating, kExportedDirections,
                 [&] { return PairInFile(problem, mating, mjcf); });
}

}  // namespace assay::check
