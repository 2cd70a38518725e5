#include "planner/kinematics/dynamics/arm_dynamics.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "bench/workloads/reachable_poses.h"
#include "planner/base/random.h"
#include "planner/geometry/pose.h"

namespace assay::kinematics::arm_dynamics_test {
namespace {

using workloads::RandomJoints;

constexpr std::uint64_t kSeed = 31;
const Vector3 kGravity(0.7, -2, -9);  // of a base that leans

Arm ReadArm(const std::string& name) {
  ArmInFile in_file;
  if (name == "iiwa7") in_file.locked = {{"a3", 0}};
  return Arm::FromUrdf(fmt::format("{}/models/robots/{}/{}.urdf", ASSAY_SOURCE_DIR, name, name),
                       in_file);
}

const Gripper& Jaw() {
  static const Gripper gripper =
      Gripper::FromUrdf(ASSAY_SOURCE_DIR "/models/grippers/parallel-jaw/gripper.urdf");
  return gripper;
}

// A body that moves with a link of the arm, at one posture.
struct PlacedBody {
  double mass = 0;
  Vector3 center = Vector3::Zero();
  Matrix3 inertia = Matrix3::Zero();  // along the axes of the base
};

// The mechanics of the arm by energies, whose derivatives are differences. Lagrange's equations
// give the torques.
class ByEnergies {
 public:
  ByEnergies(const Arm& arm, std::optional<Inertial> load) : arm_(arm), load_(std::move(load)) {}

  JointVector Torques(const JointMotion& m) const {
    constexpr double h = 1e-5;
    JointVector torques;
    for (int j = 0; j < 6; ++j) {
      const JointVector dq = h * JointVector::Unit(j);
      const auto momentum = [&](double t) {
        const JointVector q = m.q + t * m.qd + t * t / 2 * m.qdd;
        const JointVector qd = m.qd + t * m.qdd;
        return (Kinetic(q, qd + JointVector::Unit(j)) - Kinetic(q, qd - JointVector::Unit(j))) / 2;
      };
      torques[j] = (momentum(h) - momentum(-h)) / (2 * h) -
                   (Kinetic(m.q + dq, m.qd) - Kinetic(m.q - dq, m.qd)) / (2 * h) +
                   (Potential(m.q + dq) - Potential(m.q - dq)) / (2 * h);
    }
    return torques;
  }

 private:
  std::vector<PlacedBody> Bodies(const JointVector& q) const {
    std::vector<PlacedBody> bodies;
    const auto add = [&](const Pose& X_BaseLink, const Inertial& inertial) {
      const Pose X = X_BaseLink * inertial.X_LinkCenter;
      bodies.push_back(
          {inertial.mass, X.translation(), X.linear() * inertial.inertia * X.linear().transpose()});
    };
    const auto X_BaseLink = arm_.LinkPoses(q);
    for (std::size_t i = 1; i < 7; ++i) add(X_BaseLink[i], *arm_.model().links[i].inertial);
    const RobotModel& gripper = Jaw().model();
    std::vector<Pose> X_FlangeLink(gripper.links.size(), Pose::Identity());
    for (std::size_t i = 0; i < gripper.links.size(); ++i) {
      if (i > 0) {
        const Joint& joint = gripper.joints[i - 1];
        X_FlangeLink[i] = X_FlangeLink[joint.parent.index()] * joint.X_ParentChild(0);
      }
      if (gripper.links[i].inertial) {
        add(X_BaseLink[6] * X_FlangeLink[i], *gripper.links[i].inertial);
      }
    }
    if (load_) add(X_BaseLink[6], *load_);
    return bodies;
  }

  // The velocities are differences of poses along q + t qd.
  double Kinetic(const JointVector& q, const JointVector& qd) const {
    constexpr double h = 1e-5;
    const auto now = Bodies(q);
    const auto before = Bodies(q - h * qd);
    const auto after = Bodies(q + h * qd);
    const auto omegas = AngularVelocities(q, qd);
    double energy = 0;
    for (std::size_t i = 0; i < now.size(); ++i) {
      const Vector3 v = (after[i].center - before[i].center) / (2 * h);
      const Vector3& omega = omegas[std::min<std::size_t>(i, 5)];
      energy += now[i].mass * v.squaredNorm() / 2 + omega.dot(now[i].inertia * omega) / 2;
    }
    return energy;
  }

  std::array<Vector3, 6> AngularVelocities(const JointVector& q, const JointVector& qd) const {
    const auto X_BaseLink = arm_.LinkPoses(q);
    std::array<Vector3, 6> omegas;
    Vector3 omega = Vector3::Zero();
    for (std::size_t i = 0; i < 6; ++i) {
      omega += qd[static_cast<int>(i)] * (X_BaseLink[i + 1].linear() * arm_.model().joints[i].axis);
      omegas[i] = omega;
    }
    return omegas;
  }

  double Potential(const JointVector& q) const {
    double energy = 0;
    for (const PlacedBody& body : Bodies(q)) energy -= body.mass * kGravity.dot(body.center);
    return energy;
  }

  const Arm& arm_;
  std::optional<Inertial> load_;
};

TEST(ArmDynamics, FollowsFromTheEnergies) {
  RandomStream random(kSeed, "dynamics");
  for (const std::string name : {"puma762", "ur5e", "iiwa7"}) {
    const Arm arm = ReadArm(name);
    const ArmDynamics empty(arm, Jaw(), kGravity);
    Inertial load{.mass = 1.5, .inertia = Vector3(0.002, 0.004, 0.003).asDiagonal()};
    load.X_LinkCenter = geometry::Translation(0.05, 0.02, 0.2) * geometry::RotationX(0.4);
    const ArmDynamics loaded = empty.Carrying(load);
    const ByEnergies empty_energies(arm, std::nullopt);
    const ByEnergies loaded_energies(arm, load);
    for (int i = 0; i < 20; ++i) {
      JointMotion motion{.q = RandomJoints(2.5, random)};
      for (int j = 0; j < 6; ++j) {
        motion.qd[j] = random.Uniform(-2, 2);
        motion.qdd[j] = random.Uniform(-5, 5);
      }
      const JointVector want = empty_energies.Torques(motion);
      EXPECT_LT((empty.Torques(motion) - want).norm(), 1e-4 * (1 + want.norm()))
          << name << ", case " << i << " of seed " << kSeed;
      const JointVector want_loaded = loaded_energies.Torques(motion);
      EXPECT_LT((loaded.Torques(motion) - want_loaded).norm(), 1e-4 * (1 + want_loaded.norm()))
          << name << ", case " << i << " of seed " << kSeed;
    }
  }
}

}  // namespace
}  // namespace assay::kinematics::arm_dynamics_test
