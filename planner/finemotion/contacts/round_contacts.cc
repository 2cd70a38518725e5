#include "planner/finemotion/contacts/round_contacts.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "planner/finemotion/contacts/rim_crossing.h"
#include "planner/geometry/hull.h"
#include "planner/geometry/polygon.h"

namespace assay::finemotion {

namespace {

using Index = std::size_t;

constexpr int kRimPoints = kRoundDirections + 1;  // the lowest point, and one for each direction
constexpr double kSameWay = 0.5;        // least cosine between axes that count as along each other
constexpr double kLeastRimTilt = 1e-4;  // radians; a rim that tilts less has no lowest point
constexpr double kNudgedMove = 1e-6;    // metres, for derivatives of ends
constexpr double kNudgedTurn = 1e-5;    // radians, for derivatives of ends

Vector3 Across(const Vector3& axis, int direction) {
  const Vector3 x = axis.unitOrthogonal();
  const double angle = 2 * std::numbers::pi * direction / kRoundDirections;
  return std::cos(angle) * x + std::sin(angle) * axis.cross(x);
}

// Marks the sides of a polygon about an axis, with their edges and corners. `sense` is 1 for sides
// that look away from the axis, and -1 for sides that look to it. Returns how far they reach from
// `from` against the axis.
double MarkRound(const Vector3& from, const Vector3& axis, double distance, double sense,
                 Polyhedron& shape) {
  double reach = 0;
  for (OuterFace& face : shape.faces) {
    const double height = sense * (face.height - face.normal.dot(from));
    if (std::abs(face.normal.dot(axis)) > kSameDirection ||
        std::abs(height - distance) > kSamePoint)
      continue;
    face.is_round = true;
    for (const std::vector<Vector3>& outline : face.region) {
      for (const Vector3& p : outline) reach = std::max(reach, (from - p).dot(axis));
    }
  }
  for (OuterEdge& edge : shape.edges) {
    for (const int face : edge.faces) {
      edge.is_round = edge.is_round || shape.faces[static_cast<std::size_t>(face)].is_round;
    }
  }
  for (OuterVertex& vertex : shape.vertices) {
    vertex.is_round = std::ranges::any_of(vertex.edges, [&](int edge) {
      return shape.edges[static_cast<std::size_t>(edge)].is_round;
    });
  }
  return reach;
}

// Returns the corners of the convex hull of a face's region, counter-clockwise.
std::vector<Vector3> HullOf(const OuterFace& face) {
  const Vector3 x = face.normal.unitOrthogonal();
  const Vector3 y = face.normal.cross(x);
  std::vector<geometry::Vector2> flat;
  for (const std::vector<Vector3>& outline : face.region) {
    for (const Vector3& p : outline) flat.emplace_back(x.dot(p), y.dot(p));
  }
  std::vector<Vector3> hull;
  for (const geometry::Vector2& q : geometry::Hull2(flat))
    hull.push_back(q.x() * x + q.y() * y + face.height * face.normal);
  return hull;
}

// Returns the pose displaced along, or turned about, one axis.
Pose Nudged(Pose X, int dimension, double step) {
  if (dimension < 3) {
    X.translation()[dimension] += step;
  } else {
    X.linear() = Eigen::AngleAxisd(step, Vector3::Unit(dimension - 3)) * X.linear();
  }
  return X;
}

// The shaft at a pose of its part.
struct PlacedShaft {
  Vector3 tip;
  Vector3 axis;
  double radius;
  double length;

  PlacedShaft(const RoundShaft& shaft, const Pose& X)
      : tip(X * shaft.tip),
        axis(X.linear() * shaft.axis),
        radius(shaft.radius),
        length(shaft.length) {}
};

std::optional<RoundContact> RimOnRim(const PlacedShaft& shaft, int sense, const RoundHole& hole,
                                     double turn) {
  const Rim of_shaft = {shaft.tip, shaft.axis, shaft.radius};
  const Rim of_hole = {hole.mouth, hole.axis, hole.radius};
  const auto crossing = CrossingOf(of_shaft, of_hole, sense);
  if (!crossing) return std::nullopt;
  const Vector3& n = crossing->normal;
  const std::array<double, 4> inside = {
      n.dot(hole.axis), -n.dot((crossing->on_second - hole.mouth).normalized()), -n.dot(shaft.axis),
      -n.dot((crossing->on_first - shaft.tip).normalized())};
  RoundContact contact{.gap = n.dot(crossing->on_first - crossing->on_second),
                       .normal = n,
                       .at = crossing->on_first,
                       .inside = {}};
  for (const double angle : inside) {
    if (angle < -turn / crossing->sine) return std::nullopt;
    contact.inside.push_back(shaft.radius * angle);
  }
  return contact;
}

std::optional<RoundContact> SideOnRim(const PlacedShaft& shaft, const RoundHole& hole,
                                      int direction) {
  const double cosine = -hole.axis.dot(shaft.axis);
  if (cosine < kSameWay) return std::nullopt;
  const Vector3 u = Across(hole.axis, direction);
  const double to_plane = hole.axis.dot(hole.mouth - shaft.tip) / cosine;
  const Vector3 center = shaft.tip - to_plane * shaft.axis;
  // The shaft's section in the plane of the mouth is an ellipse.
  const Vector3 lean = (shaft.axis + cosine * hole.axis) / cosine;
  const double support = shaft.radius * std::sqrt(1 + std::pow(u.dot(lean), 2));
  const Vector3 to = shaft.radius * shaft.radius / support * (u + u.dot(lean) * lean);
  const Vector3 outward = (to - to.dot(shaft.axis) * shaft.axis).normalized();
  const double gap = hole.radius - u.dot(center - hole.mouth) - support;
  RoundContact contact{.gap = gap * outward.dot(u),
                       .normal = -outward,
                       .at = center + to,
                       .inside = {-u.dot(shaft.axis)},
                       .turns = 1};
  const double from_tip = -shaft.axis.dot(contact.at - shaft.tip);
  contact.inside.push_back(from_tip);
  contact.inside.push_back(shaft.length - from_tip);
  return contact;
}

std::optional<RoundContact> RimOnWall(const PlacedShaft& shaft, const RoundHole& hole,
                                      int direction) {
  if (hole.axis.dot(shaft.axis) > -kSameWay) return std::nullopt;
  const Vector3 u = Across(hole.axis, direction);
  const Vector3 out = u - u.dot(shaft.axis) * shaft.axis;
  RoundContact contact{.at = shaft.tip + shaft.radius * out.normalized(), .inside = {}};
  contact.gap = hole.radius - u.dot(contact.at - hole.mouth);
  contact.normal = -u;
  contact.inside = {u.dot(shaft.axis)};
  contact.turns = 1;
  const double deep = hole.axis.dot(hole.mouth - contact.at);
  contact.inside.push_back(deep);
  contact.inside.push_back(hole.depth - deep);
  return contact;
}

}  // namespace

void AddRoundShaft(RoundShaft shaft, double apothem, Polyhedron& shape) {
  shaft.length = MarkRound(shaft.tip, shaft.axis, apothem, 1, shape);
  shape.shafts.push_back(shaft);
}

void AddRoundHole(RoundHole hole, double apothem, Polyhedron& shape) {
  hole.depth = MarkRound(hole.mouth, hole.axis, apothem, -1, shape);
  shape.holes.push_back(hole);
}

RoundContacts::RoundContacts(const Polyhedron& moving, const Polyhedron& stationary)
    : shafts_(moving.shafts), holes_(stationary.holes) {
  const auto add = [&](ContactKind kind, Index of_moving, Index of_stationary) {
    keys_.push_back({kind, static_cast<int>(of_moving), static_cast<int>(of_stationary)});
  };
  if (shafts_.empty()) return;
  for (const OuterFace& face : stationary.faces)
    faces_.push_back({face.normal, face.height, HullOf(face), face.is_round});
  for (Index shaft = 0; shaft < shafts_.size(); ++shaft) {
    for (Index face = 0; face < faces_.size(); ++face) {
      if (faces_[face].is_round) continue;
      for (Index point = 0; point < kRimPoints; ++point)
        add(ContactKind::kRimFace, kRimPoints * shaft + point, face);
    }
    for (Index hole = 0; hole < holes_.size(); ++hole) {
      for (const Index sense : {0U, 1U}) add(ContactKind::kRimRim, 2 * shaft + sense, hole);
      for (Index direction = 0; direction < kRoundDirections; ++direction) {
        add(ContactKind::kSideRim, shaft, kRoundDirections * hole + direction);
        add(ContactKind::kRimWall, shaft, kRoundDirections * hole + direction);
      }
    }
  }
}

// Returns whether the parts have these features. Keys may come from a file.
bool RoundContacts::IsKnown(const ContactKey& key) const {
  const auto shafts = static_cast<int>(shafts_.size());
  const auto holes = static_cast<int>(holes_.size());
  const auto are_below = [&](int moving, int stationary) {
    return key.moving >= 0 && key.moving < moving && key.stationary >= 0 &&
           key.stationary < stationary;
  };
  switch (key.kind) {
    case ContactKind::kRimFace:
      return are_below(kRimPoints * shafts, static_cast<int>(faces_.size())) &&
             !faces_[static_cast<Index>(key.stationary)].is_round;
    case ContactKind::kRimRim:
      return are_below(2 * shafts, holes);
    case ContactKind::kSideRim:
    case ContactKind::kRimWall:
      return are_below(shafts, kRoundDirections * holes);
    case ContactKind::kVertexFace:
    case ContactKind::kFaceVertex:
    case ContactKind::kEdgeEdge:
      break;
  }
  return false;
}

std::optional<RoundContact> RoundContacts::RimOnFace(const ContactKey& key, const Pose& X,
                                                     double turn) const {
  const PlacedShaft shaft(shafts_[static_cast<Index>(key.moving / kRimPoints)], X);
  const int point = key.moving % kRimPoints;
  const Ground& face = faces_[static_cast<Index>(key.stationary)];
  if (face.normal.dot(shaft.axis) > -kSameWay) return std::nullopt;
  const Vector3 down = -face.normal + face.normal.dot(shaft.axis) * shaft.axis;
  const bool is_lowest = point == 0;
  if (is_lowest != (down.norm() > kLeastRimTilt + turn)) return std::nullopt;
  Vector3 out = down;
  if (!is_lowest) {
    const Vector3 across = Across(face.normal, point - 1);
    out = across - across.dot(shaft.axis) * shaft.axis;
  }
  RoundContact contact;
  contact.at = shaft.tip + shaft.radius * out.normalized();
  contact.normal = face.normal;
  contact.gap = face.normal.dot(contact.at) - face.height;
  for (Index i = 0; i < face.outline.size(); ++i) {
    const Vector3 along =
        (face.outline[(i + 1) % face.outline.size()] - face.outline[i]).normalized();
    contact.inside.push_back(face.normal.cross(along).dot(contact.at - face.outline[i]));
  }
  for (const RoundHole& hole : holes_) {
    const Vector3 to = contact.at - hole.mouth;
    const bool is_here = hole.axis.dot(face.normal) > 1 - kSameDirection &&
                         std::abs(face.normal.dot(hole.mouth) - face.height) < kSamePoint;
    if (is_here)
      contact.inside.push_back((to - to.dot(hole.axis) * hole.axis).norm() - hole.radius);
  }
  return contact;
}

std::optional<RoundContact> RoundContacts::At(const ContactKey& key, const Pose& X_StationaryMoving,
                                              double turn) const {
  if (!IsKnown(key)) return std::nullopt;
  const auto shaft_at = [&](int index) {
    return PlacedShaft(shafts_[static_cast<Index>(index)], X_StationaryMoving);
  };
  const auto hole_at = [&](int index) -> const RoundHole& {
    return holes_[static_cast<Index>(index)];
  };
  switch (key.kind) {
    case ContactKind::kRimFace:
      return RimOnFace(key, X_StationaryMoving, turn);
    case ContactKind::kRimRim:
      return RimOnRim(shaft_at(key.moving / 2), key.moving % 2 == 0 ? 1 : -1,
                      hole_at(key.stationary), turn);
    case ContactKind::kSideRim:
      return SideOnRim(shaft_at(key.moving), hole_at(key.stationary / kRoundDirections),
                       key.stationary % kRoundDirections);
    case ContactKind::kRimWall:
      return RimOnWall(shaft_at(key.moving), hole_at(key.stationary / kRoundDirections),
                       key.stationary % kRoundDirections);
    case ContactKind::kVertexFace:
    case ContactKind::kFaceVertex:
    case ContactKind::kEdgeEdge:
      break;
  }
  return std::nullopt;
}

std::optional<PrimitiveContact> RoundContacts::Linearized(const ContactKey& key, const Pose& X,
                                                          const ContactRange& range,
                                                          Eigen::Index tolerances) const {
  const auto contact = At(key, X, range.turn);
  if (!contact || std::abs(contact->gap) > range.reach) return std::nullopt;
  for (Index i = 0; i < contact->inside.size(); ++i) {
    const double most =
        std::cmp_less(i, contact->turns) ? range.turn + kSameDirection : range.reach;
    if (contact->inside[i] < -most) return std::nullopt;
  }
  PrimitiveContact linear;
  linear.kind = key.kind;
  linear.moving = key.moving;
  linear.stationary = key.stationary;
  linear.offset = contact->gap;
  linear.normal = contact->normal;
  linear.at = contact->at - X.translation();
  linear.row = Eigen::VectorXd::Zero(kPoseDimensions + tolerances);
  linear.row.head<3>() = contact->normal;
  linear.row.segment<3>(3) = linear.at.cross(contact->normal);
  const auto ends = static_cast<Eigen::Index>(contact->inside.size());
  Eigen::MatrixXd slopes = Eigen::MatrixXd::Zero(ends, kPoseDimensions + tolerances);
  const Eigen::Map<const Eigen::VectorXd> here(contact->inside.data(), ends);
  for (int k = 0; k < kPoseDimensions; ++k) {
    const double step = k < 3 ? kNudgedMove : kNudgedTurn;
    const auto next = At(key, Nudged(X, k, step), range.turn);
    if (!next || next->inside.size() != contact->inside.size()) continue;
    slopes.col(k) = (Eigen::Map<const Eigen::VectorXd>(next->inside.data(), ends) - here) / step;
  }
  for (Eigen::Index i = 0; i < ends; ++i)
    linear.limits.push_back({Eigen::VectorXd(-slopes.row(i).transpose()), here[i]});
  return linear;
}

}  // namespace assay::finemotion
