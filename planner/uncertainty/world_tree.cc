#include "planner/uncertainty/world_tree.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "planner/uncertainty/tip_error.h"

namespace assay::uncertainty {
namespace {

bool IsSame(const Pose& a, const Pose& b) { return a.matrix() == b.matrix(); }

bool IsSame(const plan::Place& a, const plan::Place& b) {
  return a.position == b.position && IsSame(a.X_WorldPart, b.X_WorldPart);
}

bool IsSame(const plan::Hold& a, const plan::Hold& b) {
  return std::tie(a.grasp, a.width) == std::tie(b.grasp, b.width) &&
         IsSame(a.X_PartTool, b.X_PartTool);
}

struct SameAction {
  bool operator()(const plan::Pickup& a, const plan::Pickup& b) const {
    return a.part == b.part && IsSame(a.hold, b.hold) && IsSame(a.from, b.from);
  }
  bool operator()(const plan::Putdown& a, const plan::Putdown& b) const {
    return a.part == b.part && IsSame(a.hold, b.hold) && IsSame(a.to, b.to);
  }
  bool operator()(const plan::Assemble& a, const plan::Assemble& b) const {
    return a.mating == b.mating && IsSame(a.hold, b.hold) && IsSame(a.fixed, b.fixed);
  }
  bool operator()(const plan::Sense& a, const plan::Sense& b) const {
    return std::tie(a.part, a.sensor) == std::tie(b.part, b.sensor) && IsSame(a.at, b.at);
  }
  bool operator()(const plan::Squeeze& a, const plan::Squeeze& b) const {
    return a.part == b.part && IsSame(a.hold, b.hold) && IsSame(a.at, b.at);
  }
  bool operator()(const auto&, const auto&) const { return false; }
};

// To the errors: which of them it absorbs, and where it starts and ends.
bool IsSame(const plan::Strategy* a, const plan::Strategy* b) {
  if (a == nullptr || b == nullptr) return a == b;
  const TipWay way = WayOf(*a);
  const TipWay other = WayOf(*b);
  return a->certificate.d == b->certificate.d && a->certificate.w == b->certificate.w &&
         IsSame(way.X_HeldTip, other.X_HeldTip) && IsSame(way.X_FixedStart, other.X_FixedStart) &&
         way.R_FixedEnd == other.R_FixedEnd;
}

}  // namespace

WorldTree::WorldTree(const domain::Problem& problem, Propagation propagation,
                     const algebra::BoundRequest& request,
                     std::function<void(UncertainWorld&)> learn)
    : request_(request), learn_(std::move(learn)) {
  moments_.emplace_back();
  Keep(moments_.front(), UncertainWorld(problem, propagation));
}

void WorldTree::Keep(Moment& moment, UncertainWorld world) {
  if (learn_) learn_(world);
  moment.world = std::move(world);
}

MomentId WorldTree::After(MomentId before, const plan::Action& action,
                          const plan::Strategy* strategy) {
  for (const MomentId known : At(before).next) {
    const Moment& moment = At(known);
    if (std::visit(SameAction{}, moment.action, action) && IsSame(moment.way(), strategy)) {
      return known;
    }
  }
  const MomentId after(moments_.size());
  moments_.push_back({.before = before, .action = action});
  if (strategy != nullptr) At(after).strategy = *strategy;
  At(before).next.push_back(after);
  return after;
}

const UncertainWorld& WorldTree::WorldAt(MomentId id) {
  if (!At(id).world) {
    UncertainWorld world = WorldAt(At(id).before);
    Propagate(world, At(id).action, At(id).way());
    Keep(At(id), std::move(world));
  }
  return *At(id).world;
}

const std::vector<Unproved>& WorldTree::UnprovedAt(MomentId id) {
  if (!At(id).unproved) {
    UncertainWorld world = WorldAt(At(id).before);
    Moment& moment = At(id);
    moment.unproved =
        DecideStep(world, moment.action, request_, Wanted::kAllUnproved, moment.way());
    if (!moment.world) Keep(moment, std::move(world));
  }
  return *At(id).unproved;
}

Unproved WorldTree::Told(MomentId moment, const Unproved& unproved) {
  return AsCertified(unproved, WorldAt(moment), request_);
}

}  // namespace assay::uncertainty
