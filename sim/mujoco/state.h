#pragma once

#include <cstdint>
#include <vector>

namespace assay::mujoco {

// All data that a step reads. Two simulations of one model in the same state stay the same, to the
// bit. The data are in the engine's layout.
struct State {
  double time = 0;
  std::vector<double> qpos;
  std::vector<double> qvel;
  std::vector<double> act;
  std::vector<double> qacc_warmstart;
  std::vector<double> ctrl;
  std::vector<double> qfrc_applied;
  std::vector<double> xfrc_applied;
  std::vector<double> mocap_pos;
  std::vector<double> mocap_quat;
  // The engine keeps the following four arrays in its model: two for the equality constraints, and
  // the positions and contact impedances of all geoms.
  std::vector<std::uint8_t> eq_active;
  std::vector<double> eq_data;
  std::vector<double> geom_pos;
  std::vector<double> geom_solimp;

  bool operator==(const State&) const = default;
};

}  // namespace assay::mujoco
