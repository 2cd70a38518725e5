#include "sim/check/trial_verdicts/ledger.h"

#include <algorithm>
#include <cmath>

#include "planner/base/check.h"
#include "sim/check/measurements/step_events.h"
#include "sim/check/measurements/tolerance_readings.h"
#include "sim/execution/walk/executor.h"
#include "sim/sense/displacement.h"

namespace assay::check {
namespace {

using domain::PartId;
using geometry::Pose;
using noise::Channel;
using noise::Effect;
using sense::Between;
using sense::Displacement;

// The sensor's value was taken over if it differs from the believed one by less than this, in
// metres or radians.
constexpr double kTaken = 1e-9;

struct Reading {
  std::optional<double> applied = {};
  std::optional<double> measured = {};
};

// Returns the index of the displacement's coordinate that an effect changes.
Eigen::Index CoordinateOf(Effect effect) {
  switch (effect) {
    case Effect::kPartX:
    case Effect::kHandX:
    case Effect::kSensedX:
      return 0;
    case Effect::kPartY:
    case Effect::kHandY:
    case Effect::kSensedY:
      return 1;
    case Effect::kTableHeight:
    case Effect::kHandZ:
    case Effect::kSensedZ:
      return 2;
    case Effect::kPartYaw:
    case Effect::kHandYaw:
    case Effect::kSensedYaw:
      return 3;
    case Effect::kClearance:
    case Effect::kFriction:
    case Effect::kPadFriction:
      break;
  }
  ASSAY_CHECK(false, "a tolerance is no displacement");
  return 0;
}

bool IsTolerance(const Channel& channel) {
  return channel.effect == Effect::kClearance || channel.effect == Effect::kFriction ||
         channel.effect == Effect::kPadFriction;
}

std::optional<double> Difference(const std::optional<double>& to,
                                 const std::optional<double>& from) {
  return to && from ? std::optional(*to - *from) : std::nullopt;
}

class Ledger {
 public:
  Ledger(const Experiment& experiment, const noise::Noise& noise, const execution::Trace& trace)
      : experiment_(experiment),
        problem_(experiment.problem),
        noise_(noise),
        scene_(problem_, execution::TrueScene(experiment.scene, noise)),
        start_(execution::StartOf(problem_, scene_, noise)),
        resting_(execution::RestingPoses(problem_, scene_)),
        steps_(EventsByStep(trace)) {
    if (!std::ranges::any_of(noise.box(), IsTolerance)) return;
    const scene::Scene said(problem_, experiment.scene);
    said_ = ReadTolerances(problem_, experiment.plan, said);
    true_ = ReadTolerances(problem_, experiment.plan, scene_);
  }

  std::vector<LedgerEntry> Entries() const {
    std::vector<LedgerEntry> entries;
    for (std::size_t i = 0; i < noise_.box().size(); ++i) {
      const Channel& channel = noise_.box()[i];
      const Reading reading = ReadingOf(channel);
      entries.push_back({.channel = channel,
                         .drawn = noise_.values()[i],
                         .applied = reading.applied,
                         .measured = reading.measured});
    }
    return entries;
  }

 private:
  Reading ReadingOf(const Channel& channel) const {
    switch (channel.effect) {
      case Effect::kPartX:
      case Effect::kPartY:
      case Effect::kPartYaw:
        return OfPart(channel);
      case Effect::kTableHeight:
        return channel.step.IsNone() ? OfTableAtStart(channel) : OfTableAtStep(channel);
      case Effect::kHandX:
      case Effect::kHandY:
      case Effect::kHandZ:
      case Effect::kHandYaw:
        return OfHand(channel);
      case Effect::kSensedX:
      case Effect::kSensedY:
      case Effect::kSensedZ:
      case Effect::kSensedYaw:
        return OfSensor(channel);
      case Effect::kClearance:
        return {Difference(true_.wall, said_.wall), Difference(true_.play, said_.play)};
      case Effect::kFriction:
        return {Difference(true_.part_geom, said_.part_geom),
                Difference(true_.part_contact, said_.part_contact)};
      case Effect::kPadFriction:
        return {Difference(true_.pad_geom, said_.pad_geom),
                Difference(true_.pad_contact, said_.pad_contact)};
    }
    ASSAY_CHECK(false, "an effect that the switch does not know");
    return {};
  }

  // Returns the snapshot in which the tool is poised for the first step. Nothing has been touched
  // before it.
  const execution::Snapshot* FirstSnapshot() const {
    return steps_.empty() ? nullptr : steps_.front().poised;
  }
  const StepEvents* Find(plan::StepId step) const {
    const auto found = std::ranges::find(steps_, step, &StepEvents::step);
    return found == steps_.end() ? nullptr : &*found;
  }

  // Returns the displacement from where the part rests without errors. Measured from there, heights
  // and tilts that the engine itself causes drop out.
  double FromRest(const Channel& channel, const execution::Snapshot& snapshot) const {
    const std::size_t part = channel.part.index();
    return Between(resting_[part], snapshot.parts[part].truth)[CoordinateOf(channel.effect)];
  }

  Reading OfPart(const Channel& channel) const {
    const Pose& said = problem_.part(channel.part).X_WorldPart;
    const Displacement given = Between(said, scene_.TruePose(start_, channel.part));
    Reading reading{.applied = given[CoordinateOf(channel.effect)]};
    if (const execution::Snapshot* first = FirstSnapshot())
      reading.measured = FromRest(channel, *first);
    return reading;
  }

  Reading OfTableAtStart(const Channel& channel) const {
    const execution::Snapshot* first = FirstSnapshot();
    if (first == nullptr) return {};
    return {first->table_heights[channel.part.index()], FromRest(channel, *first)};
  }

  Reading OfTableAtStep(const Channel& channel) const {
    const StepEvents* step = Find(channel.step);
    if (step == nullptr || step->poised == nullptr) return {};
    Reading reading{.applied = step->poised->table_heights[channel.part.index()]};
    const plan::Action& action = experiment_.plan.step(channel.step).action;
    const bool puts_down = action.kind->leaves == domain::Leaves::kAtPlace;
    if (step->end == nullptr || !puts_down) return reading;
    const Pose& truth = step->end->parts[channel.part.index()].truth;
    reading.measured = truth.translation().z() - RestingHeight(channel.part, action.place);
    return reading;
  }

  // Returns the height of the part's origin on this place without errors. The part is alone in the
  // world, so no other part is in its place.
  double RestingHeight(PartId part, const plan::Place& place) const {
    domain::Problem alone = problem_;
    alone.parts = {problem_.part(part)};
    alone.parts.front().X_WorldPart = place.X_WorldPart;
    return execution::RestingPoses(alone, scene::Scene(alone, scene_.options()))
        .front()
        .translation()
        .z();
  }

  Reading OfHand(const Channel& channel) const {
    const StepEvents* step = Find(channel.step);
    if (step == nullptr || step->poised == nullptr) return {};
    const execution::TrueAndBelieved& tool = step->poised->tool;
    const Pose commanded = Pose::Identity();
    const Eigen::Index coordinate = CoordinateOf(channel.effect);
    return {Between(commanded, noise_.HandError(channel.step))[coordinate],
            Between(commanded, tool.believed.inverse() * tool.truth)[coordinate]};
  }

  Reading OfSensor(const Channel& channel) const {
    const StepEvents* step = Find(channel.step);
    if (step == nullptr || step->look == nullptr || !step->look->found) return {};
    const execution::LookRecord& look = *step->look;
    const Eigen::Index coordinate = CoordinateOf(channel.effect);
    Reading reading{.applied = Between(look.measured, look.before.truth)[coordinate]};
    if (step->acted == nullptr) return reading;
    const execution::TrueAndBelieved& part = step->acted->parts[channel.part.index()];
    const bool taken = std::abs(Between(look.measured, part.believed)[coordinate]) < kTaken;
    if (taken) reading.measured = Between(part.believed, part.truth)[coordinate];
    return reading;
  }

  const Experiment& experiment_;
  const domain::Problem& problem_;
  const noise::Noise& noise_;
  const scene::Scene scene_;
  const mujoco::Data start_;
  const std::vector<Pose> resting_;  // by PartId
  const std::vector<StepEvents> steps_;
  ToleranceReadings said_;
  ToleranceReadings true_;
};

}  // namespace

std::vector<LedgerEntry> LedgerOf(const Experiment& experiment, const noise::Noise& noise,
                                  const execution::Trace& trace) {
  return Ledger(experiment, noise, trace).Entries();
}

}  // namespace assay::check
