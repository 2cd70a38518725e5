#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sim/sweep/run/sweep_file.h"

namespace assay::sweep {

// One point of a sweep's grid, at which a plan is executed in trials that differ in their noise.
struct Cell {
  int number = 0;  // from 1
  std::string scenario;
  std::optional<double> clearance;
  double error_scale = 1;
  uncertainty::Propagation propagation = uncertainty::Propagation::kSound;
  std::optional<Resolvers> resolvers = {};
  scene::GraspMode grasp = scene::GraspMode::kFriction;
  Sensing sensing = Sensing::kDrawn;
  NoiseKind noise = NoiseKind::kUniform;
  std::uint64_t seed = 0;
  int trials = 0;
  int first_trial = 1;  // the number of its first trial in the whole sweep
  int attack = 0;       // its number among the attacked cells, from 1; 0: it is none

  bool operator==(const Cell&) const = default;
};

// All cells, in the order of the axes as the members of Cell stand: seeds change fastest.
std::vector<Cell> Cells(const Sweep& sweep);

// Of the whole sweep: their numbers are 1 to this.
int TrialCount(const std::vector<Cell>& cells);

// Where a trial stands. The number counts from 1; checked that there is such a trial.
struct TrialPlace {
  std::size_t cell = 0;  // index in the cells
  int number = 0;        // in its cell, from 1
};
TrialPlace PlaceOf(const std::vector<Cell>& cells, int trial);

// The same plan, executed under other noise.
bool SharePlan(const Cell& a, const Cell& b);

// A share of the trials of a sweep: those with numbers index, index + count, ... Every cell is cut
// alike, so that shards take equally long; each makes the plans of its cells anew. Attacks, which
// take longer, are dealt out by themselves.
struct Shard {
  int index = 1;  // 1 to count
  int count = 1;

  bool Has(int trial) const { return (trial - 1) % count == index - 1; }
  bool Has(const Cell& cell, int trial) const { return Has(cell.attack > 0 ? cell.attack : trial); }
};

}  // namespace assay::sweep
