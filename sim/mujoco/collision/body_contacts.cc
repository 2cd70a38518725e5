#include "sim/mujoco/collision/body_contacts.h"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

#include "planner/geometry/contact/contact_manifold.h"
#include "planner/geometry/contact/contact_patch.h"
#include "sim/mujoco/collision/inner_faces.h"

namespace assay::mujoco {
namespace {

using geometry::ContactManifold;
using geometry::Pose;
using geometry::Vector3;

constexpr double kOnePlane = 1e-5;       // m
constexpr double kOneNormal = 1 - 1e-9;  // cosine
constexpr double kOnePlaceOfTwo = 1e-6;  // m

Pose GeomPose(const mjData& d, int geom) {
  Pose X = Pose::Identity();
  X.translation() = Eigen::Map<const Vector3>(d.geom_xpos + 3 * geom);
  X.linear() =
      Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(d.geom_xmat + 9 * geom);
  return X;
}

// Returns whether the collision of two geoms is decided here, and may find something.
bool MayTouch(const mjModel& m, const mjData& d, int a, int b, double margin) {
  const auto is_mesh = [&](int geom) { return m.geom_type[geom] == mjGEOM_MESH; };
  const auto is_ours = [&](int geom) {
    return is_mesh(geom) || m.geom_type[geom] == mjGEOM_BOX || m.geom_type[geom] == mjGEOM_PLANE;
  };
  if (!(is_mesh(a) || is_mesh(b)) || !is_ours(a) || !is_ours(b)) return false;
  if ((m.geom_contype[a] & m.geom_conaffinity[b]) == 0 &&
      (m.geom_contype[b] & m.geom_conaffinity[a]) == 0) {
    return false;
  }
  if (m.geom_rbound[a] == 0 || m.geom_rbound[b] == 0) return true;  // a plane
  const double reach = m.geom_rbound[a] + m.geom_rbound[b] + margin;
  return mju_dist3(d.geom_xpos + 3 * a, d.geom_xpos + 3 * b) <= reach;
}

// Returns the contact of the geoms g1 and g2, which are in the engine's order: by type, then by
// body. Returns none if the geoms are more than `margin` apart.
std::optional<ContactManifold> Manifold(const mjModel& m, const mjData& d,
                                        const ConvexPieces& pieces, int g1, int g2, double margin) {
  const Pose X_WorldFirst = GeomPose(d, g1);
  const Pose X_WorldSecond = GeomPose(d, g2);
  if (m.geom_type[g1] == mjGEOM_PLANE) {
    const Vector3 normal = X_WorldFirst.linear().col(2);
    const geometry::Plane plane{normal, normal.dot(X_WorldFirst.translation())};
    return geometry::ContactBetween(plane, *pieces.SolidOf(g2), X_WorldSecond, margin);
  }
  return geometry::ContactBetween(*pieces.SolidOf(g1), X_WorldFirst, *pieces.SolidOf(g2),
                                  X_WorldSecond, margin);
}

// Contacts of one plane between two bodies, with the same parameters.
struct Patch {
  std::vector<PieceContact> contacts;

  bool Takes(const mjModel& m, const PieceContact& contact) const {
    const PieceContact& own = contacts.front();
    // The engine may have the bodies in either order.
    const bool is_turned = m.geom_bodyid[own.geom1] != m.geom_bodyid[contact.geom1];
    const Vector3 normal = is_turned ? Vector3(-contact.normal) : contact.normal;
    const int first = is_turned ? contact.geom2 : contact.geom1;
    const int second = is_turned ? contact.geom1 : contact.geom2;
    return own.normal.dot(normal) > kOneNormal &&
           std::abs(own.normal.dot(contact.at - own.at)) < kOnePlane &&
           AreAlike(m, own.geom1, first) && AreAlike(m, own.geom2, second);
  }

  static bool AreAlike(const mjModel& m, int a, int b) {
    return m.geom_condim[a] == m.geom_condim[b] &&
           std::equal(m.geom_friction + 3 * a, m.geom_friction + 3 * a + 3,
                      m.geom_friction + 3 * b);
  }

  void AddOnce(const PieceContact& contact) {
    const auto is_same = [&](const PieceContact& other) {
      return (other.at - contact.at).norm() < kOnePlaceOfTwo;
    };
    if (std::ranges::none_of(contacts, is_same)) contacts.push_back(contact);
  }

  void AppendOutermost(std::vector<PieceContact>& all) const {
    std::vector<Vector3> points;
    for (const PieceContact& contact : contacts) points.push_back(contact.at);
    points = geometry::Outermost(points, contacts.front().normal, geometry::kMostContactPoints);
    std::ranges::copy_if(contacts, std::back_inserter(all), [&](const PieceContact& contact) {
      return std::ranges::find(points, contact.at) != points.end();
    });
  }
};

void AddToPatches(const mjModel& m, const PieceContact& contact, std::vector<Patch>& patches) {
  const auto patch = std::ranges::find_if(
      patches, [&](const Patch& candidate) { return candidate.Takes(m, contact); });
  if (patch == patches.end()) {
    patches.push_back({{contact}});
  } else {
    patch->AddOnce(contact);
  }
}

void AddContactsOf(const mjModel& m, const mjData& d, const ConvexPieces& pieces, int g1, int g2,
                   std::vector<Patch>& patches) {
  const double margin = std::max(m.geom_margin[g1], m.geom_margin[g2]);
  if (!MayTouch(m, d, g1, g2, margin)) return;
  if (m.geom_type[g1] > m.geom_type[g2]) std::swap(g1, g2);
  const std::optional<ContactManifold> manifold = Manifold(m, d, pieces, g1, g2, margin);
  if (!manifold) return;
  for (const ContactManifold::Point& point : manifold->points) {
    if (IsInsideBody(m, d, pieces, {g1, g2, point.at, manifold->normal, point.separation})) {
      continue;
    }
    AddToPatches(m, {g1, g2, point.at, manifold->normal, point.separation}, patches);
  }
}

}  // namespace

std::vector<PieceContact> ContactsOfBodies(const mjModel& m, const mjData& d,
                                           const ConvexPieces& pieces, int body1, int body2) {
  std::vector<Patch> patches;
  const auto geoms_end = [&](int body) { return m.body_geomadr[body] + m.body_geomnum[body]; };
  for (int a = m.body_geomadr[body1]; a < geoms_end(body1); ++a) {
    for (int b = m.body_geomadr[body2]; b < geoms_end(body2); ++b) {
      AddContactsOf(m, d, pieces, a, b, patches);
    }
  }
  std::vector<PieceContact> contacts;
  for (const Patch& patch : patches) patch.AppendOutermost(contacts);
  return contacts;
}

}  // namespace assay::mujoco
