#include "planner/mesh_import/sections/extrusion_axis.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace assay::mesh_import {
namespace {

constexpr double kAligned = 1e-3;    // radians
constexpr double kDirection = 2e-3;  // by which a facet may be off the direction, radians
constexpr std::size_t kMostDirections = 40;
constexpr std::size_t kMostAxes = 5;
constexpr double kLeastScore = 0.2;
constexpr double kRightAngles = 0.4;  // least share of the sides that are at right angles
constexpr int kAngleSteps = 900;      // in a right angle

// Returns the direction or its reverse, with the greatest component positive.
Vector3 Upward(const Vector3& direction) {
  Eigen::Index greatest = 0;
  // Components that are equal up to rounding must give the same answer for all files.
  for (Eigen::Index i = 1; i < 3; ++i) {
    if (std::abs(direction[i]) > std::abs(direction[greatest]) + 1e-6) greatest = i;
  }
  return direction[greatest] < 0 ? Vector3(-direction) : direction;
}

Vector3 Snapped(const Vector3& direction) {
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3 unit = Vector3::Unit(axis);
    if ((Upward(direction) - unit).norm() < kAligned) return unit;
  }
  return direction;
}

// Returns the normals that have the most area, and the principal directions of all normals.
std::vector<Vector3> DirectionsOf(const TriangleMesh& mesh) {
  std::map<std::array<int, 3>, Vector3> sums;
  Matrix3 spread = Matrix3::Zero();
  for (const Triangle& triangle : mesh.triangles) {
    const Vector3 area = mesh.AreaVector(triangle);
    if (area.norm() == 0) continue;
    const Vector3 normal = Upward(area.normalized());
    const auto index = [&](int i) { return static_cast<int>(std::lround(normal[i] / kDirection)); };
    const auto [sum, is_new] =
        sums.try_emplace({index(0), index(1), index(2)}, Vector3(Vector3::Zero()));
    sum->second += normal * area.norm();
    spread += area * area.transpose() / area.norm();
  }
  std::vector<Vector3> directions;
  for (const auto& [index, sum] : sums) directions.push_back(sum);
  std::ranges::stable_sort(directions, std::ranges::greater(),
                           [](const Vector3& sum) { return sum.norm(); });
  if (directions.size() > kMostDirections) directions.resize(kMostDirections);
  for (Vector3& direction : directions) direction.normalize();
  const Eigen::SelfAdjointEigenSolver<Matrix3> principal(spread);
  for (int i = 0; i < 3; ++i) directions.push_back(Upward(principal.eigenvectors().col(i)));
  return directions;
}

// Returns the share of the surface that lies along a direction or across it.
double ScoreOf(const TriangleMesh& mesh, const Vector3& direction) {
  double fitting = 0;
  double total = 0;
  for (const Triangle& triangle : mesh.triangles) {
    const Vector3 area = mesh.AreaVector(triangle);
    const double along = std::abs(area.dot(direction));
    const double across = area.cross(direction).norm();
    total += area.norm();
    if (std::min(along, across) <= 2 * kDirection * area.norm()) fitting += area.norm();
  }
  return total > 0 ? fitting / total : 0;
}

// Returns the angle, less than a right angle, at which most of the sides are; 0 if there is none.
double AngleOfSides(const TriangleMesh& mesh, const Vector3& x, const Vector3& y) {
  constexpr double kRightAngle = std::numbers::pi / 2;
  std::vector<double> weights(kAngleSteps, 0);
  std::vector<std::pair<double, double>> sides;  // angle and area
  double total = 0;
  for (const Triangle& triangle : mesh.triangles) {
    const Vector3 area = mesh.AreaVector(triangle);
    const Vector2 side(area.dot(x), area.dot(y));
    if (side.norm() <= 0.999 * area.norm() || area.norm() == 0) continue;
    const double angle = std::fmod(std::atan2(side.y(), side.x()) + 4 * kRightAngle, kRightAngle);
    const int step = static_cast<int>(std::lround(angle / kRightAngle * kAngleSteps)) % kAngleSteps;
    weights[static_cast<std::size_t>(step)] += side.norm();
    sides.emplace_back(angle, side.norm());
    total += side.norm();
  }
  const auto best = std::ranges::max_element(weights);
  const double middle = kRightAngle * static_cast<double>(best - weights.begin()) / kAngleSteps;
  double sum = 0;
  double weight = 0;
  for (const auto& [angle, area] : sides) {
    const double off = std::remainder(angle - middle, kRightAngle);
    if (std::abs(off) > 2 * kRightAngle / kAngleSteps) continue;
    sum += off * area;
    weight += area;
  }
  return weight > kRightAngles * total ? middle + sum / weight : 0;
}

}  // namespace

std::vector<Vector3> ExtrusionAxes(const TriangleMesh& mesh) {
  std::vector<std::pair<double, Vector3>> scored;
  for (const Vector3& direction : DirectionsOf(mesh)) {
    const Vector3 axis = Snapped(direction);
    const bool is_known = std::ranges::any_of(scored, [&](const auto& other) {
      return axis.cross(other.second).norm() < 2 * kDirection;
    });
    if (is_known) continue;
    const double score = ScoreOf(mesh, axis);
    if (score >= kLeastScore) scored.emplace_back(score, axis);
  }
  std::ranges::stable_sort(scored, std::ranges::greater(),
                           [](const auto& axis) { return std::round(axis.first * 1e6); });
  std::vector<Vector3> axes;
  for (const auto& [score, axis] : scored) {
    if (axes.size() < kMostAxes) axes.push_back(axis);
  }
  return axes;
}

Matrix3 FrameOfExtrusion(const TriangleMesh& mesh, const Vector3& axis) {
  Vector3 x = axis.unitOrthogonal();
  for (int i = 0; i < 3; ++i) {
    if (axis == Vector3::Unit(i)) x = Vector3::Unit((i + 1) % 3);
  }
  const Vector3 y = axis.cross(x);
  double angle = AngleOfSides(mesh, x, y);
  if (std::abs(std::remainder(angle, std::numbers::pi / 2)) < kAligned) angle = 0;
  Matrix3 frame;
  frame.col(0) = std::cos(angle) * x + std::sin(angle) * y;
  frame.col(2) = axis;
  frame.col(1) = axis.cross(Vector3(frame.col(0)));
  return frame;
}

}  // namespace assay::mesh_import
