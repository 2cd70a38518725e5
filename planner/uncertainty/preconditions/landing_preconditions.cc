#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "planner/algebra/expression/simplify.h"
#include "planner/domain/parts/part_model.h"
#include "planner/domain/resting/resting.h"
#include "planner/geometry/collision.h"
#include "planner/uncertainty/error_sets/release.h"
#include "planner/uncertainty/preconditions/precondition.h"

namespace assay::uncertainty {
namespace {

using geometry::Polygon;
using geometry::Vector2;

constexpr double kSupportLayer = 1e-6;  // metres above the lowest vertex of a part that rests

// Returns the vertices of the face that will rest on the table.
std::vector<Vector3> SupportVertices(const domain::PartModel& model, const Pose& X_WorldPart) {
  const auto height = [&](const Vector3& v) { return (X_WorldPart * v).z(); };
  const std::vector<Vector3>& vertices = model.corners();
  const double lowest = height(*std::ranges::min_element(vertices, {}, height));
  std::vector<Vector3> support;
  std::ranges::copy_if(vertices, std::back_inserter(support),
                       [&](const Vector3& v) { return height(v) < lowest + kSupportLayer; });
  return support;
}

// A direction in which two footprints lie one behind the other.
struct Separation {
  Vector2 direction;  // unit, from the first to the second
  double gap = 0;     // metres; negative if they overlap
};

double FarthestAlong(const Vector2& direction, const Polygon& polygon) {
  double farthest = -std::numeric_limits<double>::infinity();
  for (const Vector2& p : polygon) farthest = std::max(farthest, direction.dot(p));
  return farthest;
}

// Returns the direction with the widest gap among the normals of the edges of both polygons.
Separation BestSeparation(const Polygon& a, const Polygon& b) {
  Separation best = {.direction = Vector2::UnitX(),
                     .gap = -std::numeric_limits<double>::infinity()};
  const auto consider = [&](const Polygon& polygon, double sense) {
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vector2 edge = polygon[(i + 1) % polygon.size()] - polygon[i];
      const Vector2 direction = sense * Vector2(edge.y(), -edge.x()).normalized();
      const double gap = -FarthestAlong(-direction, b) - FarthestAlong(direction, a);
      if (gap > best.gap) best = {direction, gap};
    }
  };
  consider(a, 1);
  consider(b, -1);
  return best;
}

Expression AlongTable(const Vector2& direction, const SymbolicVector& p) {
  return direction.x() * p[0] + direction.y() * p[1];
}

// The possible pose of a part, and the greatest distance of any of its points from its planned
// place.
struct PossiblePart {
  Transform pose;
  double greatest_shift = 0;  // metres, in the plane of the table
};

class LandingConditions {
 public:
  LandingConditions(const UncertainWorld& world, PartId part, const plan::Hold& hold,
                    const Transform& X_ToolGrasp, const Pose& X_WorldPart,
                    const RestingError& released)
      : world_(world),
        part_(part),
        model_(*world.problem().part(part).model),
        X_WorldPart_(X_WorldPart),
        landing_(algebra::Simplify(
            PossibleHeldPose(X_WorldPart * hold.X_PartTool, X_ToolGrasp, hold.X_PartTool))) {
    stages_.push_back(InHand());
    if (!ComesUpright(world, hold, X_WorldPart)) {
      stages_.push_back(Resting(part, X_WorldPart, released));
    }
  }

  void RequireHeight(const Expression& table) {
    const double travel = world_.problem().workcell->rules().guarded_travel;
    for (const Vector3& vertex : SupportVertices(model_, X_WorldPart_)) {
      conditions_.Within(plan::condition::kLandingHeight,
                         "the part meets the table within the guarded travel",
                         (landing_ * AsVector(vertex))[2] - table, travel);
    }
  }

  void RequireOnTable() {
    const Polygon& top =
        domain::TableUnder(*world_.problem().workcell, world_.problem().part(part_), X_WorldPart_)
            .top;
    for (std::size_t i = 0; i < top.size(); ++i) {
      const Vector2 edge = top[(i + 1) % top.size()] - top[i];
      const Vector2 outward = Vector2(edge.y(), -edge.x()).normalized();
      for (const PossiblePart& stage : stages_) {
        for (const Vector3& vertex : SupportVertices(model_, X_WorldPart_)) {
          conditions_.Less(plan::condition::kFootprint, "the part comes to stand on the table",
                           AlongTable(outward, stage.pose * AsVector(vertex)), outward.dot(top[i]));
        }
      }
    }
  }

  void RequireClearOf(PartId neighbour) {
    const domain::Part& other = world_.problem().part(neighbour);
    const Pose& X_WorldOther = world_.X_WorldPart(neighbour);
    const Separation separation =
        BestSeparation(domain::Footprint(world_.problem().part(part_), X_WorldPart_),
                       domain::Footprint(other, X_WorldOther));
    const PossiblePart possible_other =
        Resting(neighbour, X_WorldOther, world_.about_plan(neighbour));
    for (const PossiblePart& stage : stages_) {
      const double reach = stage.greatest_shift + possible_other.greatest_shift;
      if (separation.gap > reach) continue;  // proved: no error is that great
      RequireApart(stage, neighbour, possible_other, separation.direction);
    }
  }

  std::vector<Precondition> Take() { return conditions_.Take(); }

 private:
  // Requires a gap between each pair of vertices that may come to lie side by side.
  void RequireApart(const PossiblePart& possible, PartId neighbour,
                    const PossiblePart& possible_other, const Vector2& along) {
    const domain::Part& other = world_.problem().part(neighbour);
    const Pose& X_WorldOther = world_.X_WorldPart(neighbour);
    const double reach = possible.greatest_shift + possible_other.greatest_shift;
    const auto nominal = [&](const Pose& X, const Vector3& v) {
      return along.dot((X * v).head<2>());
    };
    for (const Vector3& v : model_.corners()) {
      for (const Vector3& w : other.model->corners()) {
        if (nominal(X_WorldOther, w) - nominal(X_WorldPart_, v) > reach) continue;
        conditions_.Less(plan::condition::kNeighbourClear,
                         fmt::format("the part stays clear of {}", other.name),
                         AlongTable(along, possible.pose * AsVector(v)) -
                             AlongTable(along, possible_other.pose * AsVector(w)),
                         0, neighbour);
      }
    }
  }

  PossiblePart InHand() const {
    const SymbolicVector displacement =
        landing_.translation - AsTransform(X_WorldPart_).translation;
    const HeldError& held = world_.held();
    double angle = Magnitude(world_.problem().gripper_error.theta);
    for (const Expression* turned : {&held.skew, &held.tip, &held.twist}) {
      angle += Magnitude(world_.RangeOf(*turned));
    }
    return {landing_, GreatestShift(displacement, model_, angle)};
  }

  PossiblePart Resting(PartId part, const Pose& X_WorldPart, const RestingError& error) const {
    return {PossiblePose(X_WorldPart, error),
            GreatestShift(error.displacement, *world_.problem().part(part).model,
                          Magnitude(world_.RangeOf(error.theta)))};
  }

  double GreatestShift(const SymbolicVector& displacement, const domain::PartModel& model,
                       double angle) const {
    return std::hypot(Magnitude(world_.RangeOf(displacement[0])),
                      Magnitude(world_.RangeOf(displacement[1]))) +
           model.shape().radius() * angle;
  }

  const UncertainWorld& world_;
  PartId part_;
  const domain::PartModel& model_;
  const Pose& X_WorldPart_;
  Transform landing_;  // possible pose of the part in the hand, where the hand is to let it go
  std::vector<PossiblePart> stages_;
  Preconditions conditions_;
};

}  // namespace

std::vector<Precondition> LandingPreconditions(const UncertainWorld& world, PartId part,
                                               const plan::Hold& hold, const Transform& X_ToolGrasp,
                                               const Pose& X_WorldPart, const Expression& table,
                                               const RestingError& released) {
  LandingConditions conditions(world, part, hold, X_ToolGrasp, X_WorldPart, released);
  conditions.RequireHeight(table);
  conditions.RequireOnTable();
  for (int p = 0; p < static_cast<int>(world.problem().parts.size()); ++p) {
    if (PartId(p) != part) conditions.RequireClearOf(PartId(p));
  }
  return conditions.Take();
}

}  // namespace assay::uncertainty
