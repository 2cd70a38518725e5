#include "planner/domain/grasps/round_side.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/domain/parts/exposed_faces.h"
#include "planner/domain/parts/part_model.h"
#include "planner/geometry/hull.h"
#include "planner/geometry/planar_region.h"
#include "planner/geometry/solids/shadow.h"

namespace assay::domain {
namespace {

constexpr double kSameAngle = 1e-6;   // radians
constexpr double kSameRadius = 1e-6;  // metres
constexpr double kTurn = 2 * std::numbers::pi;
constexpr double kWidestStep = std::numbers::pi / 6 + kSameAngle;  // between normals, radians

struct FaceAtAngle {
  double angle = 0;  // of the normal about the axis, in [0, 2 pi)
  FaceId face;
};

std::vector<FaceAtAngle> FacesAround(const PartModel& part, const Pose& X_PartAxis, double radius) {
  std::vector<FaceAtAngle> around;
  for (std::size_t f = 0; f < part.faces().size(); ++f) {
    const Face& face = part.faces()[f];
    const Vector3 normal = X_PartAxis.linear().transpose() * face.normal;
    const double distance = face.offset - face.normal.dot(X_PartAxis.translation());
    if (std::abs(normal.z()) > kSameAngle || std::abs(distance - radius) > kSameRadius) continue;
    const double angle = std::atan2(normal.y(), normal.x());
    around.push_back({angle < 0 ? angle + kTurn : angle, FaceId(f)});
  }
  std::ranges::sort(around, {}, &FaceAtAngle::angle);
  return around;
}

// Returns the angle from one face to the next one.
double StepAfter(const std::vector<FaceAtAngle>& around, std::size_t i) {
  const double next = i + 1 < around.size() ? around[i + 1].angle : around[0].angle + kTurn;
  return next - around[i].angle;
}

bool HasOpposite(const std::vector<FaceAtAngle>& around, double angle) {
  return std::ranges::any_of(around, [&](const FaceAtAngle& other) {
    return std::abs(std::abs(other.angle - angle) - kTurn / 2) < kSameAngle;
  });
}

double AngleOf(const RoundSide& side, const Face& face) {
  const Vector3 normal = side.X_PartAxis.linear().transpose() * face.normal;
  return std::atan2(normal.y(), normal.x());
}

// Returns the angle between the normals of two faces.
double Between(const RoundSide& side, const Face& a, const Face& b) {
  return std::abs(std::remainder(AngleOf(side, a) - AngleOf(side, b), kTurn));
}

// Returns the part of a face between two heights that belongs to the side, in the face's x and y.
geometry::Polygon StripOf(const RoundSide& side, const Face& face, const Vector2& steps,
                          const Interval& heights) {
  const double angle = AngleOf(side, face);
  const Vector3 normal(std::cos(angle), std::sin(angle), 0);
  const Vector3 along(-normal.y(), normal.x(), 0);
  std::vector<Vector3> corners;
  for (const double height : {heights.low, heights.high}) {
    for (const double way : {-std::tan(steps.x() / 2), std::tan(steps.y() / 2)}) {
      corners.push_back(side.X_PartAxis *
                        Vector3(side.radius * (normal + way * along) + height * Vector3::UnitZ()));
    }
  }
  return OnFace(face, corners);
}

}  // namespace

double RoundSide::OuterRadius() const { return radius / std::cos(half_step); }

std::optional<RoundSide> RoundSideAbout(const PartModel& part, const Pose& X_PartAxis,
                                        double radius) {
  const std::vector<FaceAtAngle> around = FacesAround(part, X_PartAxis, radius);
  if (around.empty()) return std::nullopt;
  RoundSide side{.X_PartAxis = X_PartAxis, .radius = radius, .faces = {}};
  for (std::size_t i = 0; i < around.size(); ++i) {
    const double step = StepAfter(around, i);
    if (step > kWidestStep || !HasOpposite(around, around[i].angle)) return std::nullopt;
    side.half_step = std::max(side.half_step, step / 2);
    side.faces.push_back(around[i].face);
  }
  return side;
}

bool IsInsideCircle(const PartModel& part, const RoundSide& side, const Interval& heights) {
  const Pose X_AxisPart = side.X_PartAxis.inverse();
  return std::ranges::all_of(part.pieces(), [&](const geometry::ConvexHull& piece) {
    const geometry::Polygon shadow = geometry::ShadowBetween(
        geometry::Transformed(piece, X_AxisPart), heights.low, heights.high);
    return std::ranges::all_of(
        shadow, [&](const Vector2& p) { return p.norm() <= side.OuterRadius() + kSameRadius; });
  });
}

bool IsRoundBetween(const PartModel& part, const RoundSide& side, const Interval& heights) {
  if (!(heights.low < heights.high)) return false;
  const std::size_t count = side.faces.size();
  const auto face = [&](std::size_t i) -> const Face& {
    return part.faces()[side.faces[i % count].index()];
  };
  for (std::size_t i = 0; i < count; ++i) {
    const Vector2 steps(Between(side, face(i + count - 1), face(i)),
                        Between(side, face(i), face(i + 1)));
    if (!face(i).Covers(StripOf(side, face(i), steps, heights))) return false;
  }
  return true;
}

}  // namespace assay::domain
