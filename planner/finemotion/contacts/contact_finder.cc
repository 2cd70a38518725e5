#include "planner/finemotion/contacts/contact_finder.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "planner/finemotion/contacts/edge_crossing.h"
#include "planner/finemotion/contacts/linear_rows.h"
#include "planner/finemotion/contacts/parallel_edge_finder.h"
#include "planner/finemotion/contacts/placed_part.h"
#include "planner/finemotion/contacts/round_contacts.h"

namespace assay::finemotion {

namespace {

constexpr std::size_t kUsualLimits = 4;  // the paper's greatest number, section 3
constexpr std::size_t kUsualContacts = 32;
constexpr double kFar = std::numeric_limits<double>::infinity();

using Index = std::size_t;
using Part = ToleratedPart;
using Edge = ToleratedPart::Edge;
using Face = ToleratedPart::Face;
using Region = ToleratedPart::Region;
using Vertex = ToleratedPart::Vertex;

bool Same(const HalfSpace& a, const HalfSpace& b) {
  return std::abs(a.b - b.b) < kSameSurface && (a.a - b.a).cwiseAbs().maxCoeff() < kSameSurface;
}

bool Same(const PrimitiveContact& a, const PrimitiveContact& b) {
  if (a.limits.size() != b.limits.size() || std::abs(a.offset - b.offset) > kSameSurface ||
      (a.row - b.row).cwiseAbs().maxCoeff() > kSameSurface) {
    return false;
  }
  return std::ranges::all_of(a.limits, [&](const HalfSpace& limit) {
    return std::ranges::any_of(b.limits, [&](const HalfSpace& l) { return Same(l, limit); });
  });
}

}  // namespace

class ContactFinder::Parts {
 public:
  Parts(const Polyhedron& moving_shape, const Polyhedron& stationary_shape,
        const std::vector<ModelTolerance>& model_tolerances)
      : round(moving_shape, stationary_shape),
        moving(moving_shape, ModelTolerance::Of::kMovingFaces, model_tolerances),
        stationary(stationary_shape, ModelTolerance::Of::kStationaryFaces, model_tolerances),
        tolerances(std::ssize(model_tolerances)),
        placed_stationary(stationary, Pose::Identity()) {}
  Parts(const Parts&) = delete;
  Parts& operator=(const Parts&) = delete;

  // Adds the contact if it is within the range.
  void AddRound(const ContactKey& key, const Pose& X, const ContactRange& range,
                std::vector<PrimitiveContact>& contacts) const {
    if (auto contact = round.Linearized(key, X, range, tolerances))
      contacts.push_back(std::move(*contact));
  }

  const RoundContacts round;
  const Part moving;
  const Part stationary;
  const Eigen::Index tolerances;
  const Placed placed_stationary;
};

namespace {

// Linearizes contacts of parts at one pose.
class Linearizer {
 public:
  Linearizer(const Placed& moving, const Placed& stationary, Eigen::Index tolerances,
             const ContactRange& range)
      : moving_(moving),
        stationary_(stationary),
        rows_(moving.X.translation(), tolerances),
        reach_(range.reach),
        turn_(range.turn) {
    contacts_.reserve(kUsualContacts);
    ends_.reserve(2 * kUsualLimits);
  }

  void AddAll() {
    AddVerticesOnFaces(moving_, stationary_);
    AddVerticesOnFaces(stationary_, moving_);
    ForNearEdges(moving_, stationary_, reach_ + kSamePoint,
                 [&](Index moving, Index stationary) { AddEdgeOnEdge(moving, stationary); });
  }

  // Adds a contact that is not round.
  void Add(const ContactKey& key) {
    const auto moving = static_cast<Index>(key.moving);
    const auto stationary = static_cast<Index>(key.stationary);
    if (moving >= CountOf(moving_.part, key.kind == ContactKind::kVertexFace, key.kind) ||
        stationary >= CountOf(stationary_.part, key.kind == ContactKind::kFaceVertex, key.kind))
      return;
    if (key.kind == ContactKind::kVertexFace)
      AddVertexOnFace(moving_, moving, stationary_, stationary);
    if (key.kind == ContactKind::kFaceVertex)
      AddVertexOnFace(stationary_, stationary, moving_, moving);
    if (key.kind == ContactKind::kEdgeEdge) AddEdgeOnEdge(moving, stationary);
  }

  std::vector<PrimitiveContact> Take() && { return std::move(contacts_); }

 private:
  // Returns how many of the part's features can take part in a contact of this kind.
  static Index CountOf(const Part& part, bool is_vertex, ContactKind kind) {
    if (kind == ContactKind::kEdgeEdge) return part.edges.size();
    return is_vertex ? part.vertices.size() : part.faces.size();
  }

  // An end of a contact's range.
  struct End {
    double left = 0;  // metres by which the contact is inside this end
    Index which = 0;  // index of the end

    auto operator<=>(const End&) const = default;
  };

  // Adds the contacts of vertices with faces, skipping pairs whose boxes are farther apart than the
  // reach.
  void AddVerticesOnFaces(const Placed& with_vertex, const Placed& with_face) {
    const double reach = reach_ + kSamePoint;
    const Part& part = with_face.part;
    for (Index i = 0; i < with_vertex.part.vertices.size(); ++i) {
      if (with_vertex.part.vertices[i].is_round) continue;
      const Vector3 p = with_face.MovedBack(with_vertex.X * with_vertex.part.vertices[i].p);
      if (!part.extent.IsNear(p, reach)) continue;
      for (Index j = 0; j < part.faces.size(); ++j) {
        if (part.faces[j].extent.IsNear(p, reach)) AddVertexOnFace(with_vertex, i, with_face, j);
      }
    }
  }

  void AddVertexOnFace(const Placed& with_vertex, Index vertex_index, const Placed& with_face,
                       Index face_index) {
    const Vertex& vertex = with_vertex.part.vertices[vertex_index];
    const Face& face = with_face.part.faces[face_index];
    const Vector3 p = with_vertex.X * vertex.p;
    const Vector3 p_in_face = with_face.MovedBack(p);
    const double gap = face.normal.dot(p_in_face) - face.height;
    if (std::abs(gap) > reach_) return;
    const Vector3 normal = with_face.Turned(face.normal);
    if (!MayTouch(vertex, with_vertex.TurnedBack(normal))) return;
    const bool moving_vertex = with_vertex.part.sign > 0;
    for (const Region& region : face.regions) {
      if (IsBeyondReach(region.sides, p_in_face, face.normal, gap)) continue;
      PrimitiveContact contact;
      contact.kind = moving_vertex ? ContactKind::kVertexFace : ContactKind::kFaceVertex;
      contact.moving = static_cast<int>(moving_vertex ? vertex_index : face_index);
      contact.stationary = static_cast<int>(moving_vertex ? face_index : vertex_index);
      contact.offset = gap;
      contact.normal = with_vertex.part.sign * normal;
      contact.at = p - rows_.origin();
      contact.row = rows_.Row(contact.normal, contact.at);
      rows_.Tolerances(contact.row) =
          LinearRows::Along(vertex.shift, with_vertex.TurnedBack(normal)) - face.shift;
      contact.limits.reserve(vertex.leaving.size() + region.sides.size());
      AddOverlapLimits(with_vertex, vertex, normal, contact);
      AddExtentLimits(with_vertex, vertex, with_face, region, p_in_face, contact);
      Keep(std::move(contact));
    }
  }

  bool IsBeyondReach(const FaceRegion& region, const Vector3& p, const Vector3& normal,
                     double gap) const {
    for (const RegionSide& side : region) {
      if (side.Excess(p) > reach_) return true;
    }
    return std::hypot(gap, DistanceTo(region, p - gap * normal)) > reach_;
  }

  // Returns whether there is a motion in range for which no edge that leaves the vertex goes behind
  // the face. `n` is the face's normal in the axes of the vertex's part.
  bool MayTouch(const Vertex& vertex, const Vector3& n) const {
    return std::ranges::none_of(vertex.leaving, [&](const Vector3& leaving) {
      return n.dot(leaving) < -kSameDirection - turn_;
    });
  }

  // Adds a limit for each edge at the vertex that could go behind the face. In small motions only
  // an edge that lies in the face can go behind it. In larger motions an edge that lies nearly in
  // the face can, too.
  void AddOverlapLimits(const Placed& side, const Vertex& vertex, const Vector3& n,
                        PrimitiveContact& contact) const {
    for (const Vector3& direction : vertex.leaving) {
      const Vector3 leaving = side.Turned(direction);
      const double rise = n.dot(leaving);
      if (rise < kSameDirection + turn_) {
        contact.limits.push_back(rows_.TurnLimit(side.part.sign * n.cross(leaving), rise));
      }
    }
  }

  // Adds limits that keep the vertex on this region of the face.
  void AddExtentLimits(const Placed& with_vertex, const Vertex& vertex, const Placed& with_face,
                       const Region& region, const Vector3& p_in_face, PrimitiveContact& contact) {
    ends_.clear();
    for (const RegionSide& side : region.sides) {
      ends_.push_back({-side.Excess(p_in_face), ends_.size()});
    }
    AddNearest(contact, [&](Index which) {
      const Vector3 outward = with_face.Turned(region.sides[which].outward);
      numeric::SmallVector row = rows_.Row(with_vertex.part.sign * outward, contact.at);
      rows_.Tolerances(row) =
          LinearRows::Along(vertex.shift, with_vertex.TurnedBack(outward)) - region.shifts[which];
      return row;
    });
  }

  void AddEdgeOnEdge(Index moving, Index stationary) {
    const PlacedEdge& a = moving_.edges[moving];
    const PlacedEdge& b = stationary_.edges[stationary];
    const Edge& edge_a = moving_.part.edges[moving];
    const Edge& edge_b = stationary_.part.edges[stationary];
    const Vector3 between = a.start - b.start;
    Vector3 n = a.direction.cross(b.direction);
    const double sine2 = n.squaredNorm();
    const double apart = n.dot(between);
    if (apart * apart > reach_ * reach_ * sine2) return;
    const double sine = std::sqrt(sine2);
    if (MayBeParallel(sine, turn_)) return;
    n /= sine;
    const double slack = kSameDirection + turn_ / sine;  // the angle by which n may turn
    const Crossing crossing = CrossingOf(a, b, sine2);
    if (AreBeyondReach(a, edge_a.length, b, edge_b.length, crossing, reach_)) return;
    if (!Separates(n, edge_a, edge_b, slack)) n = -n;
    if (!Separates(n, edge_a, edge_b, slack)) return;
    const Vector3 at = a.start + crossing.s * a.direction;
    PrimitiveContact contact;
    contact.kind = ContactKind::kEdgeEdge;
    contact.moving = static_cast<int>(moving);
    contact.stationary = static_cast<int>(stationary);
    contact.offset = n.dot(at - b.start);
    contact.normal = n;
    contact.at = at - rows_.origin();
    contact.row = rows_.EdgeRow(n, contact.at, moving_, edge_a, edge_b);
    contact.limits.reserve(2 * kUsualLimits);
    AddOrientationLimits(moving_, edge_a, b.direction, n, slack, contact);
    AddOrientationLimits(stationary_, edge_b, a.direction, n, slack, contact);
    AddRangeLimits(a, edge_a, b, edge_b, crossing, contact);
    Keep(std::move(contact));
  }

  // Returns whether the plane through two crossing edges, with normal n, has the parts on its two
  // sides. The faces at the moving edge must go up or along the plane, and those at the stationary
  // edge down or along it.
  bool Separates(const Vector3& n, const Edge& moving, const Edge& stationary, double slack) const {
    const Vector3 n_moving = moving_.TurnedBack(n);
    return std::ranges::all_of(moving.into,
                               [&](const Vector3& into) { return n_moving.dot(into) >= -slack; }) &&
           std::ranges::all_of(stationary.into,
                               [&](const Vector3& into) { return n.dot(into) <= slack; });
  }

  // Adds a limit for each face of the edge that lies in, or nearly in, the plane of both edges. The
  // half of the other edge that is over the face must not go behind it. For edges at right angles
  // this is the condition on the inward directions with n held fixed. At other angles n turns with
  // the moving edge, and the limit accounts for that.
  void AddOrientationLimits(const Placed& side, const Edge& edge, const Vector3& other,
                            const Vector3& n, double slack, PrimitiveContact& contact) const {
    for (const Index which : {0U, 1U}) {
      const Vector3 into = side.Turned(edge.into[which]);
      if (std::abs(n.dot(into)) > slack) continue;
      const Vector3 normal = side.Turned(edge.normals[which]);
      const double over = other.dot(into) < 0 ? -1 : 1;
      contact.limits.push_back(
          rows_.TurnLimit(-side.part.sign * over * normal.cross(other), over * normal.dot(other)));
    }
  }

  // Adds limits that keep the crossing point of the edges between the ends of both.
  void AddRangeLimits(const PlacedEdge& a, const Edge& edge_a, const PlacedEdge& b,
                      const Edge& edge_b, const Crossing& crossing, PrimitiveContact& contact) {
    const double c = a.direction.dot(b.direction);
    const double sine2 = 1 - c * c;
    const std::array<Vector3, 2> slides = {(c * b.direction - a.direction) / sine2,
                                           (b.direction - c * a.direction) / sine2};
    ends_ = {{crossing.s, 0},
             {edge_a.length - crossing.s, 1},
             {crossing.t, 2},
             {edge_b.length - crossing.t, 3}};
    AddNearest(contact, [&](Index which) {
      const Edge& edge = which < 2 ? edge_a : edge_b;
      const double sign = which % 2 == 0 ? -1 : 1;
      numeric::SmallVector row =
          rows_.EdgeRow(sign * slides[which / 2], contact.at, moving_, edge_a, edge_b);
      rows_.Tolerances(row) -= sign * edge.end_shifts[which % 2];
      return row;
    });
  }

  // Adds the nearest ends as limits. The contact can slide to the end of a face or an edge, where
  // it is lost. Each end within reach becomes a limit of the contact. A face or an edge that is
  // narrower than the reach therefore has more limits than usual. Within the range in which the
  // linearization is accurate, the contact cannot come to an end beyond the reach. Such ends are
  // left out once there are kUsualLimits limits.
  template <class RowOf>
  void AddNearest(PrimitiveContact& contact, const RowOf& row_of) {
    std::ranges::sort(ends_);
    for (const End& end : ends_) {
      if (contact.limits.size() >= kUsualLimits && end.left > reach_) break;
      contact.limits.push_back({row_of(end.which), end.left});
    }
  }

  void Keep(PrimitiveContact contact) {
    const auto same = [&](const PrimitiveContact& other) { return Same(other, contact); };
    if (std::ranges::none_of(contacts_, same)) contacts_.push_back(std::move(contact));
  }

  const Placed& moving_;
  const Placed& stationary_;
  LinearRows rows_;
  double reach_;
  double turn_;
  std::vector<PrimitiveContact> contacts_;
  std::vector<End> ends_;
};

}  // namespace

ContactFinder::ContactFinder(const Polyhedron& moving, const Polyhedron& stationary,
                             const std::vector<ModelTolerance>& tolerances)
    : parts_(std::make_shared<const Parts>(moving, stationary, tolerances)) {}

std::vector<PrimitiveContact> ContactFinder::Near(const Pose& X_StationaryMoving,
                                                  const ContactRange& range) const {
  const Placed moving(parts_->moving, X_StationaryMoving);
  Linearizer linearizer(moving, parts_->placed_stationary, parts_->tolerances, range);
  linearizer.AddAll();
  std::vector<PrimitiveContact> contacts = std::move(linearizer).Take();
  for (const ContactKey& key : parts_->round.keys())
    parts_->AddRound(key, X_StationaryMoving, range, contacts);
  return contacts;
}

std::vector<ParallelEdges> ContactFinder::NearlyParallel(const Pose& X_StationaryMoving,
                                                         const ContactRange& range) const {
  const Placed moving(parts_->moving, X_StationaryMoving);
  const LinearRows rows(X_StationaryMoving.translation(), parts_->tolerances);
  return ParallelEdgeFinder(moving, parts_->placed_stationary, rows, range).Find();
}

std::vector<PrimitiveContact> ContactFinder::Of(std::span<const ContactKey> keys,
                                                const Pose& X_StationaryMoving, double turn) const {
  const Placed moving(parts_->moving, X_StationaryMoving);
  Linearizer linearizer(moving, parts_->placed_stationary, parts_->tolerances,
                        {.reach = kFar, .turn = turn});
  for (const ContactKey& key : keys) linearizer.Add(key);
  std::vector<PrimitiveContact> contacts = std::move(linearizer).Take();
  for (const ContactKey& key : keys)
    parts_->AddRound(key, X_StationaryMoving, {.reach = kFar, .turn = turn}, contacts);
  return contacts;
}

std::vector<PrimitiveContact> PrimitiveContacts(const Polyhedron& moving,
                                                const Polyhedron& stationary,
                                                const Pose& X_StationaryMoving, double reach,
                                                const std::vector<ModelTolerance>& tolerances,
                                                double turn) {
  return ContactFinder(moving, stationary, tolerances)
      .Near(X_StationaryMoving, {.reach = reach, .turn = turn});
}

}  // namespace assay::finemotion
