#include "sim/mujoco/collision/convex_pieces.h"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <utility>

#include "planner/geometry/box.h"
#include "planner/geometry/coordinates.h"
#include "planner/geometry/hull.h"

namespace assay::mujoco {
namespace {

using geometry::ContactSolid;
using geometry::Plane;
using geometry::Pose;
using geometry::Vector3;

// The tolerance relative to the size of a mesh. It is ten times the rounding error of the mesh's
// vertices.
constexpr double kMeshPrecision = 1e-6;

thread_local CollidingPieces* present_pass = nullptr;

// The engine has moved the vertices into another frame and rounded them to single precision, so
// that the corners of a facet are no longer in one plane.
std::shared_ptr<const ContactSolid> SolidOfMesh(const mjModel& m, int mesh) {
  std::vector<Vector3> points;
  Eigen::AlignedBox3d bounds;
  const float* const first = m.mesh_vert + 3 * m.mesh_vertadr[mesh];
  for (int i = 0; i < m.mesh_vertnum[mesh]; ++i) {
    bounds.extend(points.emplace_back(first[3 * i], first[3 * i + 1], first[3 * i + 2]));
  }
  const double tolerance = kMeshPrecision * bounds.diagonal().norm();
  return std::make_shared<ContactSolid>(geometry::HullOf(points, tolerance));
}

std::shared_ptr<const ContactSolid> SolidOfBox(const mjModel& m, int geom) {
  const Vector3 half_extents = Eigen::Map<const Vector3>(m.geom_size + 3 * geom);
  return std::make_shared<ContactSolid>(geometry::HullOf({Pose::Identity(), half_extents}));
}

Pose PoseInBody(const mjModel& m, int geom) {
  const mjtNum* const turn = m.geom_quat + 4 * geom;
  Pose X = Pose::Identity();
  X.translation() = Eigen::Map<const Vector3>(m.geom_pos + 3 * geom);
  X.linear() = Eigen::Quaterniond(turn[0], turn[1], turn[2], turn[3]).toRotationMatrix();
  return X;
}

// The heights of a solid's lowest and highest point over a plane.
struct Extent {
  double low = 0;
  double high = 0;
};
Extent Over(const Plane& plane, const ContactSolid& solid, const Pose& X_PlaneSolid) {
  const Vector3 normal = X_PlaneSolid.linear().transpose() * plane.normal;
  const Eigen::VectorXd along = solid.vertices * normal;
  const double above = plane.Above(X_PlaneSolid.translation());
  return {along.minCoeff() + above, along.maxCoeff() + above};
}

// Returns whether the other solid may lie against a facet: it has points just above the facet's
// plane, and no side of the facet separates it from the facet.
bool MayCover(const ContactSolid& solid, int facet, const ContactSolid& other,
              const Pose& X_SolidOther) {
  const Extent over = Over(solid.PlaneOf(facet), other, X_SolidOther);
  if (over.high < kFlush || over.low > 5 * kFlush) return false;
  return std::ranges::none_of(solid.borders[facet], [&](const Plane& border) {
    return Over(border, other, X_SolidOther).low > 5 * kFlush;
  });
}

}  // namespace

ConvexPieces::ConvexPieces(const mjModel& m) : pieces_(m.ngeom) {
  std::vector<std::shared_ptr<const ContactSolid>> of_mesh(m.nmesh);
  for (int geom = 0; geom < m.ngeom; ++geom) {
    if (m.geom_type[geom] == mjGEOM_BOX) pieces_[geom].solid = SolidOfBox(m, geom);
    if (m.geom_type[geom] != mjGEOM_MESH) continue;
    const int mesh = m.geom_dataid[geom];
    if (!of_mesh[mesh]) of_mesh[mesh] = SolidOfMesh(m, mesh);
    pieces_[geom].solid = of_mesh[mesh];
  }
  for (int geom = 0; geom < m.ngeom; ++geom) {
    if (pieces_[geom].solid) pieces_[geom].covered = FacetsCovered(m, geom);
  }
}

std::vector<ConvexPieces::CoveredFacet> ConvexPieces::FacetsCovered(const mjModel& m,
                                                                    int geom) const {
  const ContactSolid& solid = *SolidOf(geom);
  const Pose X_GeomBody = PoseInBody(m, geom).inverse();
  const int first = m.body_geomadr[m.geom_bodyid[geom]];
  const int count = m.body_geomnum[m.geom_bodyid[geom]];
  std::vector<CoveredFacet> facets;
  for (int f = 0; f < static_cast<int>(solid.hull.facets.size()); ++f) {
    CoveredFacet covered{f, {}};
    for (int other = first; other < first + count; ++other) {
      if (other == geom || SolidOf(other) == nullptr) continue;
      const Pose X_GeomOther = X_GeomBody * PoseInBody(m, other);
      if (MayCover(solid, f, *SolidOf(other), X_GeomOther)) covered.by.push_back(other);
    }
    if (!covered.by.empty()) facets.push_back(std::move(covered));
  }
  return facets;
}

CollidingPieces::CollidingPieces(const ConvexPieces* pieces)
    : pieces_(pieces), before_(std::exchange(present_pass, this)) {}
CollidingPieces::~CollidingPieces() { present_pass = before_; }

const ConvexPieces* CollidingPieces::Present() {
  return present_pass == nullptr ? nullptr : present_pass->pieces_;
}

std::map<CollidingPieces::BodyPair, std::vector<PieceContact>>& CollidingPieces::Contacts() {
  return present_pass->contacts_;
}

}  // namespace assay::mujoco
