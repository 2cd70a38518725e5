#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "planner/geometry/contact/contact_solid.h"
#include "planner/geometry/hull.h"
#include "tests/oracle/random_pose.h"

namespace assay::geometry {

inline ContactSolid RandomSolid(RandomStream& random, int points) {
  std::vector<Vector3> cloud;
  for (int i = 0; i < points; ++i) cloud.push_back(oracle::RandomVector(random, 1));
  return ContactSolid(HullOf(cloud));
}

// Returns a regular prism about the z axis, as the hull of its corners.
inline ContactSolid RegularPrism(int sides, double radius, double half_height) {
  std::vector<Vector3> corners;
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * std::numbers::pi * i / sides;
    for (const double z : {-half_height, half_height}) {
      corners.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
    }
  }
  return ContactSolid(HullOf(corners));
}

inline ContactSolid BoxSolid(double x, double y, double z) {
  return ContactSolid(HullOf(Box{Pose::Identity(), Vector3(x, y, z)}));
}

// Returns the gap between two solids along a direction, by definition. It is negative if they
// overlap along it.
inline double GapAlong(const Vector3& direction, const ContactSolid& a, const Pose& X_WorldA,
                       const ContactSolid& b, const Pose& X_WorldB) {
  double end_of_a = -1e9;
  double start_of_b = 1e9;
  for (const Vector3& p : a.hull.vertices) {
    end_of_a = std::max(end_of_a, direction.dot(X_WorldA * p));
  }
  for (const Vector3& p : b.hull.vertices) {
    start_of_b = std::min(start_of_b, direction.dot(X_WorldB * p));
  }
  return start_of_b - end_of_a;
}

// Returns the greatest gap along many directions: random ones, then ever smaller changes of the
// best one. No gap along a direction is greater than that along the best axis.
inline double GreatestGap(RandomStream& random, const ContactSolid& a, const Pose& X_WorldA,
                          const ContactSolid& b, const Pose& X_WorldB) {
  Vector3 best = Vector3::UnitZ();
  double greatest = -1e9;
  double spread = 2;
  for (int i = 0; i < 3000; ++i) {
    if (i > 1000) spread = std::exp(-(i - 1000) / 120.0);
    const Vector3 direction = (best + spread * oracle::RandomVector(random, 1)).normalized();
    const double gap = GapAlong(direction, a, X_WorldA, b, X_WorldB);
    if (gap <= greatest) continue;
    greatest = gap;
    best = direction;
  }
  return greatest;
}

// Returns how far a point is outside of a solid. It is negative inside.
inline double Outside(const ContactSolid& solid, const Pose& X_WorldSolid, const Vector3& p) {
  const Vector3 local = X_WorldSolid.inverse() * p;
  double outside = -1e9;
  for (const Facet& facet : solid.hull.facets) {
    outside = std::max(outside, facet.normal.dot(local) - facet.offset);
  }
  return outside;
}

}  // namespace assay::geometry
