#include "bench/workloads/published_arms.h"

#include <fmt/format.h>

#include <numbers>

namespace assay::workloads {
namespace {

using kinematics::ChainJoint;
using kinematics::Pose;
using kinematics::SerialChain;
using DenavitHartenbergTable = std::vector<DenavitHartenbergRow>;

constexpr double kRight = std::numbers::pi / 2;

DenavitHartenbergTable RandomTable(RandomStream& random) {
  DenavitHartenbergTable table(6);
  for (DenavitHartenbergRow& row : table) {
    row.alpha = random.Uniform(-3, 3);
    row.a = random.Uniform(-0.5, 0.5);
    row.d = random.Uniform(-0.5, 0.5);
  }
  return table;
}

}  // namespace

SerialChain ChainOf(const DenavitHartenbergTable& table) {
  Pose X = Pose::Identity();
  std::vector<ChainJoint> joints;
  for (const DenavitHartenbergRow& row : table) {
    joints.push_back({.name = fmt::format("joint{}", joints.size() + 1),
                      .axis = {X.linear().col(2), X.translation()},
                      .limits = {-std::numbers::pi, std::numbers::pi, 1, 1}});
    X = X * Eigen::Translation3d(row.a, 0, row.d) *
        Eigen::AngleAxisd(row.alpha, Eigen::Vector3d::UnitX());
  }
  return SerialChain(joints, X);
}

std::vector<NamedChain> PublishedArms() {
  const double r = kRight;
  return {
      {"Puma 560", ChainOf({{-r, 0, 0},
                            {0, 0.4318, 0.15005},
                            {r, -0.0203, 0},
                            {-r, 0, 0.4318},
                            {r, 0, 0},
                            {0, 0, 0.056}})},
      {"Puma 762",
       ChainOf({{-r, 0, 0}, {0, 0.65, 0.19}, {r, 0, 0}, {-r, 0, 0.6}, {r, 0, 0}, {0, 0, 0.125}})},
      {"IRB 120",
       ChainOf(
           {{-r, 0, 0.29}, {0, 0.27, 0}, {-r, 0.07, 0}, {r, 0, 0.302}, {-r, 0, 0}, {0, 0, 0.072}})},
      {"KR 6 R900", ChainOf({{-r, 0.025, 0.4},
                             {0, 0.455, 0},
                             {-r, 0.035, 0},
                             {r, 0, 0.42},
                             {-r, 0, 0},
                             {0, 0, 0.08}})},
      {"UR5e", ChainOf({{r, 0, 0.1625},
                        {0, -0.425, 0},
                        {0, -0.3922, 0},
                        {r, 0, 0.1333},
                        {-r, 0, 0.0997},
                        {0, 0, 0.0996}})},
  };
}

std::vector<NamedChain> PublishedRedundantArms() {
  const double r = kRight;
  return {
      {"iiwa 7", ChainOf({{-r, 0, 0.34},
                          {r, 0, 0},
                          {r, 0, 0.4},
                          {-r, 0, 0},
                          {-r, 0, 0.4},
                          {r, 0, 0},
                          {0, 0, 0.126}})},
      {"Panda", ChainOf({{-r, 0, 0.333},
                         {r, 0, 0},
                         {r, 0.0825, 0.316},
                         {-r, -0.0825, 0},
                         {r, 0, 0.384},
                         {r, 0.088, 0},
                         {0, 0, 0.107}})},
  };
}

NamedChain Disturbed(const NamedChain& arm, double most, RandomStream& random) {
  const auto disturbance = [&]() -> geometry::Vector3 {
    return {random.Uniform(-most, most), random.Uniform(-most, most), random.Uniform(-most, most)};
  };
  std::vector<ChainJoint> joints = arm.chain.joints();
  for (ChainJoint& joint : joints) {
    joint.axis.direction = (joint.axis.direction + disturbance()).normalized();
    joint.axis.point += disturbance();
  }
  return {fmt::format("{} disturbed by {:.0e}", arm.name, most),
          SerialChain(std::move(joints), arm.chain.X_BaseTipAtZero())};
}

std::vector<NamedChain> RandomArms(RandomStream& random) {
  std::vector<NamedChain> arms;
  for (std::size_t i = 0; i < 4; ++i) {
    DenavitHartenbergTable table = RandomTable(random);
    table[i].a = table[i + 1].a = table[i + 1].d = 0;
    arms.push_back({fmt::format("axes {} to {} meet", i + 1, i + 3), ChainOf(table)});
    table = RandomTable(random);
    table[i].alpha = table[i + 1].alpha = 0;
    arms.push_back({fmt::format("axes {} to {} are parallel", i + 1, i + 3), ChainOf(table)});
  }
  DenavitHartenbergTable pairs = RandomTable(random);
  pairs[0].a = pairs[4].a = 0;
  pairs[2].alpha = 0;
  arms.push_back({"pairs of axes", ChainOf(pairs)});
  arms.push_back({"offset wrist", ChainOf({{-kRight, 0.03, 0.2},
                                           {0, 0.65, 0},
                                           {-kRight, 0.05, 0},
                                           {kRight, 0, 0.6},
                                           {-kRight, 0, 0.15},
                                           {0, 0, 0.125}})});
  arms.push_back({"general", ChainOf(RandomTable(random))});
  return arms;
}

kinematics::ChainVector RandomTurns(RandomStream& random, int joints) {
  kinematics::ChainVector q(joints);
  for (double& angle : q) angle = random.Uniform(-std::numbers::pi, std::numbers::pi);
  return q;
}

}  // namespace assay::workloads
