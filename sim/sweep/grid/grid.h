#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sim/sweep/grid/sweep_file.h"

namespace assay::sweep {

// A point of a sweep's grid. Its plan is executed in trials that differ only in their errors.
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
  int first_trial = 1;    // the number of the cell's first trial in the whole sweep
  int falsification = 0;  // number among the falsification cells, from 1; 0: no such cell

  bool operator==(const Cell&) const = default;
};

// Returns all cells. The axes are nested in the order of the members of Cell, so seeds change
// fastest.
std::vector<Cell> Cells(const Sweep& sweep);

// Returns the number of trials of the whole sweep. Trials are numbered from 1 to it.
int TrialCount(const std::vector<Cell>& cells);

// The place of a trial in the grid.
struct TrialPlace {
  std::size_t cell = 0;  // index in the cells
  int number = 0;        // number in its cell, from 1
};
// Returns the place in the grid of a trial with a number from 1. The trial must exist (checked).
TrialPlace PlaceOf(const std::vector<Cell>& cells, int trial);

// Returns whether both cells execute the same plan, with different noise, sensing or seed.
bool SharePlan(const Cell& a, const Cell& b);

// A share of the trials of a sweep: the trials with numbers index, index + count, and so on. Each
// shard has an equal share of every cell, so that shards take equally long. Each shard makes the
// plans of its cells anew. Falsifications take longer and are distributed separately.
struct Shard {
  int index = 1;  // 1 to count
  int count = 1;

  bool Has(int trial) const { return (trial - 1) % count == index - 1; }
  bool Has(const Cell& cell, int trial) const {
    return Has(cell.falsification > 0 ? cell.falsification : trial);
  }
};

}  // namespace assay::sweep
