#include "sim/check/measurements/effective_clearance.h"

#include <cmath>

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
constexpr double kSettling = 4;  // seconds to come to rest at a wall

// The pose at which the fixed part is held, in the air beside the arm.
const Pose kX_WorldFixed = geometry::Translation(0.6, 0.7, 0.9);

class PlayMeasurement {
 public:
  PlayMeasurement(const Problem& problem, const Mating& mating, const domain::ShaftFit& fit)
      : problem_(problem),
        mating_(mating),
        middle_(Middle(fit, mating)),
        scene_(problem, {.grasp = scene::GraspMode::kWeld}),
        data_(scene_.Start()) {
    const mujoco::Model& model = scene_.model();
    dof_ = model.DofAddress(model.Joint("part/" + problem.part(mating.held).name));
    scene_.SetPart(data_, mating.fixed, kX_WorldFixed);
    scene_.SetPart(data_, mating.held, kX_WorldFixed * mating.X_FixedHeld);
    // A weld to the resting hand holds it as well as one to the world.
    scene_.AttachPart(data_, mating.fixed);
    start_ = data_.Save();
  }

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
    data_.Restore(start_);
    const double longest = kSettling + 2 * way / kSpeed;
    int still = 0;
    while (still < kStillSteps && data_.time() < start_.time + longest) {
      Push(scene_.TruePose(data_, mating_.fixed).linear() * direction_Fixed);
      data_.Step();
      const bool is_still = scene_.TrueTwist(data_, mating_.held).linear.norm() < kStill;
      still = is_still ? still + 1 : 0;
    }
    return scene_.TruePose(data_, mating_.fixed).inverse() *
           (scene_.TruePose(data_, mating_.held) * middle_);
  }

  // Sets the generalized forces of the free joint: a force at the part's origin in the world frame,
  // and a torque about the origin in the part's frame. These forces cancel the weight, damp the
  // motion and push. The damping of the centre's motion acts at the middle, like the push: the two
  // are equal while the part moves, and would tilt it if they acted at different points.
  void Push(const Vector3& direction_World) {
    const geometry::MassProperties& mass = problem_.part(mating_.held).model->mass();
    const geometry::Matrix3 R = scene_.TruePose(data_, mating_.held).linear();
    const scene::Twist twist = scene_.TrueTwist(data_, mating_.held);
    const Vector3 velocity = twist.linear + twist.angular.cross(R * mass.center);
    const Vector3 at_center = mass.mass * Vector3(0, 0, scene::kGravity);
    const Vector3 at_middle = mass.mass * (kPush * direction_World - kDamping * velocity);
    const Vector3 force = at_center + at_middle;
    const Vector3 torque = mass.center.cross(R.transpose() * at_center) +
                           middle_.cross(R.transpose() * at_middle) -
                           kDamping * mass.inertia * R.transpose() * twist.angular;
    for (int i = 0; i < 3; ++i) {
      data_.qfrc_applied()[dof_ + i] = force[i];
      data_.qfrc_applied()[dof_ + 3 + i] = torque[i];
    }
  }

  const Problem& problem_;
  const Mating& mating_;
  Vector3 middle_;
  scene::Scene scene_;
  mujoco::Data data_;
  mujoco::State start_;
  int dof_ = 0;
};

}  // namespace

double Play::RelativeDifference() const { return (measured - nominal) / nominal; }

std::vector<Play> EffectiveClearance(const Problem& problem, domain::MatingId id) {
  const Mating& mating = problem.mating(id);
  const std::vector<domain::ShaftFit> fits = domain::FitsOf(problem, mating);
  if (fits.empty()) return {};
  PlayMeasurement measurement(problem, mating, fits.front());
  std::vector<Play> plays;
  for (const domain::FitGap& gap : domain::GapsOf(problem, mating)) {
    plays.push_back({.axis = gap.across,
                     .nominal = gap.low + gap.high,
                     .measured = measurement.PlayAlong(gap)});
  }
  return plays;
}

}  // namespace assay::check
