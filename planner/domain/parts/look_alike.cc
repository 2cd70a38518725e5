#include "planner/domain/parts/look_alike.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "planner/geometry/hull.h"
#include "planner/geometry/pose.h"

namespace assay::domain {
namespace {

using Corners = std::vector<Vector3>;

constexpr double kSame = 1e-4;  // metres between corners that no sensor distinguishes

std::vector<Corners> CornersOf(const Part& part, const Pose& X_WorldPart) {
  std::vector<Corners> pieces;
  for (const geometry::ConvexHull& piece : part.model->pieces()) {
    pieces.push_back(Transformed(piece, X_WorldPart).vertices);
  }
  return pieces;
}

Vector3 MiddleOf(const std::vector<Corners>& pieces) {
  Vector3 sum = Vector3::Zero();
  std::size_t count = 0;
  for (const Corners& corners : pieces) {
    for (const Vector3& corner : corners) sum += corner;
    count += corners.size();
  }
  return sum / static_cast<double>(count);
}

// Returns whether the moved pieces are the other pieces, one by one.
bool AreSame(const std::vector<Corners>& pieces, const Pose& move,
             const std::vector<Corners>& others) {
  return std::ranges::all_of(pieces, [&](const Corners& piece) {
    return std::ranges::any_of(others, [&](const Corners& other) {
      return std::ranges::all_of(piece, [&](const Vector3& corner) {
        return std::ranges::any_of(other, [&](const Vector3& its) {
          return (move * corner - its).cwiseAbs().maxCoeff() < kSame;
        });
      });
    });
  });
}

double AngleOf(const Vector3& v) { return std::atan2(v.y(), v.x()); }

// Returns turns about the world's z, with shifts, that may bring the part's pieces from one pose to
// the other. They bring the middle to the middle, and the corner that is farthest from the middle
// to a corner that is equally far.
std::vector<Pose> MovesBetween(const std::vector<Corners>& from, const std::vector<Corners>& to) {
  const Vector3 middle = MiddleOf(from);
  const Vector3 other_middle = MiddleOf(to);
  Vector3 farthest = Vector3::Zero();
  for (const Corners& piece : from) {
    for (const Vector3& corner : piece) {
      if ((corner - middle).head<2>().norm() > farthest.head<2>().norm())
        farthest = corner - middle;
    }
  }
  std::vector<Pose> moves;
  for (const Corners& piece : to) {
    for (const Vector3& corner : piece) {
      const double turn = AngleOf(corner - other_middle) - AngleOf(farthest);
      const Pose move = geometry::Translation(other_middle) * geometry::RotationZ(turn) *
                        geometry::Translation(-middle);
      if (AreSame(from, move, to)) moves.push_back(move);
    }
  }
  return moves;
}

// Returns how far apart two values with this error may be without the sensor noticing the
// difference.
double Open(const Interval& error, const Interval& promise) {
  return error.high - error.low + promise.high - promise.low + kSame;
}

// Errors turn a part about its own origin, and a symmetry of the part may move that origin.
double Swing(double arm, double turn) { return arm < kSame ? 0 : arm * turn; }

}  // namespace

bool LookAlike(const Part& part, const Pose& X_WorldA, const Pose& X_WorldB,
               const SensorModel& sensor) {
  const PoseError& error = part.error;
  const Vector3 open = {Open(error.x, sensor.x), Open(error.y, sensor.y), Open(error.z, sensor.z)};
  const double open_turn = Open(error.theta, sensor.theta);
  const auto is_open = [&](const Pose& move) {
    const Vector3 origin = move * X_WorldA.translation();
    const double swing = Swing((origin - X_WorldB.translation()).head<2>().norm(), open_turn);
    const Vector3 shift = (origin - X_WorldA.translation()).cwiseAbs();
    return std::abs(AngleOf(move.linear().col(0))) <= open_turn && shift.x() <= open.x() + swing &&
           shift.y() <= open.y() + swing && shift.z() <= open.z();
  };
  return std::ranges::any_of(MovesBetween(CornersOf(part, X_WorldA), CornersOf(part, X_WorldB)),
                             is_open);
}

}  // namespace assay::domain
