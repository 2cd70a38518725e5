#include "planner/kinematics/lee_ziegler.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace assay::kinematics {
namespace {

constexpr double kPi = std::numbers::pi;
// A squared length (m^2) that is negative by at most this counts as zero: the pose is on the border
// of the reach.
constexpr double kBorder = 1e-13;
// A direction below this (wrist: sine of q5; shoulder, elbow: metres) is lost in rounding.
constexpr double kSingular = 1e-10;

// Radicands down to -kBorder count as 0, so that the border belongs to the reach.
double ClampedSqrt(double radicand) { return radicand > 0 ? std::sqrt(radicand) : 0.0; }

struct Direction {
  double cosine = 1;
  double sine = 0;

  static Direction Of(double angle) { return {std::cos(angle), std::sin(angle)}; }
  double Angle() const { return std::atan2(sine, cosine); }
};

Direction Sum(const Direction& a, const Direction& b) {
  return {a.cosine * b.cosine - a.sine * b.sine, a.sine * b.cosine + a.cosine * b.sine};
}

// Returns the angle half a turn further, within [-pi, pi].
double Opposite(double angle) { return angle > 0 ? angle - kPi : angle + kPi; }

// Returns the wrist centre's x in the frame that is turned by q1: how far the arm reaches before
// axis 1.
double Reach(const ArmGeometry& g, const Direction& t2, const Direction& t23) {
  return g.a2 * t2.cosine + g.a3 * t23.cosine + g.d4 * t23.sine;
}

// ARM = sign(-reach) and ELBOW = ARM sign(across), with sign(0) = +1. `across` is d4 c3 - a3 s3.
Shoulder ShoulderOf(double reach) { return reach <= 0 ? Shoulder::kRight : Shoulder::kLeft; }
Elbow ElbowOf(double reach, double across) {
  return (reach <= 0) == (across >= 0) ? Elbow::kAbove : Elbow::kBelow;
}

// Solves one pose algebraically. Seen in the arm's plane, the wrist centre is
//   ( x, z ) = ( a2 c2 + a3 c23 + d4 s23, -a2 s2 - a3 s23 + d4 c23 ),   x = -ARM r.
// Let along = a2 + a3 c3 + d4 s3 and e = d4 c3 - a3 s3, the coordinates of the wrist centre along
// and across the upper arm. Then
//   along = (x^2 + z^2 + a2^2 - a3^2 - d4^2) / (2 a2),   along^2 + e^2 = x^2 + z^2,
// and the sign of e is ARM ELBOW. The cosines and sines of q1, q2, q3 and q23 follow without
// intermediate angles. Each angle is computed once, at the end. (The solutions are those of Lee and
// Ziegler 1983, who compute them by way of the angles.)
class InverseSolver {
 public:
  InverseSolver(const ArmGeometry& g, const Pose& X_BaseFlange, const JointVector& reference)
      : g_(g),
        R_(X_BaseFlange.linear()),
        center_(X_BaseFlange.translation() - g.d6 * R_.col(2)),
        reference_(reference) {}

  InverseSolutions Solve() {
    if (!MeetShoulder()) return {};
    AddShoulder(-r_);
    if (r_ > 0) AddShoulder(r_);
    return solutions_;
  }

  // Returns only the solutions of the given shoulder and elbow.
  InverseSolutions Solve(Shoulder shoulder, Elbow elbow) {
    if (!MeetShoulder()) return {};
    for (const double x : {-r_, r_}) {
      if (ShoulderOf(x) != shoulder) continue;
      const Position position = AtShoulder(x);
      for (const double e : {e_, -e_}) {
        if (ElbowOf(x, e) == elbow && solutions_.size() == 0) AddElbow(x, e, position);
      }
    }
    return solutions_;
  }

 private:
  // The first three joints for one shoulder and elbow, and their directions.
  struct Position {
    Direction t1;
    Direction t23;
    double q1 = 0;
    double q2 = 0;
    double q3 = 0;
    Shoulder shoulder = Shoulder::kRight;
    Elbow elbow = Elbow::kAbove;
  };

  // Returns false if the wrist centre is out of reach.
  bool MeetShoulder() {
    const double radial2 = center_.x() * center_.x() + center_.y() * center_.y();
    const double r2 = radial2 - g_.d2 * g_.d2;
    if (!(r2 >= -kBorder)) return false;
    r_ = ClampedSqrt(r2);
    R2_ = r_ * r_ + center_.z() * center_.z();
    const double forearm2 = g_.a3 * g_.a3 + g_.d4 * g_.d4;
    along_ = (R2_ + g_.a2 * g_.a2 - forearm2) / (2 * g_.a2);
    const double e2 = R2_ - along_ * along_;
    if (!(e2 >= -kBorder)) return false;
    e_ = ClampedSqrt(e2);
    return true;
  }

  void AddShoulder(double x) {
    const Position position = AtShoulder(x);
    AddElbow(x, e_, position);
    if (e_ > 0) AddElbow(x, -e_, position);
  }

  Position AtShoulder(double x) const {
    Position position;
    position.t1 = Waist(x);
    position.q1 = position.t1.Angle();
    return position;
  }

  // In the frame that is turned by q1, the wrist centre is at (x, d2).
  Direction Waist(double x) const {
    const double radial2 = x * x + g_.d2 * g_.d2;
    if (radial2 < kSingular * kSingular) return Direction::Of(reference_[0]);
    return {(x * center_.x() + g_.d2 * center_.y()) / radial2,
            (x * center_.y() - g_.d2 * center_.x()) / radial2};
  }

  // The sign of `e` is the sign of the solution.
  void AddElbow(double x, double e, Position position) {
    const double u = along_ - g_.a2;
    const double forearm2 = u * u + e * e;
    const Direction t3{(g_.a3 * u + g_.d4 * e) / forearm2, (g_.d4 * u - g_.a3 * e) / forearm2};
    const Direction t2 = ShoulderLift(x, e);
    position.t23 = Sum(t2, t3);
    position.q2 = t2.Angle();
    position.q3 = t3.Angle();
    position.shoulder = ShoulderOf(x);
    position.elbow = ElbowOf(x, e);
    AddWrists(position);
  }

  // The wrist centre is at (along, e) in the upper arm's frame and at (x, z) in the shoulder's
  // frame.
  Direction ShoulderLift(double x, double e) const {
    if (R2_ < kSingular * kSingular) return Direction::Of(reference_[1]);
    return {(x * along_ + center_.z() * e) / R2_, (x * e - center_.z() * along_) / R2_};
  }

  void AddWrists(const Position& position) {
    const auto [c1, s1] = position.t1;
    const auto [c23, s23] = position.t23;
    // The forearm's axes in the base frame, and the approach vector in the forearm's frame.
    const Vector3 x3(c1 * c23, s1 * c23, -s23);
    const Vector3 y3(-s1, c1, 0);
    const Vector3 z3(c1 * s23, s1 * s23, c23);
    const Vector3 a(x3.dot(R_.col(2)), y3.dot(R_.col(2)), z3.dot(R_.col(2)));
    const Direction t4 = WristRoll(a);
    const double q4 = t4.Angle();
    const double q5 = std::atan2(a.x() * t4.cosine + a.y() * t4.sine, a.z());
    // y4 is axis 5. It makes q6 consistent with the chosen q4.
    const Vector3 y4 = t4.cosine * y3 - t4.sine * x3;
    const double q6 = std::atan2(y4.dot(R_.col(0)), y4.dot(R_.col(1)));
    Add(position, {q4, q5, q6}, Wrist::kNoFlip);
    Add(position, {Opposite(q4), -q5, Opposite(q6)}, Wrist::kFlip);
  }

  Direction WristRoll(const Vector3& a) const {
    const double s5 = std::sqrt(a.x() * a.x() + a.y() * a.y());
    if (s5 < kSingular) return Direction::Of(reference_[3]);
    return {a.x() / s5, a.y() / s5};
  }

  void Add(const Position& position, const Vector3& wrist, Wrist flip) {
    InverseSolution& solution = solutions_.Append();
    solution.q << position.q1, position.q2, position.q3, wrist;
    solution.indicators = {position.shoulder, position.elbow, flip};
  }

  const ArmGeometry& g_;
  const Matrix3 R_;
  const Vector3 center_;
  const JointVector& reference_;
  double r_ = 0;   // the absolute value of x
  double R2_ = 0;  // squared distance from shoulder to wrist centre in the arm's plane
  double along_ = 0;
  double e_ = 0;
  InverseSolutions solutions_;
};

}  // namespace

Pose LeeZiegler::Forward(const JointVector& q) const {
  const Direction t1 = Direction::Of(q[0]);
  const Direction t2 = Direction::Of(q[1]);
  const auto [c23, s23] = Direction::Of(q[1] + q[2]);
  const auto [c4, s4] = Direction::Of(q[3]);
  const auto [c5, s5] = Direction::Of(q[4]);
  const auto [c6, s6] = Direction::Of(q[5]);
  const double x = Reach(g_, t2, {c23, s23});
  const double z = -g_.a2 * t2.sine - g_.a3 * s23 + g_.d4 * c23;

  // The forearm's axes come first. Each wrist joint then turns them: z4 = z3, y5 = y4, z6 = z5.
  const Vector3 x3(t1.cosine * c23, t1.sine * c23, -s23);
  const Vector3 y3(-t1.sine, t1.cosine, 0);
  const Vector3 z3(t1.cosine * s23, t1.sine * s23, c23);
  const Vector3 x4 = c4 * x3 + s4 * y3;
  const Vector3 y4 = c4 * y3 - s4 * x3;
  const Vector3 x5 = c5 * x4 - s5 * z3;
  const Vector3 z5 = s5 * x4 + c5 * z3;
  Pose X = Pose::Identity();
  X.linear() << c6 * x5 + s6 * y4, c6 * y4 - s6 * x5, z5;
  X.translation() =
      Vector3(t1.cosine * x - t1.sine * g_.d2, t1.sine * x + t1.cosine * g_.d2, z) + g_.d6 * z5;
  return X;
}

ArmJacobian LeeZiegler::JacobianAt(const JointVector& q) const {
  const auto [c1, s1] = Direction::Of(q[0]);
  const auto [c2, s2] = Direction::Of(q[1]);
  const auto [c23, s23] = Direction::Of(q[1] + q[2]);
  const auto [c4, s4] = Direction::Of(q[3]);
  const auto [c5, s5] = Direction::Of(q[4]);
  // The axes are those of Forward. The offset d2 is along axes 2 and 3, so it matters only for
  // axis 1.
  const Vector3 x3(c1 * c23, s1 * c23, -s23);
  const Vector3 y3(-s1, c1, 0);
  const Vector3 z3(c1 * s23, s1 * s23, c23);
  const Vector3 forearm = g_.a3 * x3 + g_.d4 * z3;
  const Vector3 arm = g_.a2 * Vector3(c1 * c2, s1 * c2, -s2) + forearm;
  ArmJacobian at = ArmJacobian::Zero();
  at.topLeftCorner<3, 3>() << Vector3::UnitZ().cross(arm + g_.d2 * y3), y3.cross(arm),
      y3.cross(forearm);
  at.bottomRows<3>() << Vector3::UnitZ(), y3, y3, z3, c4 * y3 - s4 * x3,
      s5 * (c4 * x3 + s4 * y3) + c5 * z3;
  return at;
}

InverseSolutions LeeZiegler::Inverse(const Pose& X_BaseFlange, const JointVector& reference) const {
  return InverseSolver(g_, X_BaseFlange, reference).Solve();
}

std::optional<JointVector> LeeZiegler::Inverse(const Pose& X_BaseFlange,
                                               const Indicators& indicators,
                                               const JointVector& reference) const {
  const InverseSolutions solutions =
      InverseSolver(g_, X_BaseFlange, reference).Solve(indicators.shoulder, indicators.elbow);
  const auto found = std::ranges::find(solutions, indicators, &InverseSolution::indicators);
  return found == solutions.end() ? std::nullopt : std::optional(found->q);
}

Indicators LeeZiegler::IndicatorsOf(const JointVector& q) const {
  const double reach = Reach(g_, Direction::Of(q[1]), Direction::Of(q[1] + q[2]));
  const double across = g_.d4 * std::cos(q[2]) - g_.a3 * std::sin(q[2]);
  return {ShoulderOf(reach), ElbowOf(reach, across),
          std::sin(q[4]) >= 0 ? Wrist::kNoFlip : Wrist::kFlip};
}

}  // namespace assay::kinematics
