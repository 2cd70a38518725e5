#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "planner/algebra/simplify.h"
#include "planner/domain/part_model.h"
#include "planner/domain/resting.h"
#include "planner/uncertainty/precondition.h"

namespace assay::uncertainty {
namespace {

using geometry::Polygon;
using geometry::Vector2;

constexpr double kSupportLayer = 1e-6;  // metres above the lowest vertex of a part that rests

// The vertices of the face that will rest on the table.
std::vector<Vector3> SupportVertices(const domain::PartModel& model, const Pose& X_WorldPart) {
  const auto height = [&](const Vector3& v) { return (X_WorldPart * v).z(); };
  const std::vector<Vector3>& vertices = model.hull().vertices;
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

// Among the normals of the edges of both, the one with the widest gap.
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

Expression Along(const Vector2& direction, const SymbolicVector& p) {
  return direction.x() * p[0] + direction.y() * p[1];
}

class LandingConditions {
 public:
  LandingConditions(const UncertainWorld& world, PartId part, const plan::Hold& hold,
                    const Transform& X_ToolGrasp, const Pose& X_WorldPart)
      : world_(world),
        part_(part),
        model_(*world.problem().part(part).model),
        X_WorldPart_(X_WorldPart),
        possible_(algebra::Simplify(
            PossibleHeldPose(X_WorldPart * hold.X_PartTool, X_ToolGrasp, hold.X_PartTool))) {}

  void RequireHeight(const Expression& table) {
    const double travel = world_.problem().workcell->rules().guarded_travel;
    for (const Vector3& vertex : SupportVertices(model_, X_WorldPart_)) {
      conditions_.Within("landing height", "the part meets the table on the guarded way",
                         At(vertex)[2] - table, travel);
    }
  }

  void RequireOnTable() {
    const Polygon& top = world_.problem().workcell->table().top;
    for (const Vector3& vertex : SupportVertices(model_, X_WorldPart_)) {
      for (std::size_t i = 0; i < top.size(); ++i) {
        const Vector2 edge = top[(i + 1) % top.size()] - top[i];
        const Vector2 outward = Vector2(edge.y(), -edge.x()).normalized();
        conditions_.Less("footprint", "the part comes to stand on the table",
                         Along(outward, At(vertex)), outward.dot(top[i]));
      }
    }
  }

  void RequireClearOf(PartId neighbour) {
    const domain::Part& other = world_.problem().part(neighbour);
    const Pose& X_WorldOther = world_.X_WorldPart(neighbour);
    const Separation separation =
        BestSeparation(domain::Footprint(world_.problem().part(part_), X_WorldPart_),
                       domain::Footprint(other, X_WorldOther));
    const double reach = GreatestShift() + GreatestShiftOf(neighbour);
    if (separation.gap > reach) return;  // proved: no error is as great
    const Transform possible_other =
        PossiblePose(X_WorldOther, world_.resting_about_plan(neighbour));
    const std::string meaning = fmt::format("the part stays clear of {}", other.name);
    const Vector2& along = separation.direction;
    const auto nominal = [&](const Pose& X, const Vector3& v) {
      return along.dot((X * v).head<2>());
    };
    for (const Vector3& v : model_.hull().vertices) {
      for (const Vector3& w : other.model->hull().vertices) {
        if (nominal(X_WorldOther, w) - nominal(X_WorldPart_, v) > reach) continue;
        conditions_.Less("neighbour clear", meaning,
                         Along(along, At(v)) - Along(along, possible_other * AsVector(w)), 0);
      }
    }
  }

  std::vector<Precondition> Take() { return conditions_.Take(); }

 private:
  SymbolicVector At(const Vector3& vertex) const { return possible_ * AsVector(vertex); }

  // How far any vertex of the part may be from where it should come.
  double GreatestShift() const {
    const SymbolicVector displacement =
        possible_.translation - AsTransform(X_WorldPart_).translation;
    const double angle = Magnitude(world_.problem().gripper_error.theta) +
                         Magnitude(world_.RangeOf(world_.held().twist));
    return std::hypot(Magnitude(world_.RangeOf(displacement[0])),
                      Magnitude(world_.RangeOf(displacement[1]))) +
           model_.shape().radius() * angle;
  }

  double GreatestShiftOf(PartId neighbour) const {
    const RestingError& error = world_.resting_about_plan(neighbour);
    return std::hypot(Magnitude(world_.RangeOf(error.displacement[0])),
                      Magnitude(world_.RangeOf(error.displacement[1]))) +
           world_.problem().part(neighbour).model->shape().radius() *
               Magnitude(world_.RangeOf(error.theta));
  }

  const UncertainWorld& world_;
  PartId part_;
  const domain::PartModel& model_;
  const Pose& X_WorldPart_;
  Transform possible_;
  Preconditions conditions_;
};

}  // namespace

std::vector<Precondition> LandingPreconditions(const UncertainWorld& world, PartId part,
                                               const plan::Hold& hold, const Transform& X_ToolGrasp,
                                               const Pose& X_WorldPart, const Expression& table) {
  LandingConditions conditions(world, part, hold, X_ToolGrasp, X_WorldPart);
  conditions.RequireHeight(table);
  conditions.RequireOnTable();
  for (int p = 0; p < static_cast<int>(world.problem().parts.size()); ++p) {
    if (PartId(p) != part) conditions.RequireClearOf(PartId(p));
  }
  return conditions.Take();
}

}  // namespace assay::uncertainty
