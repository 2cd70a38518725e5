#include "sim/render/insertion.h"

#include <algorithm>
#include <limits>
#include <numbers>

#include "planner/geometry/pose.h"

namespace assay::render {
namespace {

using domain::Mating;

// Returns the greatest distance between two corners.
double Width(const std::vector<Vector3>& corners) {
  double width = 0;
  for (const Vector3& a : corners) {
    for (const Vector3& b : corners) width = std::max(width, (a - b).norm());
  }
  return width;
}

// Returns the corners of an outline and the middles of its sides.
std::vector<geometry::Vector2> PointsOf(const geometry::Polygon& outline) {
  std::vector<geometry::Vector2> points;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    points.push_back(outline[i]);
    points.push_back((outline[i] + outline[(i + 1) % outline.size()]) / 2);
  }
  return points;
}

// Returns points of the hole's mouths, in the frame of the hole's part.
std::vector<Vector3> MouthOf(const domain::ShaftFit& fit) {
  std::vector<Vector3> points;
  for (const domain::Mouth& mouth : fit.hole.mouths) {
    const Pose& X_PartFace = fit.hole_model.faces()[mouth.face.index()].X_PartFace;
    for (const geometry::Vector2& p : PointsOf(mouth.outline)) {
      points.emplace_back(X_PartFace * Vector3(p.x(), p.y(), 0));
    }
  }
  return points;
}

// Returns points of the shaft at its tip and half an insertion depth behind the tip, in the frame
// of the shaft's part.
std::vector<Vector3> ShaftOf(const domain::ShaftFit& fit) {
  std::vector<Vector3> points;
  for (const double z : {0.0, -fit.depth / 2}) {
    for (const geometry::Vector2& p : PointsOf(domain::CrossSection(fit))) {
      points.emplace_back(fit.shaft.X_PartFeature * Vector3(p.x(), p.y(), z));
    }
  }
  return points;
}

// Returns how far the seated held part must go back until nothing of it is inside, metres. After
// this motion, the most advanced mouth or tip of the held part is level with the outermost mouth or
// tip of the fixed part.
double Engagement(const std::vector<domain::ShaftFit>& fits, const Mating& mating) {
  const Vector3 out = -mating.mating_vector.normalized();
  double fixed = -std::numeric_limits<double>::infinity();
  double held = -fixed;
  for (const domain::ShaftFit& fit : fits) {
    const domain::Feature& of_held = fit.shaft_is_held ? fit.shaft : fit.hole;
    const domain::Feature& of_fixed = fit.shaft_is_held ? fit.hole : fit.shaft;
    fixed = std::max(fixed, out.dot(of_fixed.X_PartFeature.translation()));
    held = std::min(held, out.dot(mating.X_FixedHeld * of_held.X_PartFeature.translation()));
  }
  return fixed - held;
}

}  // namespace

Insertion::Insertion(const domain::Problem& problem, const scene::Scene& scene,
                     const Mating& mating)
    : problem_(problem), scene_(scene), mating_(mating) {
  const std::vector<domain::ShaftFit> fits = domain::FitsOf(problem, mating);
  for (const domain::ShaftFit& fit : fits) {
    gap_ = std::max(gap_, Width(MouthOf(fit)));
    std::ranges::move(MarksOf(fit), std::back_inserter(marks_));
  }
  depth_ = fits.empty() ? mating.mating_vector.norm() : Engagement(fits, mating);
  if (fits.empty()) gap_ = depth_;
}

std::vector<Insertion::Mark> Insertion::MarksOf(const domain::ShaftFit& fit) const {
  std::vector<Mark> marks;
  const domain::PartId hole = fit.shaft_is_held ? mating_.fixed : mating_.held;
  const domain::PartId shaft = fit.shaft_is_held ? mating_.held : mating_.fixed;
  for (const Vector3& point : MouthOf(fit)) marks.push_back({point, hole});
  for (const Vector3& point : ShaftOf(fit)) marks.push_back({point, shaft});
  return marks;
}

double Insertion::Inserted(const mujoco::Data& data) const {
  const Pose X_FixedHeld =
      scene_.TruePose(data, mating_.fixed).inverse() * scene_.TruePose(data, mating_.held);
  const Vector3 to_seat = mating_.X_FixedHeld.translation() - X_FixedHeld.translation();
  return depth_ - to_seat.dot(mating_.mating_vector.normalized());
}

Subject Insertion::SubjectIn(const mujoco::Data& data) const {
  const Pose X_WorldFixed = scene_.TruePose(data, mating_.fixed);
  const Pose X_WorldHeld = scene_.TruePose(data, mating_.held);
  const Vector3 out = -(X_WorldFixed.linear() * mating_.mating_vector.normalized());
  const double now = Inserted(data);
  Subject subject{.framed = CornersOf(*problem_.part(mating_.fixed).model, X_WorldFixed),
                  .out = out,
                  .from_out = {std::numbers::pi / 3, std::numbers::pi / 4, std::numbers::pi / 6}};
  for (const double inserted : {-gap_, depth_}) {
    std::ranges::move(CornersOf(*problem_.part(mating_.held).model,
                                geometry::Translation((now - inserted) * out) * X_WorldHeld),
                      std::back_inserter(subject.framed));
  }
  for (const double inserted : {-gap_, 0.0, depth_ / 2}) {
    const Vector3 moved = (now - inserted) * out;
    for (const Mark& mark : marks_) {
      const bool moves = mark.part == mating_.held;
      subject.seen.push_back(
          {moves ? Vector3(X_WorldHeld * mark.p_Part + moved) : Vector3(X_WorldFixed * mark.p_Part),
           moved});
    }
  }
  return subject;
}

std::vector<mujoco::BodyId> Insertion::Moving() const {
  return {scene_.hand(), scene_.Body(mating_.held)};
}

}  // namespace assay::render
