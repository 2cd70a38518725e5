#include "sim/check/effective_clearance.h"

#include <cmath>

#include "planner/base/check.h"
#include "sim/scene/scene.h"

namespace assay::check {
namespace {

using domain::Mating;
using domain::Problem;
using geometry::Pose;
using geometry::Vector3;

constexpr double kPush = 5;        // m/s^2 times the part's mass
constexpr double kDamping = 1000;  // 1/s times the part's mass, so that it moves at 5 mm/s
constexpr double kStill = 1e-7;    // m/s
constexpr int kStillSteps = 20;
constexpr double kLongest = 5;  // seconds, 25 mm of way

// Where the fixed part is held, in the air beside the arm.
const Pose kX_WorldFixed = geometry::Translation(0.6, 0.7, 0.9);

class PlayMeasurement {
 public:
  PlayMeasurement(const Problem& problem, const Mating& mating)
      : problem_(problem),
        mating_(mating),
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

  double PlayAlong(const Vector3& axis_Fixed) {
    return Stop(axis_Fixed).dot(axis_Fixed) - Stop(-axis_Fixed).dot(axis_Fixed);
  }

 private:
  // The middle between the tip of the shaft and the mouth of the hole, in the held part.
  Vector3 Middle() const {
    const auto& [of_held, of_fixed] = mating_.features.front();
    const domain::Feature* shaft = problem_.part(mating_.held).model->FindFeature(of_held);
    const domain::Feature* hole = problem_.part(mating_.fixed).model->FindFeature(of_fixed);
    ASSAY_CHECK(shaft != nullptr && hole != nullptr);
    return (shaft->X_PartFeature.translation() +
            mating_.X_FixedHeld.inverse() * Vector3(hole->X_PartFeature.translation())) /
           2;
  }

  // Where the middle comes to a stop when pushed that way, in the fixed part.
  Vector3 Stop(const Vector3& direction_Fixed) {
    data_.Restore(start_);
    const Vector3 middle = Middle();
    int still = 0;
    while (still < kStillSteps && data_.time() < start_.time + kLongest) {
      Push(scene_.TruePose(data_, mating_.fixed).linear() * direction_Fixed, middle);
      data_.Step();
      const bool is_still = scene_.TrueTwist(data_, mating_.held).linear.norm() < kStill;
      still = is_still ? still + 1 : 0;
    }
    return scene_.TruePose(data_, mating_.fixed).inverse() *
           (scene_.TruePose(data_, mating_.held) * middle);
  }

  // Generalized forces of the free joint: a force at the part's origin in the world, a torque about
  // it in the part. Weight is taken away, motion damped.
  void Push(const Vector3& direction_World, const Vector3& middle) {
    const geometry::MassProperties& mass = problem_.part(mating_.held).model->mass();
    const geometry::Matrix3 R = scene_.TruePose(data_, mating_.held).linear();
    const scene::Twist twist = scene_.TrueTwist(data_, mating_.held);
    const Vector3 at_center =
        mass.mass * (Vector3(0, 0, scene::kGravity) - kDamping * twist.linear);
    const Vector3 at_middle = mass.mass * kPush * direction_World;
    const Vector3 force = at_center + at_middle;
    const Vector3 torque = mass.center.cross(R.transpose() * at_center) +
                           middle.cross(R.transpose() * at_middle) -
                           kDamping * mass.inertia * R.transpose() * twist.angular;
    for (int i = 0; i < 3; ++i) {
      data_.qfrc_applied()[dof_ + i] = force[i];
      data_.qfrc_applied()[dof_ + 3 + i] = torque[i];
    }
  }

  const Problem& problem_;
  const Mating& mating_;
  scene::Scene scene_;
  mujoco::Data data_;
  mujoco::State start_;
  int dof_ = 0;
};

}  // namespace

double Play::RelativeDifference() const { return (measured - nominal) / nominal; }

std::array<Play, 2> EffectiveClearance(const Problem& problem, domain::MatingId id) {
  const Mating& mating = problem.mating(id);
  const domain::Feature* hole =
      problem.part(mating.fixed).model->FindFeature(mating.features.front().second);
  ASSAY_CHECK(hole != nullptr);
  PlayMeasurement measurement(problem, mating);
  std::array<Play, 2> plays = {};
  for (int i = 0; i < 2; ++i) {
    plays[static_cast<std::size_t>(i)].axis = hole->X_PartFeature.linear().col(i);
    plays[static_cast<std::size_t>(i)].nominal = 2 * problem.clearance;
    plays[static_cast<std::size_t>(i)].measured =
        measurement.PlayAlong(plays[static_cast<std::size_t>(i)].axis);
  }
  return plays;
}

}  // namespace assay::check
