#include "sim/check/measurements/tolerance_readings.h"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <array>

#include "planner/geometry/pose.h"
#include "sim/execution/walk/executor.h"

namespace assay::check {
namespace {

using domain::Mating;
using domain::PartId;
using geometry::Pose;
using geometry::Vector3;

constexpr double kInside = 0.005;     // metres from the mouth, where the ray starts
constexpr double kOutOfSeat = 0.005;  // metres
constexpr double kFarther = 0.001;  // metres; every play is less than twice the clearance plus this
constexpr double kPrecision = 1e-8;  // metres
// The distance in metres by which the pads are closed further, so that they touch.
constexpr double kSqueezed = 1e-5;

// A wall of a mating hole. The wall is set back by as much as the clearance exceeds its nominal
// value.
struct HoleWall {
  const Mating* mating;
  PartId part;        // the part that has the hole
  Vector3 on_axis;    // a point in the hole, in that part's frame
  Vector3 direction;  // unit, from the axis to the wall
};

std::optional<HoleWall> WallOf(const domain::Problem& problem, const Mating& mating, PartId part,
                               domain::FeatureNumber number) {
  const domain::PartModel& model = *problem.part(part).model;
  const domain::Feature* hole = model.FindFeature(number);
  if (hole == nullptr) return std::nullopt;
  const auto wall = std::ranges::find_if(hole->walls, &domain::Wall::moves_with_clearance);
  if (wall == hole->walls.end()) return std::nullopt;
  return HoleWall{.mating = &mating,
                  .part = part,
                  .on_axis = hole->X_PartFeature * Vector3(0, 0, -kInside),
                  .direction = -model.faces()[wall->face.index()].normal};
}

std::optional<HoleWall> FindWall(const domain::Problem& problem) {
  for (const Mating& mating : problem.matings) {
    for (const auto& [of_held, of_fixed] : mating.features) {
      if (const auto wall = WallOf(problem, mating, mating.held, of_held)) return wall;
      if (const auto wall = WallOf(problem, mating, mating.fixed, of_fixed)) return wall;
    }
  }
  return std::nullopt;
}

// Returns the distance from the axis to the wall by a ray. The ray meets only what is drawn:
// neither supporting solids nor the parts' own tables.
std::optional<double> DistanceTo(const HoleWall& wall, const scene::Scene& scene,
                                 const mujoco::Data& data) {
  const Pose X_WorldPart = scene.TruePose(data, wall.part);
  const Vector3 from = X_WorldPart * wall.on_axis;
  const Vector3 along = X_WorldPart.linear() * wall.direction;
  const std::array<mjtByte, mjNGROUP> groups = {1};
  int geom = -1;
  const double distance =
      mj_ray(data.own_model(), data.get(), from.data(), along.data(), groups.data(), 1, -1, &geom);
  const bool met =
      geom >= 0 && data.own_model()->geom_bodyid[geom] == scene.Body(wall.part).index();
  return met ? std::optional(distance) : std::nullopt;
}

// Returns how far the held part can move to the wall. Nothing is simulated: poses are tested for
// contact.
std::optional<double> PlayTo(const HoleWall& wall, double clearance, const scene::Scene& scene,
                             mujoco::Data& data) {
  const Mating& mating = *wall.mating;
  const Pose X_WorldFixed = scene.TruePose(data, mating.fixed);
  const Pose loose =
      geometry::Translation(-kOutOfSeat * mating.mating_vector.normalized()) * mating.X_FixedHeld;
  // A held part that has the hole moves the other way until its wall is met.
  const Vector3 way = wall.part == mating.fixed
                          ? wall.direction
                          : Vector3(-(mating.X_FixedHeld.linear() * wall.direction));
  const auto touches = [&](double shift) {
    scene.SetPart(data, mating.held, X_WorldFixed * geometry::Translation(shift * way) * loose);
    return scene.Touching(data, mating.held, scene.Body(mating.fixed));
  };
  double free = 0;
  double touching = 2 * clearance + kFarther;
  if (touches(free) || !touches(touching)) return std::nullopt;
  while (touching - free > kPrecision) {
    const double middle = (free + touching) / 2;
    (touches(middle) ? touching : free) = middle;
  }
  return free;
}

struct Friction {
  double of_geom = 0;
  double of_contact = 0;
};

// Returns the friction of the first contact between a geom of `body` and a geom of `other`, or of
// any body if `other` is None.
std::optional<Friction> FrictionAt(const mujoco::Data& data, mujoco::BodyId body,
                                   mujoco::BodyId other) {
  const mjModel& m = *data.own_model();
  for (int c = 0; c < data.get()->ncon; ++c) {
    const mjContact& contact = data.get()->contact[c];
    for (const auto& [geom, met] :
         {std::pair(contact.geom1, contact.geom2), std::pair(contact.geom2, contact.geom1)}) {
      if (m.geom_bodyid[geom] != body.index()) continue;
      if (!other.IsNone() && m.geom_bodyid[met] != other.index()) continue;
      return Friction{m.geom_friction[3 * geom], contact.friction[0]};
    }
  }
  return std::nullopt;
}

const plan::Action* FirstPickup(const plan::Plan& plan) {
  for (const plan::StepId id : plan.ExecutionOrder()) {
    const plan::Action& action = plan.step(id).action;
    if (action.kind->leaves == domain::Leaves::kInHand) return &action;
  }
  return nullptr;
}

std::optional<Friction> PadFriction(const plan::Plan& plan, const scene::Scene& scene,
                                    mujoco::Data& data) {
  const plan::Action* pickup = FirstPickup(plan);
  if (pickup == nullptr) return std::nullopt;
  scene.SetPart(data, pickup->part, scene.ToolPose(data) * pickup->hold.X_PartTool.inverse());
  scene.SetGripper(data, pickup->hold.width - kSqueezed);
  return FrictionAt(data, scene.left_finger(), scene.Body(pickup->part));
}

}  // namespace

ToleranceReadings ReadTolerances(const domain::Problem& problem, const plan::Plan& plan,
                                 const scene::Scene& scene) {
  ToleranceReadings readings;
  mujoco::Data data = execution::StartOf(problem, scene, {});
  if (!problem.parts.empty()) {
    if (const auto part = FrictionAt(data, scene.Body(PartId(0)), mujoco::BodyId::None())) {
      readings.part_geom = part->of_geom;
      readings.part_contact = part->of_contact;
    }
  }
  if (const auto wall = FindWall(problem)) {
    readings.wall = DistanceTo(*wall, scene, data);
    readings.play = PlayTo(*wall, problem.clearance, scene, data);
  }
  if (const auto pad = PadFriction(plan, scene, data)) {
    readings.pad_geom = pad->of_geom;
    readings.pad_contact = pad->of_contact;
  }
  return readings;
}

}  // namespace assay::check
