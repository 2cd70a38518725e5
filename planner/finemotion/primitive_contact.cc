#include "planner/finemotion/primitive_contact.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "planner/base/check.h"
#include "planner/geometry/polygon.h"

namespace assay::finemotion {

namespace {

using geometry::Polygon;
using geometry::Vector2;

constexpr double kSameDirection = 1e-6;  // sine of the angle below which directions agree
constexpr double kSamePoint = 1e-6;      // metres
constexpr double kSameSurface = 1e-9;    // coefficients of rows
constexpr std::size_t kUsualLimits = 4;  // the paper's greatest number, section 3

// How a feature moves for one metre of each tolerance: a column for each.
using Shift = Eigen::Matrix3Xd;

// One of the parts, in the stationary part's axes.
struct Side {
  Polyhedron shape;
  double sign = 1;  // of (d, w) in the motion relative to the other part: 1 moving, -1 stationary
  ModelTolerance::Of tolerance = ModelTolerance::Of::kMovingFaces;
  std::vector<std::vector<Polygon>> regions;  // of each face, merged, in the face's coordinates
};

// Coordinates in a face's plane.
class FaceFrame {
 public:
  explicit FaceFrame(const OuterFace& face)
      : x_(face.normal.unitOrthogonal()),
        y_(face.normal.cross(x_)),
        foot_(face.height * face.normal) {}

  Vector2 Flat(const Vector3& p) const { return {x_.dot(p), y_.dot(p)}; }
  Vector3 Raised(const Vector2& q) const { return foot_ + Turned(q); }
  Vector3 Turned(const Vector2& q) const { return q.x() * x_ + q.y() * y_; }

 private:
  Vector3 x_;
  Vector3 y_;
  Vector3 foot_;
};

double DistanceToSegment(const Vector2& p, const Vector2& a, const Vector2& b) {
  const Vector2 along = b - a;
  const double t = std::clamp((p - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (p - a - t * along).norm();
}

// The hull, without corners that stick out by less than rounding.
Polygon CleanHull(const std::vector<Vector2>& points) {
  Polygon hull = geometry::Hull2(points);
  for (std::size_t i = 0; hull.size() >= 3 && i < hull.size();) {
    const Vector2& before = hull[(i + hull.size() - 1) % hull.size()];
    if (DistanceToSegment(hull[i], before, hull[(i + 1) % hull.size()]) > kSamePoint) {
      ++i;
    } else {
      hull.erase(hull.begin() + static_cast<std::ptrdiff_t>(i));
    }
  }
  return hull;
}

// Two polygons are made one where that is convex, so that a seam between pieces of a part limits
// as few contacts as possible.
bool MergeOnePair(std::vector<Polygon>& polygons) {
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    for (std::size_t j = i + 1; j < polygons.size(); ++j) {
      std::vector<Vector2> corners = polygons[i];
      corners.insert(corners.end(), polygons[j].begin(), polygons[j].end());
      Polygon hull = CleanHull(corners);
      const double area = geometry::Area(hull);
      const double parts = geometry::Area(polygons[i]) + geometry::Area(polygons[j]);
      if (area - parts > kSameDirection * area) continue;
      polygons[i] = std::move(hull);
      polygons.erase(polygons.begin() + static_cast<std::ptrdiff_t>(j));
      return true;
    }
  }
  return false;
}

std::vector<Polygon> ConvexRegions(const OuterFace& face) {
  const FaceFrame frame(face);
  std::vector<Polygon> polygons;
  for (const std::vector<Vector3>& outline : face.region) {
    std::vector<Vector2> flat;
    for (const Vector3& corner : outline) flat.push_back(frame.Flat(corner));
    Polygon polygon = CleanHull(flat);
    if (polygon.size() >= 3) polygons.push_back(std::move(polygon));
  }
  while (MergeOnePair(polygons)) {
  }
  return polygons;
}

Side MakeSide(Polyhedron shape, double sign, ModelTolerance::Of tolerance) {
  Side side{std::move(shape), sign, tolerance, {}};
  for (const OuterFace& face : side.shape.faces) side.regions.push_back(ConvexRegions(face));
  return side;
}

// 0 inside.
double DistanceToPolygon(const Vector2& p, const Polygon& polygon) {
  if (geometry::Depth(polygon, p) >= 0) return 0;
  double distance = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    distance =
        std::min(distance, DistanceToSegment(p, polygon[i], polygon[(i + 1) % polygon.size()]));
  }
  return distance;
}

std::vector<int> FacesThrough(const Side& side, const Vector3& p) {
  std::vector<int> faces;
  for (std::size_t i = 0; i < side.shape.faces.size(); ++i) {
    const OuterFace& face = side.shape.faces[i];
    if (std::abs(face.normal.dot(p) - face.height) > kSamePoint) continue;
    const Vector2 flat = FaceFrame(face).Flat(p);
    const auto touches = [&](const Polygon& polygon) {
      return DistanceToPolygon(flat, polygon) < kSamePoint;
    };
    if (std::ranges::any_of(side.regions[i], touches)) faces.push_back(static_cast<int>(i));
  }
  return faces;
}

// Of the edge's line, at the points of both lines that are nearest to each other.
struct Crossing {
  double s = 0;  // metres from the start of the first edge
  double t = 0;
};

Crossing CrossingOf(const OuterEdge& a, const OuterEdge& b) {
  const Vector3 u = a.direction();
  const Vector3 v = b.direction();
  const Vector3 between = a.start - b.start;
  const double c = u.dot(v);
  const double sine2 = 1 - c * c;
  return {(c * v - u).dot(between) / sine2, (v - c * u).dot(between) / sine2};
}

double LengthOf(const OuterEdge& edge) { return (edge.end - edge.start).norm(); }

double DistanceToEdge(const Vector3& p, const OuterEdge& edge) {
  const double s = std::clamp((p - edge.start).dot(edge.direction()), 0.0, LengthOf(edge));
  return (p - edge.start - s * edge.direction()).norm();
}

// Of edges that are not parallel.
double DistanceBetween(const OuterEdge& a, const OuterEdge& b, const Crossing& at) {
  if (at.s >= 0 && at.s <= LengthOf(a) && at.t >= 0 && at.t <= LengthOf(b)) {
    return (a.start + at.s * a.direction() - b.start - at.t * b.direction()).norm();
  }
  return std::min({DistanceToEdge(a.start, b), DistanceToEdge(a.end, b), DistanceToEdge(b.start, a),
                   DistanceToEdge(b.end, a)});
}

// The direction in face edge.faces[which], perpendicular to the edge, that leads into the face. A
// convex edge's faces fall away behind each other's plane.
Vector3 IntoFace(const Polyhedron& shape, const OuterEdge& edge, std::size_t which) {
  const Vector3& own = shape.faces[static_cast<std::size_t>(edge.faces[which])].normal;
  const Vector3& other = shape.faces[static_cast<std::size_t>(edge.faces[1 - which])].normal;
  return (other.dot(own) * own - other).normalized();
}

// The parts are on their own sides of the plane through two crossing edges: all that leaves the
// moving edge goes up n, or along the plane, and all that leaves the stationary edge goes down.
bool Separates(const Vector3& n, const Polyhedron& moving, const OuterEdge& moving_edge,
               const Polyhedron& stationary, const OuterEdge& stationary_edge, double slack) {
  for (std::size_t which : {0U, 1U}) {
    if (n.dot(IntoFace(moving, moving_edge, which)) < -slack) return false;
    if (n.dot(IntoFace(stationary, stationary_edge, which)) > slack) return false;
  }
  return true;
}

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

class ContactFinder {
 public:
  ContactFinder(const Polyhedron& moving, const Polyhedron& stationary,
                const Pose& X_StationaryMoving, double reach,
                const std::vector<ModelTolerance>& tolerances, double turn)
      : moving_(
            MakeSide(Transformed(moving, X_StationaryMoving), 1, ModelTolerance::Of::kMovingFaces)),
        stationary_(MakeSide(stationary, -1, ModelTolerance::Of::kStationaryFaces)),
        origin_(X_StationaryMoving.translation()),
        reach_(reach),
        turn_(turn),
        tolerances_(tolerances) {
    for (const ModelTolerance& tolerance : tolerances) {
      const bool of_moving = tolerance.of == ModelTolerance::Of::kMovingFaces;
      const std::size_t count = (of_moving ? moving : stationary).faces.size();
      for (const int face : tolerance.faces) {
        ASSAY_CHECK(face >= 0 && static_cast<std::size_t>(face) < count, "{}: no face {}",
                    tolerance.name, face);
      }
    }
  }

  std::vector<PrimitiveContact> Find() {
    FindVerticesOnFaces(moving_, stationary_);
    FindVerticesOnFaces(stationary_, moving_);
    for (std::size_t i = 0; i < moving_.shape.edges.size(); ++i) {
      for (std::size_t j = 0; j < stationary_.shape.edges.size(); ++j) FindEdgeOnEdge(i, j);
    }
    return std::move(contacts_);
  }

 private:
  using Index = std::size_t;

  void FindVerticesOnFaces(const Side& with_vertex, const Side& with_face) {
    for (Index i = 0; i < with_vertex.shape.vertices.size(); ++i) {
      for (Index j = 0; j < with_face.shape.faces.size(); ++j) {
        FindVertexOnFace(with_vertex, i, with_face, j);
      }
    }
  }

  void FindVertexOnFace(const Side& with_vertex, Index vertex, const Side& with_face, Index face) {
    const OuterFace& plane = with_face.shape.faces[face];
    const Vector3& p = with_vertex.shape.vertices[vertex].p;
    const double gap = plane.normal.dot(p) - plane.height;
    if (std::abs(gap) > reach_) return;
    const auto overlaps = OverlapLimits(with_vertex, vertex, plane.normal);
    if (!overlaps) return;
    const Vector2 flat = FaceFrame(plane).Flat(p);
    for (const Polygon& region : with_face.regions[face]) {
      if (std::hypot(gap, DistanceToPolygon(flat, region)) > reach_) continue;
      const Side& moves = with_vertex.sign > 0 ? with_vertex : with_face;
      const bool moving_vertex = &moves == &with_vertex;
      PrimitiveContact contact;
      contact.kind = moving_vertex ? ContactKind::kVertexFace : ContactKind::kFaceVertex;
      contact.moving = static_cast<int>(moving_vertex ? vertex : face);
      contact.stationary = static_cast<int>(moving_vertex ? face : vertex);
      contact.offset = gap;
      contact.normal = with_vertex.sign * plane.normal;
      contact.at = p - origin_;
      const Shift shift = ShiftAt(with_vertex, p) - ShiftOf(with_face, {static_cast<int>(face)});
      contact.row = RowOf(contact.normal, contact.at, shift.transpose() * plane.normal);
      contact.limits = *overlaps;
      AddNearest(ExtentLimits(with_vertex, p, with_face, face, region), contact);
      Keep(std::move(contact));
    }
  }

  // No edge that leaves the vertex may go behind the face. Only those that lie in it can, in small
  // motions, or nearly so in larger ones. Empty: one goes behind the face whatever the motion, so
  // the vertex cannot touch it.
  std::optional<std::vector<HalfSpace>> OverlapLimits(const Side& side, Index vertex,
                                                      const Vector3& n) const {
    std::vector<HalfSpace> limits;
    const OuterVertex& corner = side.shape.vertices[vertex];
    for (const int index : corner.edges) {
      const OuterEdge& edge = side.shape.edges[static_cast<Index>(index)];
      const bool from_start =
          (edge.start - corner.p).squaredNorm() < (edge.end - corner.p).squaredNorm();
      const Vector3 leaving = from_start ? edge.direction() : Vector3(-edge.direction());
      const double rise = n.dot(leaving);
      if (rise < -kSameDirection - turn_) return std::nullopt;
      if (rise < kSameDirection + turn_) {
        limits.push_back(Turn(side.sign * n.cross(leaving), rise));
      }
    }
    return limits;
  }

  // The vertex stays on this region of the face.
  std::vector<HalfSpace> ExtentLimits(const Side& with_vertex, const Vector3& p,
                                      const Side& with_face, Index face,
                                      const Polygon& region) const {
    const FaceFrame frame(with_face.shape.faces[face]);
    const Shift vertex_shift = ShiftAt(with_vertex, p);
    std::vector<HalfSpace> limits;
    for (Index i = 0; i < region.size(); ++i) {
      const Vector2& start = region[i];
      const Vector2& end = region[(i + 1) % region.size()];
      const Vector2 along = (end - start).normalized();
      const Vector3 outward = frame.Turned({along.y(), -along.x()});
      const Vector3 middle = frame.Raised((start + end) / 2);
      const Shift shift = vertex_shift - ShiftAt(with_face, middle);
      limits.push_back({RowOf(with_vertex.sign * outward, p - origin_, shift.transpose() * outward),
                        outward.dot(middle - p)});
    }
    return limits;
  }

  void FindEdgeOnEdge(Index moving, Index stationary) {
    const OuterEdge& a = moving_.shape.edges[moving];
    const OuterEdge& b = stationary_.shape.edges[stationary];
    Vector3 n = a.direction().cross(b.direction());
    const double sine = n.norm();
    if (sine < kSameDirection + turn_) return;  // they may be parallel
    n.normalize();
    const double slack = kSameDirection + turn_ / sine;  // how much n may turn
    const Crossing crossing = CrossingOf(a, b);
    if (DistanceBetween(a, b, crossing) > reach_) return;
    if (!Separates(n, moving_.shape, a, stationary_.shape, b, slack)) n = -n;
    if (!Separates(n, moving_.shape, a, stationary_.shape, b, slack)) return;
    const Vector3 at = a.start + crossing.s * a.direction();
    PrimitiveContact contact;
    contact.kind = ContactKind::kEdgeEdge;
    contact.moving = static_cast<int>(moving);
    contact.stationary = static_cast<int>(stationary);
    contact.offset = n.dot(at - b.start);
    contact.normal = n;
    contact.at = at - origin_;
    contact.row = RowOf(n, contact.at, EdgeShift(a, b).transpose() * n);
    contact.limits = OrientationLimits(a, b, n, slack);
    AddNearest(RangeLimits(a, b, crossing), contact);
    Keep(std::move(contact));
  }

  // A face of one edge that lies in the plane of both, or nearly: the half of the other edge that
  // is over it must not go behind it. (Where the edges are at right angles, that is the condition
  // on inward directions with n held fixed; elsewhere n turns with the moving edge, which this
  // accounts for.)
  std::vector<HalfSpace> OrientationLimits(const OuterEdge& a, const OuterEdge& b, const Vector3& n,
                                           double slack) const {
    std::vector<HalfSpace> limits;
    const auto add = [&](const Side& side, const OuterEdge& edge, const OuterEdge& other) {
      for (std::size_t which : {0U, 1U}) {
        const Vector3 into = IntoFace(side.shape, edge, which);
        if (std::abs(n.dot(into)) > slack) continue;
        const Vector3& normal = side.shape.faces[static_cast<Index>(edge.faces[which])].normal;
        const double over = other.direction().dot(into) < 0 ? -1 : 1;
        limits.push_back(Turn(-side.sign * over * normal.cross(other.direction()),
                              over * normal.dot(other.direction())));
      }
    };
    add(moving_, a, b);
    add(stationary_, b, a);
    return limits;
  }

  // The point where the edges cross stays between the ends of both.
  std::vector<HalfSpace> RangeLimits(const OuterEdge& a, const OuterEdge& b,
                                     const Crossing& crossing) const {
    const Vector3 u = a.direction();
    const Vector3 v = b.direction();
    const Vector3 r = a.start + crossing.s * u - origin_;
    const double c = u.dot(v);
    const Shift shift = EdgeShift(a, b);
    std::vector<HalfSpace> limits;
    const auto add = [&](const Side& side, const OuterEdge& edge, double s, const Vector3& slide) {
      const Eigen::VectorXd along = RowOf(slide, r, shift.transpose() * slide);
      limits.push_back({EndShift(side, edge, edge.start) - along, s});
      limits.push_back({along - EndShift(side, edge, edge.end), LengthOf(edge) - s});
    };
    add(moving_, a, crossing.s, (c * v - u) / (1 - c * c));
    add(stationary_, b, crossing.t, (v - c * u) / (1 - c * c));
    return limits;
  }

  // How far an end of an edge goes along it.
  Eigen::VectorXd EndShift(const Side& side, const OuterEdge& edge, const Vector3& end) const {
    const Shift shift = ShiftAt(side, end);
    return RowOf(Vector3::Zero(), Vector3::Zero(), shift.transpose() * edge.direction());
  }

  // Of the moving edge's line relative to the stationary one's, each across its direction.
  Shift EdgeShift(const OuterEdge& a, const OuterEdge& b) const {
    return ShiftOf(moving_, {a.faces[0], a.faces[1]}) -
           ShiftOf(stationary_, {b.faces[0], b.faces[1]});
  }

  // Of a corner, or of a point of an edge or face.
  Shift ShiftAt(const Side& side, const Vector3& p) const {
    return ShiftOf(side, tolerances_.empty() ? std::vector<int>() : FacesThrough(side, p));
  }

  // Of the point (line, plane) where these faces' planes meet: the least motion that keeps it in
  // all of them. Where more than three planes meet and do not any longer, the nearest to all.
  Shift ShiftOf(const Side& side, const std::vector<int>& faces) const {
    Shift shift = Shift::Zero(3, static_cast<Eigen::Index>(tolerances_.size()));
    if (tolerances_.empty()) return shift;
    Eigen::MatrixX3d normals(faces.size(), 3);
    Eigen::MatrixXd outward = Eigen::MatrixXd::Zero(normals.rows(), shift.cols());
    for (Eigen::Index row = 0; row < normals.rows(); ++row) {
      const int face = faces[static_cast<Index>(row)];
      normals.row(row) = side.shape.faces[static_cast<Index>(face)].normal;
      for (Eigen::Index column = 0; column < shift.cols(); ++column) {
        const ModelTolerance& tolerance = tolerances_[static_cast<Index>(column)];
        if (tolerance.of != side.tolerance) continue;
        outward(row, column) = std::ranges::count(tolerance.faces, face) > 0 ? 1 : 0;
      }
    }
    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> decomposition;
    decomposition.setThreshold(kSameDirection);
    decomposition.compute(normals);
    shift = decomposition.solve(outward);
    return shift;
  }

  // direction . (d + w x r), and what the tolerances add to it.
  Eigen::VectorXd RowOf(const Vector3& direction, const Vector3& r,
                        const Eigen::VectorXd& tolerances) const {
    Eigen::VectorXd row(kPoseDimensions + tolerances.size());
    row << direction, r.cross(direction), tolerances;
    return row;
  }

  // axis . w <= rise, of which rounding is left out.
  HalfSpace Turn(const Vector3& axis, double rise) const {
    HalfSpace limit;
    limit.b = std::abs(rise) < kSameDirection ? 0 : rise;
    limit.a.setZero(kPoseDimensions + static_cast<Eigen::Index>(tolerances_.size()));
    limit.a.segment<3>(3) = axis;
    return limit;
  }

  // Ends that are far away cannot be reached in the range where rows are good. Those within reach
  // stay even if they are many: a face or an edge narrower than that.
  void AddNearest(std::vector<HalfSpace> ends, PrimitiveContact& contact) const {
    std::ranges::stable_sort(ends, {}, &HalfSpace::b);
    for (HalfSpace& end : ends) {
      if (contact.limits.size() >= kUsualLimits && end.b > reach_) break;
      contact.limits.push_back(std::move(end));
    }
  }

  void Keep(PrimitiveContact contact) {
    const auto same = [&](const PrimitiveContact& other) { return Same(other, contact); };
    if (std::ranges::none_of(contacts_, same)) contacts_.push_back(std::move(contact));
  }

  Side moving_;
  Side stationary_;
  Vector3 origin_;
  double reach_;
  double turn_;
  const std::vector<ModelTolerance>& tolerances_;
  std::vector<PrimitiveContact> contacts_;
};

}  // namespace

std::vector<PrimitiveContact> PrimitiveContacts(const Polyhedron& moving,
                                                const Polyhedron& stationary,
                                                const Pose& X_StationaryMoving, double reach,
                                                const std::vector<ModelTolerance>& tolerances,
                                                double turn) {
  return ContactFinder(moving, stationary, X_StationaryMoving, reach, tolerances, turn).Find();
}

std::string Name(const PrimitiveContact& contact) {
  const auto pair = [&](const char* moving, const char* stationary) {
    return fmt::format("{} {} on {} {}", moving, contact.moving, stationary, contact.stationary);
  };
  switch (contact.kind) {
    case ContactKind::kVertexFace:
      return pair("vertex", "face");
    case ContactKind::kFaceVertex:
      return pair("face", "vertex");
    case ContactKind::kEdgeEdge:
      return pair("edge", "edge");
  }
  ASSAY_CHECK(false, "no such kind of contact");
}

}  // namespace assay::finemotion
