#include "planner/plan/checker/world_state.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "planner/geometry/pose.h"

namespace assay::plan {
namespace {

constexpr double kAgree = 1e-6;  // metres, and entries of rotation matrices

using domain::Leaves;
using domain::Need;
using Findings = std::vector<std::string>;

class Preconditions {
 public:
  Preconditions(const domain::Problem& problem, const WorldState& state)
      : problem_(problem), state_(state) {}

  Findings Broken(const Action& action) {
    for (const Need need : action.kind->needs) Require(need, action);
    return std::move(findings_);
  }

 private:
  void Require(Need need, const Action& action) {
    const PartId handled = HandledPart(problem_, action);
    switch (need) {
      case Need::kOpenHand:
        return RequireOpenGripper();
      case Need::kHolding:
        return RequireHolding(handled, action.hold);
      case Need::kAtPlace:
        return RequireAt(PlacedPart(problem_, action), action.place);
      case Need::kAlone:
        return RequireNotMated(handled);
      case Need::kFree:
        return RequireNotIn(handled);
      case Need::kSensor:
        return RequireSensor(action.sensor);
    }
  }

  const std::string& NameOf(PartId part) const { return problem_.part(part).name; }

  void RequireOpenGripper() {
    if (state_.in_hand.IsNone()) return;
    findings_.push_back(
        fmt::format("gripper(open) does not hold: the hand holds {}", NameOf(state_.in_hand)));
  }

  void RequireAt(PartId part, const Place& place) {
    const PartState& now = state_.part(part);
    if (now.status == PartStatus::kHeld) {
      findings_.push_back(fmt::format("part_location({0}, {1}) does not hold: {0} is in the hand",
                                      NameOf(part), place.position));
    } else if (!PosesAgree(now.X_WorldPart, place.X_WorldPart)) {
      findings_.push_back(fmt::format(
          "part_location({0}, {1}) does not hold: {0} is at {2}, turned by {3:.4f} degrees from "
          "the step's pose at {4}",
          NameOf(part), place.position, InMillimetres(now.X_WorldPart.translation()),
          geometry::AngleBetween(now.X_WorldPart.linear(), place.X_WorldPart.linear()) * 180 / M_PI,
          InMillimetres(place.X_WorldPart.translation())));
    }
  }

  void RequireNotMated(PartId part) {
    for (MatingId id : state_.assembled) {
      const domain::Mating& mating = problem_.mating(id);
      if (mating.held != part && mating.fixed != part) continue;
      findings_.push_back(fmt::format("{} cannot be taken alone: {} is mated into {}", NameOf(part),
                                      NameOf(mating.held), NameOf(mating.fixed)));
    }
  }

  void RequireSensor(const std::string& sensor) {
    if (std::ranges::find(problem_.sensors, sensor) != problem_.sensors.end()) return;
    findings_.push_back(fmt::format("the sensor {} is none that the problem allows", sensor));
  }

  // A part that sits in another one is not free to be located on the table. A part that has another
  // one in it is free.
  void RequireNotIn(PartId part) {
    if (state_.part(part).status != PartStatus::kMated) return;
    findings_.push_back(
        fmt::format("{} does not lie free: it is mated into another part", NameOf(part)));
  }

  void RequireHolding(PartId part, const Hold& hold) {
    if (state_.in_hand != part) {
      findings_.push_back(
          fmt::format("holding({}, {}) does not hold: the hand {}", NameOf(part), hold.grasp,
                      state_.in_hand.IsNone() ? "is empty" : "holds " + NameOf(state_.in_hand)));
    } else if (!PosesAgree(state_.hold.X_PartTool, hold.X_PartTool) ||
               !(std::abs(state_.hold.width - hold.width) <= kAgree)) {
      findings_.push_back(fmt::format(
          "holding({0}, {1}) does not hold: {0} was taken with {2}, tool at {3} of the part, "
          "{4:.4g} mm wide, not at {5}, {6:.4g} mm wide",
          NameOf(part), hold.grasp, state_.hold.grasp,
          InMillimetres(state_.hold.X_PartTool.translation()), state_.hold.width * 1e3,
          InMillimetres(hold.X_PartTool.translation()), hold.width * 1e3));
    }
  }

  const domain::Problem& problem_;
  const WorldState& state_;
  Findings findings_;
};

}  // namespace

bool PosesAgree(const Pose& a, const Pose& b) {
  return (a.matrix() - b.matrix()).cwiseAbs().maxCoeff() <= kAgree;
}

std::string InMillimetres(const geometry::Vector3& p) {
  return fmt::format("({:.4g}, {:.4g}, {:.4g}) mm", p.x() * 1e3, p.y() * 1e3, p.z() * 1e3);
}

WorldState InitialState(const domain::Problem& problem) {
  WorldState state;
  for (const domain::Part& part : problem.parts) {
    state.parts.push_back({PartStatus::kResting, part.X_WorldPart, StepId::None()});
  }
  state.assembled = problem.assembled;
  for (MatingId id : state.assembled) {
    state.parts[problem.mating(id).held.index()].status = PartStatus::kMated;
  }
  return state;
}

std::vector<std::string> BrokenPreconditions(const domain::Problem& problem,
                                             const WorldState& state, const Action& action) {
  return Preconditions(problem, state).Broken(action);
}

WorldState StateAfter(const domain::Problem& problem, WorldState state, const Action& action,
                      StepId step) {
  const PartId part = HandledPart(problem, action);
  PartState& after = state.parts[part.index()];
  switch (action.kind->leaves) {
    case Leaves::kWhereItWas:  // only the knowledge about the part changes
      return state;
    case Leaves::kInHand:
      after = {PartStatus::kHeld, action.place.X_WorldPart, step};
      state.in_hand = part;
      state.hold = action.hold;
      std::erase_if(state.assembled, [&](MatingId id) { return problem.mating(id).held == part; });
      return state;
    case Leaves::kAtPlace:
      after = {PartStatus::kResting, action.place.X_WorldPart, step};
      state.in_hand = PartId::None();
      return state;
    case Leaves::kMated: {
      const domain::Mating& mating = problem.mating(action.mating);
      after = {PartStatus::kMated, state.part(mating.fixed).X_WorldPart * mating.X_FixedHeld, step};
      state.in_hand = PartId::None();
      state.assembled.push_back(action.mating);
      return state;
    }
  }
  return state;
}

std::vector<WorldState> StatesOf(const domain::Problem& problem, std::span<const Action> actions) {
  std::vector<WorldState> states = {InitialState(problem)};
  for (const Action& action : actions) {
    states.push_back(StateAfter(problem, states.back(), action, StepId::None()));
  }
  return states;
}

}  // namespace assay::plan
