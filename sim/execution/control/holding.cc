#include "sim/execution/control/holding.h"

#include <algorithm>

#include "planner/finemotion/forces/force_signature.h"
#include "sim/mujoco/contact.h"

namespace assay::execution {
namespace {

// Fraction of a push that the normal of an opposing contact takes back.
constexpr double kAgainst = 0.3;

}  // namespace

std::string_view Name(Holding holding) {
  switch (holding) {
    case Holding::kNothing:
      return "nothing";
    case Holding::kObstacle:
      return "obstacle";
    case Holding::kJam:
      return "jam";
    case Holding::kWedge:
      return "wedge";
  }
  return "";
}

Holding HoldingOf(const std::vector<plan::StrategyContact>& contacts, const geometry::Vector3& way,
                  double friction, double length) {
  const bool is_opposed = std::ranges::any_of(contacts, [&](const plan::StrategyContact& contact) {
    return contact.normal.dot(way) < -kAgainst;
  });
  if (is_opposed) return Holding::kObstacle;
  const auto signature = finemotion::SignatureOf(contacts, friction);
  if (finemotion::Wedges(signature, length)) return Holding::kWedge;
  finemotion::Wrench push = finemotion::Wrench::Zero();
  push.head<3>() = way;
  return finemotion::Jams(signature, push, length) ? Holding::kJam : Holding::kNothing;
}

Holding TrueHolding(Execution& execution, PartId fixed, const Pose& X_HeldTip,
                    const geometry::Vector3& way, double length) {
  const scene::Scene& scene = execution.scene();
  const PartId held = execution.world().held();
  const Pose X_FixedWorld = scene.TruePose(execution.data(), fixed).inverse();
  const geometry::Vector3 tip =
      X_FixedWorld * scene.TruePose(execution.data(), held) * X_HeldTip.translation();
  std::vector<plan::StrategyContact> contacts;
  double friction = 0;
  for (const mujoco::Contact& contact :
       mujoco::ContactsBetween(execution.data(), scene.Body(fixed), scene.Body(held))) {
    if (contact.distance > 0) continue;
    friction = std::max(friction, contact.friction);
    contacts.push_back(
        {"", X_FixedWorld.linear() * contact.normal, X_FixedWorld * contact.position - tip});
  }
  return HoldingOf(contacts, way, friction, length);
}

}  // namespace assay::execution
