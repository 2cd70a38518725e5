#include "planner/geometry/collision.h"

#include <algorithm>
#include <limits>
#include <map>
#include <mutex>
#include <optional>
#include <vector>

#include "planner/base/check.h"
#include "planner/geometry/box.h"
#include "planner/geometry/hull.h"
#include "planner/geometry/narrow_phase.h"
#include "planner/geometry/polygon.h"
#include "planner/geometry/solids/convex_cut.h"

namespace assay::geometry {
namespace {

// Rounding decides whether faces that touch exactly overlap. Therefore an overlap of up to one
// nanometre never counts.
constexpr double kTouching = 1e-9;

// A box in the frame of its shape, in the form that the test for boxes needs.
struct PreparedBox {
  Pose X_ShapeBox;
  Pose X_BoxShape;
  Vector3 half_extents;
};

// A solid drawn in by some distance, also in GJK's form, which is null if nothing is left of the
// solid.
struct DrawnIn {
  ConvexHull hull;
  std::shared_ptr<const GjkHull> gjk;
};

class PreparedSolid {
 public:
  PreparedSolid(ConvexHull hull, const std::optional<Box>& box)
      : hull_(std::move(hull)), ball_(BallAround(hull_.vertices)) {
    if (box) box_ = {box->X_FrameBox, box->X_FrameBox.inverse(), box->half_extents};
  }

  const ConvexHull& hull() const { return hull_; }
  const Ball& ball() const { return ball_; }
  const std::optional<PreparedBox>& box() const { return box_; }

  // Returns a lower bound on the distance of a point from the solid.
  double DistanceTo(const Vector3& p_Shape) const {
    if (!box_) return (p_Shape - ball_.center).norm() - ball_.radius;
    const Vector3 p_Box = box_->X_BoxShape * p_Shape;
    return (p_Box.cwiseAbs() - box_->half_extents).cwiseMax(0.0).norm();
  }

  // Solids meet other solids with few different insets, so each one is computed once.
  const DrawnIn& DrawnInBy(double inset) const {
    const std::lock_guard lock(*mutex_);
    const auto [found, is_new] = drawn_in_->try_emplace(inset);
    if (is_new) {
      if (auto rest = inset == 0 ? std::optional(hull_) : Inset(hull_, inset)) {
        found->second.gjk = MakeGjkHull(*rest);
        found->second.hull = *std::move(rest);
      }
    }
    return found->second;
  }

 private:
  ConvexHull hull_;
  Ball ball_;
  std::optional<PreparedBox> box_;
  std::shared_ptr<std::mutex> mutex_ = std::make_shared<std::mutex>();
  std::shared_ptr<std::map<double, DrawnIn>> drawn_in_ =
      std::make_shared<std::map<double, DrawnIn>>();
};

// Returns the full edge lengths of a box whose faces are moved inward by `inset`. The box keeps a
// tiny thickness.
Vector3 ShrunkSides(const Vector3& half_extents, double inset) {
  return 2 * (half_extents.array() - inset).max(kTouching / 10).matrix();
}

// Returns whether a plane normal to a direction of A's frame, a unit vector, separates the solids
// but for an overlap that does not count.
bool IsPlaneBetween(const Vector3& direction, const ConvexHull& a, const ConvexHull& b,
                    const Pose& X_AB) {
  const Vector3 direction_B = X_AB.linear().transpose() * direction;
  return direction.dot(X_AB.translation()) - GreatestAlong(b, -direction_B) + kTouching >
         GreatestAlong(a, direction);
}

// Returns whether the solids are apart. GJK's answer counts only if GJK finds a plane that
// separates the solids. If it finds none, because the solids nearly touch, the planes of their
// facets are tried.
bool AreApart(const DrawnIn& a, const DrawnIn& b, const Pose& X_AB) {
  const Vector3 difference = NearestDifference(*a.gjk, *b.gjk, X_AB);
  if (!difference.isZero(0) && IsPlaneBetween(difference.normalized(), a.hull, b.hull, X_AB)) {
    return true;
  }
  const auto separates = [&](const Vector3& normal) {
    return IsPlaneBetween(normal, a.hull, b.hull, X_AB);
  };
  return std::ranges::any_of(a.hull.facets,
                             [&](const Facet& facet) { return separates(facet.normal); }) ||
         std::ranges::any_of(b.hull.facets, [&](const Facet& facet) {
           return separates(-(X_AB.linear() * facet.normal));
         });
}

bool SolidsOverlap(const PreparedSolid& a, const PreparedSolid& b, const Pose& X_AB,
                   double allowance) {
  if (a.box() && b.box()) {
    const double inset = (allowance + kTouching) / 2;
    return AreOverlapping({ShrunkSides(a.box()->half_extents, inset), a.box()->X_ShapeBox},
                          {ShrunkSides(b.box()->half_extents, inset), X_AB * b.box()->X_ShapeBox});
  }
  const DrawnIn& drawn_a = a.DrawnInBy(allowance / 2);
  const DrawnIn& drawn_b = b.DrawnInBy(allowance / 2);
  return drawn_a.gjk && drawn_b.gjk && !AreApart(drawn_a, drawn_b, X_AB);
}

double SolidDistance(const PreparedSolid& a, const PreparedSolid& b, const Pose& X_AB) {
  if (a.box() && b.box()) {
    return std::max(0.0, Distance(PlacedBox{2 * a.box()->half_extents, a.box()->X_ShapeBox},
                                  {2 * b.box()->half_extents, X_AB * b.box()->X_ShapeBox}));
  }
  return NearestDifference(*a.DrawnInBy(0).gjk, *b.DrawnInBy(0).gjk, X_AB).norm();
}

}  // namespace

struct CollisionShape::Prepared {
  std::vector<PreparedSolid> solids;
  Ball ball;
};

namespace {

std::shared_ptr<const CollisionShape::Prepared> Prepare(std::vector<PreparedSolid> solids) {
  auto prepared = std::make_shared<CollisionShape::Prepared>();
  std::vector<Vector3> vertices;
  for (const PreparedSolid& solid : solids) {
    vertices.insert(vertices.end(), solid.hull().vertices.begin(), solid.hull().vertices.end());
  }
  prepared->solids = std::move(solids);
  if (!vertices.empty()) prepared->ball = BallAround(vertices);
  return prepared;
}

double RadiusOf(const CollisionShape::Prepared& prepared) {
  double radius = 0;
  for (const PreparedSolid& solid : prepared.solids) {
    for (const Vector3& vertex : solid.hull().vertices) radius = std::max(radius, vertex.norm());
  }
  return radius;
}

}  // namespace

CollisionShape::CollisionShape(std::span<const ConvexHull> solids) {
  std::vector<PreparedSolid> prepared;
  for (const ConvexHull& solid : solids) prepared.emplace_back(solid, AsBox(solid));
  prepared_ = Prepare(std::move(prepared));
  radius_ = RadiusOf(*prepared_);
}

CollisionShape::CollisionShape(std::span<const Box> boxes) {
  std::vector<PreparedSolid> prepared;
  for (const Box& box : boxes) prepared.emplace_back(HullOf(box), box);
  prepared_ = Prepare(std::move(prepared));
  radius_ = RadiusOf(*prepared_);
}

bool Overlaps(const CollisionShape& a, const Pose& X_WorldA, const CollisionShape& b,
              const Pose& X_WorldB, double allowance) {
  ASSAY_CHECK(allowance >= 0);
  const Ball& a_ball = a.prepared().ball;
  const Ball& b_ball = b.prepared().ball;
  const double apart = (X_WorldA * a_ball.center - X_WorldB * b_ball.center).norm();
  if (apart > a_ball.radius + b_ball.radius) return false;
  const Pose X_AB = X_WorldA.inverse() * X_WorldB;
  for (const PreparedSolid& of_b : b.prepared().solids) {
    const Vector3 center = X_AB * of_b.ball().center;
    if ((center - a_ball.center).norm() > a_ball.radius + of_b.ball().radius) continue;
    for (const PreparedSolid& of_a : a.prepared().solids) {
      if (of_a.DistanceTo(center) > of_b.ball().radius) continue;
      if (SolidsOverlap(of_a, of_b, X_AB, allowance)) return true;
    }
  }
  return false;
}

double Distance(const CollisionShape& a, const Pose& X_WorldA, const CollisionShape& b,
                const Pose& X_WorldB) {
  if (Overlaps(a, X_WorldA, b, X_WorldB, 0)) return 0;
  const Pose X_AB = X_WorldA.inverse() * X_WorldB;
  double least = std::numeric_limits<double>::infinity();
  for (const PreparedSolid& of_b : b.prepared().solids) {
    const Vector3 center = X_AB * of_b.ball().center;
    for (const PreparedSolid& of_a : a.prepared().solids) {
      if (of_a.DistanceTo(center) - of_b.ball().radius >= least) continue;
      least = std::min(least, SolidDistance(of_a, of_b, X_AB));
    }
  }
  return least;
}

}  // namespace assay::geometry
