#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "planner/finemotion/contacts/contact_range.h"
#include "planner/finemotion/contacts/edge_crossing.h"
#include "planner/finemotion/contacts/linear_rows.h"
#include "planner/finemotion/contacts/parallel_edges.h"

namespace assay::finemotion {

// Finds the pairs of edges of two parts that may be parallel near a pose. All arguments but the
// range must outlive the finder.
class ParallelEdgeFinder {
 public:
  ParallelEdgeFinder(const Placed& moving, const Placed& stationary, const LinearRows& rows,
                     const ContactRange& range)
      : moving_(moving),
        stationary_(stationary),
        rows_(rows),
        reach_(range.reach),
        turn_(range.turn) {}

  std::vector<ParallelEdges> Find() const {
    std::vector<ParallelEdges> found;
    ForNearEdges(moving_, stationary_, reach_ + kSamePoint, [&](Index moving, Index stationary) {
      const PlacedEdge& a = moving_.edges[moving];
      const PlacedEdge& b = stationary_.edges[stationary];
      if (!MayBeParallel(a.direction.cross(b.direction).norm(), turn_)) return;
      const Edge& edge_a = moving_.part.edges[moving];
      const Edge& edge_b = stationary_.part.edges[stationary];
      const Crossing nearest = NearestOf(a, edge_a.length, b, edge_b.length);
      const Vector3 from_b = a.start + nearest.s * a.direction - b.start - nearest.t * b.direction;
      if (from_b.norm() > reach_ || !MayPress(edge_a, edge_b)) return;
      found.push_back({.moving = static_cast<int>(moving),
                       .stationary = static_cast<int>(stationary),
                       .along_stationary = Along(stationary_, b, edge_b, moving_, a, edge_a),
                       .along_moving = Along(moving_, a, edge_a, stationary_, b, edge_b),
                       .contact = Halfway(a, edge_a, nearest.s, edge_b, from_b)});
      found.back().contact.moving = found.back().moving;
      found.back().contact.stationary = found.back().stationary;
    });
    return found;
  }

 private:
  using Index = std::size_t;
  using Edge = ToleratedPart::Edge;

  static constexpr double kTurnOnTheWay = 0.05;  // radians, more than a part turns in one motion

  // Returns whether the edges can press on each other, perhaps after a turn. They can if some
  // direction lies between the face normals of the one edge and the reversed normals of the other.
  // Across the edges, these ranges of directions are angles about the bisectors.
  bool MayPress(const Edge& moving, const Edge& stationary) const {
    const auto half_angle = [](const Edge& edge) {
      return std::acos(std::clamp(edge.normals[0].dot(edge.normals[1]), -1.0, 1.0)) / 2;
    };
    const double cosine = -moving_.Turned(moving.Bisector()).dot(stationary.Bisector());
    return std::acos(std::clamp(cosine, -1.0, 1.0)) <=
           half_angle(moving) + half_angle(stationary) + 2 * turn_ + kTurnOnTheWay;
  }

  // Returns the ends of the edge `other` in coordinates with the third axis along the edge `bar`.
  EdgeAlongEdge Along(const Placed& with_bar, const PlacedEdge& bar, const Edge& bar_edge,
                      const Placed& with_other, const PlacedEdge& other,
                      const Edge& other_edge) const {
    Eigen::Matrix3d axes;  // two directions across the bar, then its own, as rows
    const Vector3 across = bar.direction.unitOrthogonal();
    axes << across.transpose(), bar.direction.cross(across).transpose(), bar.direction.transpose();
    EdgeAlongEdge seen{.ends = {}, .length = bar_edge.length, .elongation = {}};
    for (const Index which : {0U, 1U}) {
      const Vector3 p = other.start + (which == 0 ? 0 : other_edge.length) * other.direction;
      const Vector3 r = p - rows_.origin();
      Eigen::Matrix3d lever;
      lever << 0, r.z(), -r.y(), -r.z(), 0, r.x(), r.y(), -r.x(), 0;
      PointAtEdge& end = seen.ends[which];
      end.offset = axes * (p - bar.start);
      end.pose << with_other.part.sign * axes, with_other.part.sign * axes * lever;
      end.tolerances = axes * (with_other.X.linear() * other_edge.EndShift(which) -
                               with_bar.X.linear() * bar_edge.shift);
    }
    seen.elongation = bar_edge.end_shifts[0].cwiseAbs().cwiseMax(bar_edge.end_shifts[1].cwiseAbs());
    return seen;
  }

  PrimitiveContact Halfway(const PlacedEdge& a, const Edge& moving, double s,
                           const Edge& stationary, const Vector3& from_b) const {
    const Vector3 n = (stationary.Bisector() - moving_.Turned(moving.Bisector())).normalized();
    PrimitiveContact contact;
    contact.kind = ContactKind::kEdgeEdge;
    contact.offset = n.dot(from_b);
    contact.normal = n;
    contact.at = a.start + s * a.direction - rows_.origin();
    contact.row = rows_.EdgeRow(n, contact.at, moving_, moving, stationary);
    return contact;
  }

  const Placed& moving_;
  const Placed& stationary_;
  const LinearRows& rows_;
  double reach_;
  double turn_;
};

}  // namespace assay::finemotion
