#include "sim/check/measurements/fit.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "planner/domain/matings/shaft_fit.h"
#include "planner/geometry/pose.h"

namespace assay::check {
namespace {

using domain::Feature;
using domain::PartModel;
using geometry::Pose;
using geometry::Vector3;

constexpr double kParallel = 1e-6;  // of unit vectors
constexpr double kTipLayer = 1e-6;  // metres
constexpr double kOnPlane = 1e-9;   // metres

bool IsHole(const Feature& feature) { return !feature.mouths.empty(); }
bool IsShaft(const Feature& feature) { return !IsHole(feature) && !feature.is_plain_face(); }

// Returns the part of a convex outline that lies behind the plane of a face.
std::vector<Vector3> Behind(const domain::Face& face, const std::vector<Vector3>& outline) {
  std::vector<Vector3> behind;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vector3& p = outline[i];
    const Vector3& q = outline[(i + 1) % outline.size()];
    const double at_p = face.normal.dot(p) - face.offset;
    const double at_q = face.normal.dot(q) - face.offset;
    if (at_p <= kOnPlane) behind.push_back(p);
    if (std::min(at_p, at_q) < -kOnPlane && std::max(at_p, at_q) > kOnPlane) {
      behind.emplace_back(p + at_p / (at_p - at_q) * (q - p));
    }
  }
  return behind;
}

// Returns the corners of a shaft's faces in the frame of the feature, where z = 0 at the tip. A
// face that goes on beyond the shaft is cut off at the shaft's sides. An example is a face that is
// the tip of both shaft and key.
std::vector<Vector3> Corners(const PartModel& model, const Feature& shaft) {
  const Pose X_FeaturePart = shaft.X_PartFeature.inverse();
  const Vector3 axis = shaft.X_PartFeature.linear().col(2);
  std::vector<Vector3> corners;
  for (const domain::FaceId id : shaft.faces) {
    const domain::Face& face = model.faces()[id.index()];
    for (const geometry::Polygon& patch : face.patches) {
      std::vector<Vector3> outline;
      for (const geometry::Vector2& p : patch) {
        outline.push_back(face.X_PartFace * Vector3(p.x(), p.y(), 0));
      }
      for (const domain::FaceId other : shaft.faces) {
        const domain::Face& side = model.faces()[other.index()];
        if (std::abs(side.normal.dot(axis)) < kParallel) outline = Behind(side, outline);
      }
      for (const Vector3& p : outline) corners.push_back(X_FeaturePart * p);
    }
  }
  return corners;
}

// A shaft and its hole. Either part may be the one that moves.
class Fit {
 public:
  Fit(const PartModel& hole_model, const Feature& hole, const PartModel& shaft_model,
      const Feature& shaft)
      : hole_(hole), shaft_(shaft), corners_(Corners(shaft_model, shaft)) {
    const Vector3 axis = hole.X_PartFeature.linear().col(2);
    for (const domain::Wall& wall : hole.walls) {
      const domain::Face& face = hole_model.faces()[wall.face.index()];
      if (std::abs(face.normal.dot(axis)) < kParallel) walls_.push_back(&face);
    }
  }

  // Returns how far the tip is behind the mouth. X_HoleShaft maps the shaft part's frame to the
  // hole part's.
  double Depth(const Pose& X_HoleShaft) const {
    return -(hole_.X_PartFeature.inverse() * X_HoleShaft * shaft_.X_PartFeature).translation().z();
  }

  // Returns how far the corners that are at most `engaged` behind the tip are inside the walls.
  double InsideWalls(const Pose& X_HoleShaft, double engaged) const {
    double worst = kInfinity;
    for (const Vector3& corner : corners_) {
      if (corner.z() < -kTipLayer - shaft_.chamfer && engaged <= 0) continue;
      // A corner outside the hole counts as the point on its edge where the shaft passes the mouth.
      // A corner where the bevel of the tip ends counts as if there was no bevel.
      const Vector3 inside(corner.x(), corner.y(), std::max(corner.z(), -engaged));
      const Vector3 p = X_HoleShaft * shaft_.X_PartFeature * inside;
      for (const domain::Face* wall : walls_) {
        worst = std::min(worst, wall->normal.dot(p) - wall->offset);
      }
    }
    return worst;
  }

  double bevel() const { return hole_.chamfer + shaft_.chamfer; }

 private:
  const Feature& hole_;
  const Feature& shaft_;
  std::vector<Vector3> corners_;
  std::vector<const domain::Face*> walls_;  // the sides of the hole
};

Pose MovedOn(const Motion& motion, double distance) {
  return geometry::Translation(distance * motion.direction) * motion.X_FixedHeld;
}

void Narrow(const Fit& fit, const domain::Mating& mating, const Motion& motion, bool held_is_shaft,
            FitMargins& margins) {
  const auto seen = [&](const Pose& X_FixedHeld) {
    return held_is_shaft ? X_FixedHeld : X_FixedHeld.inverse();
  };
  // The distance to the nominal seat is measured along the true direction of the motion. The held
  // part counts as seated after it has moved by this distance in this direction.
  const Vector3 way = mating.X_FixedHeld.translation() - motion.X_FixedHeld.translation();
  const Pose seated = MovedOn(motion, way.dot(motion.direction));
  const double depth = std::max(0.0, fit.Depth(seen(seated)));
  const Pose entering = MovedOn(motion, way.dot(motion.direction) - depth);
  const double in_mouth = fit.InsideWalls(seen(entering), 0);
  margins.entry = std::min(margins.entry, in_mouth + fit.bevel());
  margins.slide_in = std::min({margins.slide_in, in_mouth, fit.InsideWalls(seen(seated), depth)});
}

}  // namespace

FitMargins MarginsOfFits(const domain::Problem& problem, const domain::Mating& mating,
                         const Motion& motion) {
  FitMargins margins = {.entry = kInfinity, .slide_in = kInfinity};
  const PartModel& held_model = *problem.part(mating.held).model;
  const PartModel& fixed_model = *problem.part(mating.fixed).model;
  for (const auto& [of_held, of_fixed] : mating.features) {
    const Feature& held = *held_model.FindFeature(of_held);
    const Feature& fixed = *fixed_model.FindFeature(of_fixed);
    if (IsShaft(held) && IsHole(fixed)) {
      Narrow(Fit(fixed_model, fixed, held_model, held), mating, motion, true, margins);
    } else if (IsHole(held) && IsShaft(fixed)) {
      Narrow(Fit(held_model, held, fixed_model, fixed), mating, motion, false, margins);
    }
  }
  return margins;
}

std::vector<Lean> LeansInSlots(const domain::Problem& problem, const domain::Mating& mating,
                               const Motion& motion) {
  std::vector<Lean> leans;
  for (const domain::ShaftFit& fit : domain::FitsOf(problem, mating)) {
    const Pose X_HoleShaft = fit.shaft_is_held ? motion.X_FixedHeld : motion.X_FixedHeld.inverse();
    const Vector3 axis = X_HoleShaft.linear() * fit.shaft.X_PartFeature.linear().col(2);
    for (const domain::Slot& slot : domain::SlotsOf(domain::SideWalls(fit, 0))) {
      leans.push_back({NameOf(fit, slot), std::abs(slot.across.dot(axis))});
    }
  }
  return leans;
}

}  // namespace assay::check
