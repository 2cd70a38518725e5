#include "planner/finemotion/mating.h"

#include <algorithm>

#include "planner/base/check.h"

namespace assay::finemotion {

namespace {

constexpr double kLag = 0.3;  // of a motion's length, by which soft servos may be late

// The contacts of a motion as hybrid control wants them, as they are at its end.
int AddContact(const std::vector<PrimitiveContact>& contacts, const ContactKey& key,
               plan::Strategy& strategy) {
  const PrimitiveContact* contact = Find(contacts, key);
  ASSAY_CHECK(contact != nullptr, "a contact that a motion was checked with");
  strategy.contacts.push_back({Name(*contact), contact->normal, contact->at});
  return static_cast<int>(strategy.contacts.size()) - 1;
}

}  // namespace

Polyhedron OutsideOf(const domain::PartModel& model) {
  std::vector<ConvexPiece> pieces;
  for (const geometry::Box& box : model.boxes()) {
    const auto corners = box.Corners();
    pieces.push_back({{corners.begin(), corners.end()}});
  }
  return OutsideOf(pieces);
}

MatingGeometry GeometryOf(const domain::Problem& problem, const domain::Mating& mating) {
  const domain::PartModel& held = *problem.part(mating.held).model;
  const domain::PartModel& fixed = *problem.part(mating.fixed).model;
  MatingGeometry geometry;
  const domain::Feature* tip = held.FindFeature(mating.features.front().first);
  ASSAY_CHECK(tip != nullptr, "a mating of a feature that the part does not have");
  geometry.X_HeldTip.linear() = mating.X_FixedHeld.linear().transpose();
  geometry.X_HeldTip.translation() = tip->X_PartFeature.translation();
  geometry.X_FixedSeat = mating.X_FixedHeld * geometry.X_HeldTip;
  geometry.critical_points =
      CriticalPoints(OutsideOf(*held.WithClearance(0)), OutsideOf(*fixed.WithClearance(0)),
                     mating.X_FixedHeld, mating.mating_vector);
  geometry.passage.moving = Transformed(OutsideOf(held), geometry.X_HeldTip.inverse());
  geometry.passage.stationary = OutsideOf(fixed);
  geometry.passage.mating = mating.mating_vector.normalized();
  const Pose& entry = geometry.critical_points.empty()
                          ? mating.X_FixedHeld
                          : geometry.critical_points.front().X_StationaryMoving;
  geometry.passage.X_StationaryEntry = entry * geometry.X_HeldTip;
  return geometry;
}

LocalTopology TopologyOf(const Passage& passage) {
  constexpr double kReach = 0.003;  // metres
  LocalTopology topology{
      {PrimitiveContacts(passage.moving, passage.stationary, passage.X_StationaryEntry, kReach)},
      {}};
  ContactGraphOptions options;
  for (const PrimitiveContact& contact : topology.space.contacts)
    options.radius = std::max(options.radius, contact.at.norm());
  topology.graph = MakeContactGraph(topology.space, options);
  return topology;
}

plan::Strategy StrategyOf(const MatingGeometry& geometry, const FineMotionPlan& plan) {
  plan::Strategy strategy{.X_HeldTip = geometry.X_HeldTip,
                          .X_FixedStart = plan.X_StationaryStart,
                          .contacts = {},
                          .motions = {}};
  for (const CertainMotion& motion : plan.motions) {
    plan::StrategyMotion out;
    out.X_FixedTip = motion.X_StationaryAfter;
    for (const ContactKey& key : motion.command.kept) {
      out.kept.push_back(AddContact(motion.contacts, key, strategy));
    }
    if (motion.command.until) {
      out.until = AddContact(motion.contacts, *motion.command.until, strategy);
      out.beyond = motion.check.longest - 1 + kLag;
    }
    strategy.motions.push_back(std::move(out));
  }
  strategy.motions.push_back(
      {.kept = {}, .X_FixedTip = geometry.X_FixedSeat, .until = {}, .beyond = 0, .slides = true});
  return strategy;
}

}  // namespace assay::finemotion
