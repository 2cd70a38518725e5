#pragma once

#include <string>
#include <vector>

#include "planner/base/random.h"
#include "planner/kinematics/inverse/serial_chain.h"

namespace assay::workloads {

// A row of a standard Denavit-Hartenberg table. Lengths are in metres, angles in radians.
struct DenavitHartenbergRow {
  double alpha = 0;
  double a = 0;
  double d = 0;
};

// Returns the chain of a table, with a joint for each row. Limits are half a turn either way.
kinematics::SerialChain ChainOf(const std::vector<DenavitHartenbergRow>& table);

struct NamedChain {
  std::string name;
  kinematics::SerialChain chain;
};

// Arms with six joints, from the parameters that their makers publish: Puma 560 and 762, ABB IRB
// 120, KUKA KR 6 R900, UR5e.
std::vector<NamedChain> PublishedArms();
// Arms with seven joints: KUKA iiwa 7, Franka Panda.
std::vector<NamedChain> PublishedRedundantArms();

// Returns the arm with axes that are turned and moved by up to `most` (radians, metres) in each
// coordinate, as a calibration or the rounding of a file does.
NamedChain Disturbed(const NamedChain& arm, double most, RandomStream& random);

// Random arms: one for each place of three axes that meet, one for each place of three parallel
// axes, one with pairs of axes that meet and are parallel, one with an offset wrist, one without
// any structure.
std::vector<NamedChain> RandomArms(RandomStream& random);

// Returns joint values from -pi to pi.
kinematics::ChainVector RandomTurns(RandomStream& random, int joints);

}  // namespace assay::workloads
