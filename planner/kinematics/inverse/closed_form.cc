#include "planner/kinematics/inverse/closed_form.h"

#include <cmath>

#include "planner/kinematics/inverse/subproblems.h"

namespace assay::kinematics {
namespace {

// The six joints as a cycle that starts behind the three special axes.
struct JointCycle {
  std::array<int, 3> special;  // joints of the special axes
  std::array<int, 3> others;   // the other joints, in the order of the cycle
  // Axes of the others. Axes of joints before the special ones are transformed by `inverse`.
  std::array<JointAxis, 3> axes;
  Pose inverse;  // of the motion

  // Turn(special) = D^-1, where D is this product of the others' turns.
  Pose Others(const SixAngles& q) const {
    return Turn(axes[0], q[others[0]]) * Turn(axes[1], q[others[1]]) * Turn(axes[2], q[others[2]]) *
           inverse;
  }
};

JointCycle CycleOf(const SixAxes& axes, int first, const Pose& motion) {
  JointCycle cycle;
  cycle.inverse = motion.inverse();
  for (int i = 0; i < 3; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const int other = (first + 3 + i) % 6;
    cycle.special[at] = first + i;
    cycle.others[at] = other;
    const JointAxis& axis = axes[static_cast<std::size_t>(other)];
    cycle.axes[at] = other < first ? Moved(cycle.inverse, axis) : axis;
  }
  return cycle;
}

std::array<double, 3> At(const SixAngles& q, const std::array<int, 3>& joints) {
  return {q[joints[0]], q[joints[1]], q[joints[2]]};
}

// Returns a unit vector at right angles to h.
Vector3 AnyNormal(const Vector3& h) { return h.unitOrthogonal(); }

// Adds the turns about three concurrent axes, whose product is the rotation.
void AddRotation(const SixAxes& axes, const JointCycle& cycle, const Eigen::Matrix3d& rotation,
                 SixAngles q, const SixAngles& reference, ClosedFormSolutions& solutions) {
  const auto direction = [&](int i) -> const Vector3& {
    return axes[static_cast<std::size_t>(cycle.special[static_cast<std::size_t>(i)])].direction;
  };
  const Vector3& a = direction(0);
  const Vector3& b = direction(1);
  const Vector3& c = direction(2);
  const auto [qa, qb, qc] = At(reference, cycle.special);
  for (const SubproblemAngles<2>& pair : TurnTogether(b, c, -a, rotation * c, {qb, qa})) {
    q[cycle.special[0]] = pair.q[1];
    q[cycle.special[1]] = pair.q[0];
    const Eigen::Matrix3d before =
        (Eigen::AngleAxisd(pair.q[1], a) * Eigen::AngleAxisd(pair.q[0], b)).toRotationMatrix();
    const Vector3 normal = AnyNormal(c);
    q[cycle.special[2]] =
        TurnToVector(c, normal, before.transpose() * (rotation * normal), qc).q[0];
    solutions.push_back(q);
  }
}

// The turns about three parallel axes as a motion in the plane at right angles to them.
class PlanarTurns {
 public:
  PlanarTurns(const SixAxes& axes, const JointCycle& cycle)
      : cycle_(cycle), h_(Axis(axes, 0).direction) {
    for (int i = 0; i < 3; ++i) {
      const JointAxis& axis = Axis(axes, i);
      points_[static_cast<std::size_t>(i)] = Flat(axis.point);
      signs_[i] = axis.direction.dot(h_) > 0 ? 1 : -1;
    }
  }

  // Adds the turns whose product is the motion.
  void Add(const Pose& motion, SixAngles q, const SixAngles& reference,
           ClosedFormSolutions& solutions) const {
    const Vector3 normal = AnyNormal(h_);
    const double sum = TurnToVector(h_, normal, motion.linear() * normal).q[0];
    const Vector3 target = Flat(motion * points_[2]) - points_[0];
    const Vector3 forearm = points_[2] - points_[1];
    const Vector3 upper = points_[0] - points_[1];
    const auto [ra, rb, rc] = At(reference, cycle_.special);
    for (const SubproblemAngles<1>& elbow :
         TurnToDistance(h_, forearm, upper, target.norm(), signs_[1] * rb)) {
      const Vector3 reach = Eigen::AngleAxisd(elbow.q[0], h_) * forearm - upper;
      const double shoulder = TurnToVector(h_, reach, target, signs_[0] * ra).q[0];
      q[cycle_.special[0]] = signs_[0] * shoulder;
      q[cycle_.special[1]] = signs_[1] * elbow.q[0];
      q[cycle_.special[2]] = signs_[2] * (sum - shoulder - elbow.q[0]);
      solutions.push_back(q);
    }
  }

 private:
  const JointAxis& Axis(const SixAxes& axes, int i) const {
    return axes[static_cast<std::size_t>(cycle_.special[static_cast<std::size_t>(i)])];
  }
  Vector3 Flat(const Vector3& p) const { return p - h_ * h_.dot(p); }

  const JointCycle& cycle_;
  Vector3 h_;
  std::array<Vector3, 3> points_;
  Vector3 signs_;  // -1 for an axis opposite to the first
};

// The special three keep the direction h and all heights along it, and so do the other three with
// the inverse motion. Both facts, without the turn about the middle of the others, are equations
// for the outer two.
std::array<TwoAngleEquation, 2> KeepDirectionAndHeight(const JointCycle& cycle, const Vector3& h,
                                                       const Pose& motion) {
  const Vector3& p = cycle.axes[1].point;
  const Vector3& k = cycle.axes[1].direction;
  const Vector3 g = cycle.inverse.linear() * h;
  const TurnCircle h_back = CircleOf({cycle.axes[0].direction, Vector3::Zero()}, h);
  const TurnCircle g_turned = CircleOf({cycle.axes[2].direction, Vector3::Zero()}, g);
  const TurnCircle first = CircleOf(cycle.axes[0], p);
  const TurnCircle last = CircleOf(cycle.axes[2], p);
  return {{{-k.dot(h_back.along), k.dot(h_back.across), k.dot(g_turned.along),
            k.dot(g_turned.across), k.dot(h_back.centre - g_turned.centre)},
           {h.dot(first.along), h.dot(first.across), -g.dot(last.along), g.dot(last.across),
            g.dot(last.centre) + h.dot(motion.translation() - first.centre)}}};
}

}  // namespace

ClosedFormSolutions SolveConcurrent(const SixAxes& axes, const ArmClass& arm, const Pose& motion,
                                    const SixAngles& reference) {
  const JointCycle cycle = CycleOf(axes, arm.first, motion);
  ClosedFormSolutions solutions;
  for (const SubproblemAngles<3>& turns : TurnToPoint(cycle.axes, cycle.inverse * arm.centre,
                                                      arm.centre, At(reference, cycle.others))) {
    SixAngles q;
    for (std::size_t i = 0; i < 3; ++i) q[cycle.others[i]] = turns.q[i];
    AddRotation(axes, cycle, cycle.Others(q).linear().transpose(), q, reference, solutions);
  }
  return solutions;
}

ClosedFormSolutions SolveParallel(const SixAxes& axes, const ArmClass& arm, const Pose& motion,
                                  const SixAngles& reference) {
  const JointCycle cycle = CycleOf(axes, arm.first, motion);
  const PlanarTurns planar(axes, cycle);
  const Vector3& h = axes[static_cast<std::size_t>(arm.first)].direction;
  const Vector3& k = cycle.axes[1].direction;
  const auto [r0, r1, r2] = At(reference, cycle.others);
  ClosedFormSolutions solutions;
  for (const SubproblemAngles<2>& outer :
       SolveTwoAngles(KeepDirectionAndHeight(cycle, h, motion), {r0, r2})) {
    SixAngles q;
    q[cycle.others[0]] = outer.q[0];
    q[cycle.others[2]] = outer.q[1];
    const Vector3 back = Eigen::AngleAxisd(-outer.q[0], cycle.axes[0].direction) * h;
    const Vector3 turned =
        Eigen::AngleAxisd(outer.q[1], cycle.axes[2].direction) * (cycle.inverse.linear() * h);
    q[cycle.others[1]] = TurnToVector(k, turned, back, r1).q[0];
    planar.Add(cycle.Others(q).inverse(), q, reference, solutions);
  }
  return solutions;
}

}  // namespace assay::kinematics
