#pragma once

#include <deque>
#include <functional>
#include <optional>
#include <vector>

#include "planner/uncertainty/preconditions/certify.h"

namespace assay::uncertainty {

using MomentId = Id<struct MomentTag>;

// What is known after each sequence of actions from the beginning of a problem, and which goals are
// not proved on the way: worked out when it is asked for, and once. Plan instances begin alike, and
// so do they with one remedy and with another.
class WorldTree {
 public:
  // The problem must outlive the tree. `learn`: what is found out at the beginning and after each
  // action, without any action of the plan; empty: nothing.
  WorldTree(const domain::Problem& problem, Propagation propagation,
            const algebra::BoundRequest& request, std::function<void(UncertainWorld&)> learn = {});

  MomentId Beginning() const { return MomentId(0); }
  // After one more action; `strategy`: null if it goes straight.
  MomentId After(MomentId before, const plan::Action& action, const plan::Strategy* strategy);

  const UncertainWorld& WorldAt(MomentId moment);
  // Of the action that leads to a moment. All that is unproved is found at once: who asks whether
  // something is, mostly asks what, next.
  const std::vector<Unproved>& UnprovedAt(MomentId moment);
  bool IsProved(MomentId moment) { return UnprovedAt(moment).empty(); }
  // One of these, with the bound that the action's certificate tells.
  Unproved Told(MomentId moment, const Unproved& unproved);

  int size() const { return static_cast<int>(moments_.size()); }  // moments that were asked for

 private:
  struct Moment {
    MomentId before = MomentId::None();
    plan::Action action = {};
    std::optional<plan::Strategy> strategy = {};
    std::vector<MomentId> next = {};
    std::optional<UncertainWorld> world = {};
    std::optional<std::vector<Unproved>> unproved = {};

    const plan::Strategy* way() const { return strategy ? &*strategy : nullptr; }
  };

  Moment& At(MomentId moment) { return moments_[moment.index()]; }
  void Keep(Moment& moment, UncertainWorld world);

  algebra::BoundRequest request_;
  std::function<void(UncertainWorld&)> learn_;
  std::deque<Moment> moments_;  // the beginning first
};

}  // namespace assay::uncertainty
