#include "planner/kinematics/fixed_links.h"

namespace assay::kinematics {

Inertial Joined(const Inertial& a, const Inertial& b) {
  const double mass = a.mass + b.mass;
  if (mass == 0) return a;
  Inertial joined{.mass = mass, .inertia = Matrix3::Zero()};
  const Vector3 center =
      (a.mass * a.X_LinkCenter.translation() + b.mass * b.X_LinkCenter.translation()) / mass;
  joined.X_LinkCenter.translation() = center;
  for (const Inertial* body : {&a, &b}) {
    const Matrix3 R = body->X_LinkCenter.linear();
    const Vector3 d = body->X_LinkCenter.translation() - center;
    joined.inertia += R * body->inertia * R.transpose() +
                      body->mass * (d.squaredNorm() * Matrix3::Identity() - d * d.transpose());
  }
  return joined;
}

Inertial Moved(const Pose& X_NewBody, Inertial inertial) {
  inertial.X_LinkCenter = X_NewBody * inertial.X_LinkCenter;
  return inertial;
}

void AddFixedLink(const Link& link, const Pose& X_BodyLink, Link& body) {
  for (Visual visual : link.visuals) {
    visual.X_LinkShape = X_BodyLink * visual.X_LinkShape;
    body.visuals.push_back(std::move(visual));
  }
  for (Collision collision : link.collisions) {
    collision.X_LinkShape = X_BodyLink * collision.X_LinkShape;
    body.collisions.push_back(std::move(collision));
  }
  body.meshes.insert(body.meshes.end(), link.meshes.begin(), link.meshes.end());
  body.fits.insert(body.fits.end(), link.fits.begin(), link.fits.end());
  if (!link.inertial) return;
  const Inertial inertial = Moved(X_BodyLink, *link.inertial);
  body.inertial = body.inertial ? Joined(*body.inertial, inertial) : inertial;
}

}  // namespace assay::kinematics
