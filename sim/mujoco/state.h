#pragma once

#include <cstdint>
#include <vector>

namespace assay::mujoco {

// All that a step reads: two simulations of one model in the same state go the same way, to the
// bit. Plain data, in the engine's layout.
struct State {
  double time = 0;
  double timestep = 0;
  std::vector<double> qpos;
  std::vector<double> qvel;
  std::vector<double> act;
  std::vector<double> qacc_warmstart;
  std::vector<double> ctrl;
  std::vector<double> qfrc_applied;
  std::vector<double> xfrc_applied;
  std::vector<double> mocap_pos;
  std::vector<double> mocap_quat;
  std::vector<std::uint8_t> eq_active;  // of the equality constraints, which the engine keeps in
  std::vector<double> eq_data;          // its model
  std::vector<double> geom_pos;         // of all geoms, likewise

  bool operator==(const State&) const = default;
};

}  // namespace assay::mujoco
