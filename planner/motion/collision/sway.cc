#include "planner/motion/collision/sway.h"

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "planner/base/check.h"
#include "planner/geometry/pose.h"
#include "planner/motion/paths/straight_line.h"

namespace assay::motion {
namespace {

using geometry::Matrix3;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

// Greatest number of halvings of one cell: near a singular posture there would be no end.
constexpr int kMostHalvings = 40;
constexpr int kMostCells = 3'000;     // greatest number of cells of one way
constexpr double kLeastDoubt = 1e-6;  // least half width of any error: rounding is far smaller
constexpr double kInflation = 1.2;    // factor on a guess at the turns of joints
constexpr int kGuesses = 5;           // number of guesses, each computed from the last one
constexpr double kWidestCell = 0.25;  // greatest turn of a joint in a cell, radians
// M (SwayAlong) may enlarge the bound on the joints' differences from their planned values by at
// most this share. If M enlarges the bound by more, the cell is halved along the line, unless the
// errors turn the joints at least as much as the line does.
constexpr double kLengthened = 0.05;
// Postures are on one straight line if the tool is off it by less: metres, and entries of a
// rotation matrix. The errors of each cell are larger (kLeastDoubt).
constexpr double kOnLine = 1e-7;
constexpr double kLongestPiece = 1.0;  // greatest turn of a joint along one piece, radians

// Derivatives of the arm in one posture, as the tool moves with it. They are about the arm's center
// (kinematics::ArmSolver), in the world's axes.
struct Differential {
  Matrix6 inverse;                // A of the Jacobian J: joint rates by twists of the tool
  std::array<Matrix6, 6> change;  // |A dJ/dq| for each joint
  // Distance of the center from each joint's axis, metres.
  std::array<double, 6> lever = {};
};

// Joint j turns everything behind it about its axis.
Matrix6 ChangeOf(const Matrix6& jacobian, int j) {
  const auto velocity = [&](int k) { return Vector3(jacobian.block<3, 1>(0, k)); };
  const auto axis = [&](int k) { return Vector3(jacobian.block<3, 1>(3, k)); };
  Matrix6 change;
  for (int k = 0; k < 6; ++k) {
    const Vector3 turned = j < k ? Vector3(axis(j).cross(axis(k))) : Vector3::Zero();
    change.col(k) << axis(std::min(j, k)).cross(velocity(std::max(j, k))), turned;
  }
  return change;
}

Matrix6 InverseOf(const Matrix6& jacobian) {
  const Matrix3 by_wrist = jacobian.topRightCorner<3, 3>();
  if (!by_wrist.isZero(0)) return jacobian.inverse();
  // The last three joints do not move the center, so the matrix consists of blocks.
  const Matrix3 by_velocity = jacobian.topLeftCorner<3, 3>().inverse();
  const Matrix3 by_turn = jacobian.bottomRightCorner<3, 3>().inverse();
  Matrix6 inverse;
  inverse << by_velocity, Matrix3::Zero(),
      -by_turn * jacobian.bottomLeftCorner<3, 3>() * by_velocity, by_turn;
  return inverse;
}

Differential DifferentialAt(const domain::Workcell& workcell, const JointVector& q) {
  const Matrix3 R_WorldBase = workcell.X_WorldBase().linear();
  Matrix6 jacobian = workcell.arm().JacobianAt(q);
  jacobian.topRows<3>() = R_WorldBase * jacobian.topRows<3>();
  jacobian.bottomRows<3>() = R_WorldBase * jacobian.bottomRows<3>();
  Differential at = {.inverse = InverseOf(jacobian), .change = {}};
  for (int j = 0; j < 6; ++j) at.change[j] = (at.inverse * ChangeOf(jacobian, j)).cwiseAbs();
  for (int k = 0; k < 6; ++k) at.lever[k] = jacobian.col(k).head<3>().norm();
  return at;
}

// Returns a bound on the difference between the entries of A J(q) and of the identity, if no joint
// is farther from q0 than r. The first order is the change of J at q0. Second derivatives of axes
// are at most 1, by two joints before them. The second derivative of the center's velocity by joint
// k, with respect to joints j and l, is at most the lever of the last of the three. Turns of the
// joints behind it make this lever grow.
Matrix6 Departure(const Differential& at, const JointVector& r) {
  std::array<double, 6> lever = at.lever;
  for (int k = 5; k >= 0; --k) {
    for (int j = k + 1; j < 6; ++j) lever[k] += r[j] * lever[j];
  }
  Matrix6 departure = Matrix6::Zero();
  double turned = 0;  // sum over the joints before joint k
  for (int k = 0; k < 6; ++k) {
    departure += r[k] * at.change[k];
    double reached = turned + r[k];
    double bent = reached * reached * lever[k];
    for (int j = k + 1; j < 6; ++j) {
      bent += r[j] * (2 * reached + r[j]) * lever[j];
      reached += r[j];
    }
    departure.col(k) += bent / 2 * at.inverse.leftCols<3>().rowwise().norm() +
                        turned * turned / 2 * at.inverse.rightCols<3>().rowwise().norm();
    turned += r[k];
  }
  return departure;
}

// A bound r on the turns of joints within a cell, and the matrix M for it.
struct Turning {
  JointVector r;
  Matrix6 departure;
};

std::optional<Turning> TurningFor(const Differential& at, const JointVector& twist) {
  const JointVector least = at.inverse.cwiseAbs() * twist;
  JointVector r = kInflation * least;
  for (int guess = 0; guess < kGuesses && r.maxCoeff() < kWidestCell; ++guess) {
    const Matrix6 departure = Departure(at, r);
    const JointVector next = least + departure * r;
    if ((next.array() <= r.array()).all()) return Turning{next, departure};
    r = kInflation * next;
  }
  return std::nullopt;
}

// The coordinates of a cell: the position along the piece of the line (a share of it), shifts along
// x, y and z, the turn about the world's z, and the turn about the tool's z.
using Coordinates = Eigen::Matrix<double, 6, 1>;
enum Coordinate { kAlong, kX, kY, kZ, kTurn, kSpin };

struct Cell {
  Coordinates middle = Coordinates::Zero();
  Coordinates half = Coordinates::Zero();
  int halvings = 0;
};

// Returns the last posture, after the first, up to which the tool stays on one straight line. As
// the line gets longer, it turns by the distance of its new end from the line before. The points on
// it are therefore off it by at most the sum of these distances.
std::size_t EndOfPiece(const domain::Workcell& workcell, const JointPath& path, std::size_t first) {
  const Pose start = ToolAt(workcell, path[first]);
  Vector3 line = ToolAt(workcell, path[first + 1]).translation() - start.translation();
  double off_line = 0;
  std::size_t last = first + 1;
  for (; last + 1 < path.size(); ++last) {
    const Pose next = ToolAt(workcell, path[last + 1]);
    const Vector3 way = next.translation() - start.translation();
    off_line += way.cross(line).norm() / line.norm();
    const bool goes_on = way.norm() > line.norm() && off_line < kOnLine &&
                         next.linear().isApprox(start.linear(), kOnLine) &&
                         (path[last + 1] - path[first]).cwiseAbs().maxCoeff() < kLongestPiece;
    if (!goes_on) break;
    line = way;
  }
  return last;
}

// A way with the tool on a straight line.
class Piece {
 public:
  Piece(const domain::Workcell& workcell, const JointVector& from, const JointVector& to,
        const plan::ToolErrorBox& doubt)
      : workcell_(workcell),
        middle_((from + to) / 2),
        indicators_(workcell.arm().IndicatorsOf(from)),
        X_WorldTool_(ToolAt(workcell, from)),
        line_(ToolAt(workcell, to).translation() - X_WorldTool_.translation()),
        center_(workcell.gripper().X_FlangeTool().inverse() * workcell.arm().p_FlangeCenter()) {
    all_.middle[kAlong] = 0.5;
    all_.half << 0.5, doubt.shift, doubt.turn, doubt.spin;
    all_.half.tail<5>().array() += kLeastDoubt;
    errors_ = all_.half;
    errors_[kAlong] = 0;
  }

  const Cell& all() const { return all_; }

  // Returns None if the arm does not get there in its present configuration.
  std::optional<JointVector> PostureIn(const Cell& cell) const {
    const Coordinates& at = cell.middle;
    Pose X_WorldTool = X_WorldTool_;
    X_WorldTool.translation() += at[kAlong] * line_ + at.segment<3>(kX);
    X_WorldTool.linear() = geometry::RotationZ(at[kTurn]).linear() * X_WorldTool_.linear() *
                           geometry::RotationZ(at[kSpin]).linear();
    const auto q = workcell_.arm().Inverse(workcell_.FlangeFor(X_WorldTool), indicators_, middle_);
    return q ? kinematics::NearestByTurns(*q, middle_) : q;
  }

  // Returns bounds of the twist, about the arm's center, that moves the tool from the middle of
  // the cell to another of its poses. A column bounds the components of the twist if only one of
  // the coordinates changes.
  Matrix6 TwistsIn(const Coordinates& half) const {
    Matrix6 twists = Matrix6::Zero();
    twists.block<3, 1>(0, kAlong) = half[kAlong] * line_.cwiseAbs();
    for (int axis = 0; axis < 3; ++axis) twists(axis, kX + axis) = half[kX + axis];
    // A turn about the vertical does not change the lean of the tool's z.
    const Vector3 z = X_WorldTool_.linear().col(2);
    const double across = z.head<2>().norm();
    const double off_axis = center_.head<2>().norm();
    const double swung = across * std::abs(center_.z()) + off_axis;
    twists.col(kTurn) << swung, swung, 0, 0, 0, 1;
    twists.col(kSpin) << off_axis, off_axis, off_axis, across, across, std::abs(z.z());
    twists.col(kTurn) *= half[kTurn];
    twists.col(kSpin) *= half[kSpin];
    return twists;
  }
  JointVector Errors() const { return TwistsIn(errors_).rowwise().sum(); }

 private:
  const domain::Workcell& workcell_;
  JointVector middle_;
  kinematics::Indicators indicators_;
  Pose X_WorldTool_;
  Vector3 line_;
  Vector3 center_;  // the arm's center in the tool's frame
  Cell all_;
  Coordinates errors_;
};

double RoomOf(const kinematics::Arm& arm, const JointVector& q, const JointVector& r) {
  double room = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 6; ++k) {
    const kinematics::JointLimits& limits = arm.limits()[static_cast<std::size_t>(k)];
    room = std::min({room, q[k] - r[k] - limits.lower, limits.upper - q[k] - r[k]});
  }
  return room;
}

class WayCover {
 public:
  WayCover(const domain::Workcell& workcell, const plan::ToolErrorBox& doubt)
      : workcell_(workcell), doubt_(doubt) {
    // The cells of a way are known to have postures of one configuration only if the indicators
    // tell configurations apart.
    sway_.is_bounded = workcell.arm().IndicatorsTellAllApart();
    sway_.room = std::numeric_limits<double>::infinity();
  }

  void Cover(const JointVector& from, const JointVector& to) {
    const Piece piece(workcell_, from, to, doubt_);
    std::vector<Cell> open = {piece.all()};
    while (!open.empty() && sway_.is_bounded) {
      const Cell cell = open.back();
      open.pop_back();
      const auto q = piece.PostureIn(cell);
      sway_.is_bounded = q.has_value() && ++cells_ < kMostCells;
      if (sway_.is_bounded) Look(piece, cell, *q, open);
    }
  }

  const Sway& sway() const { return sway_; }

 private:
  // Adds the cell's bounds to the result, or halves the cell: in the coordinate that turns the
  // joints most if no bound is known, and along the line if the bounds are loose and the cell is
  // long.
  void Look(const Piece& piece, const Cell& cell, const JointVector& q, std::vector<Cell>& open) {
    const Differential at = DifferentialAt(workcell_, q);
    const Matrix6 twists = piece.TwistsIn(cell.half);
    const auto turning = TurningFor(at, twists.rowwise().sum());
    if (!turning) {
      sway_.is_bounded = cell.halvings < kMostHalvings;
      int widest = 0;
      (at.inverse.cwiseAbs() * twists).colwise().maxCoeff().maxCoeff(&widest);
      return Halve(cell, widest, open);
    }
    const Matrix6 within = Matrix6::Identity() - turning->departure;
    const JointVector least = at.inverse.cwiseAbs() * piece.Errors();
    const JointVector turn = within.partialPivLu().solve(least);
    const double room = RoomOf(workcell_.arm(), q, turning->r);
    const double along = (at.inverse.cwiseAbs() * twists.col(kAlong)).maxCoeff();
    const bool is_loose = turn.maxCoeff() > (1 + kLengthened) * least.maxCoeff() || room <= 0;
    if (is_loose && along > least.maxCoeff()) return Halve(cell, kAlong, open);
    sway_.turn = sway_.turn.cwiseMax(turn);
    sway_.room = std::min(sway_.room, room);
  }

  static void Halve(const Cell& cell, int coordinate, std::vector<Cell>& open) {
    for (const double side : {-0.5, 0.5}) {
      Cell half = cell;
      half.middle[coordinate] += side * cell.half[coordinate];
      half.half[coordinate] /= 2;
      ++half.halvings;
      open.push_back(half);
    }
  }

  const domain::Workcell& workcell_;
  const plan::ToolErrorBox& doubt_;
  Sway sway_;
  int cells_ = 0;
};

}  // namespace

Sway SwayAlong(const domain::Workcell& workcell, const JointPath& path,
               const plan::ToolErrorBox& doubt) {
  ASSAY_CHECK(!path.empty());
  WayCover cover(workcell, doubt);
  for (std::size_t first = 0; first + 1 < path.size();) {
    const std::size_t last = EndOfPiece(workcell, path, first);
    cover.Cover(path[first], path[last]);
    first = last;
  }
  if (path.size() == 1) cover.Cover(path.front(), path.front());
  return cover.sway();
}

}  // namespace assay::motion
