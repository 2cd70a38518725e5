#include "sim/sweep/grid/grid.h"

#include <algorithm>

#include "planner/base/check.h"

namespace assay::sweep {
namespace {

// Returns a copy of every cell for each value of the axis.
template <class T>
std::vector<Cell> Spread(const std::vector<Cell>& cells, const std::vector<T>& axis,
                         T Cell::*member) {
  std::vector<Cell> spread;
  for (const Cell& cell : cells) {
    for (const T& value : axis) {
      spread.push_back(cell);
      spread.back().*member = value;
    }
  }
  return spread;
}

int TrialsOf(const Sweep& sweep, const Cell& cell) {
  switch (cell.noise) {
    case NoiseKind::kNone:
      return sweep.control_trials;
    case NoiseKind::kUniform:
    case NoiseKind::kVertices:
    case NoiseKind::kLowDiscrepancy:
      return sweep.trials;
    case NoiseKind::kFalsification:
      return 1;
  }
  ASSAY_CHECK(false, "a kind of noise that the switch does not know");
  return 0;
}

}  // namespace

std::vector<Cell> Cells(const Sweep& sweep) {
  std::vector<Cell> cells(1);
  cells = Spread(cells, sweep.scenarios, &Cell::scenario);
  cells = Spread(cells, sweep.clearances, &Cell::clearance);
  cells = Spread(cells, sweep.error_scales, &Cell::error_scale);
  cells = Spread(cells, sweep.propagations, &Cell::propagation);
  cells = Spread(cells, sweep.resolvers, &Cell::resolvers);
  cells = Spread(cells, sweep.grasps, &Cell::grasp);
  cells = Spread(cells, sweep.sensings, &Cell::sensing);
  cells = Spread(cells, sweep.noises, &Cell::noise);
  cells = Spread(cells, sweep.seeds, &Cell::seed);
  int number = 0;
  int first_trial = 1;
  int falsifications = 0;
  for (Cell& cell : cells) {
    cell.number = ++number;
    cell.trials = TrialsOf(sweep, cell);
    if (cell.noise == NoiseKind::kFalsification) cell.falsification = ++falsifications;
    cell.first_trial = first_trial;
    first_trial += cell.trials;
  }
  return cells;
}

int TrialCount(const std::vector<Cell>& cells) {
  return cells.back().first_trial + cells.back().trials - 1;
}

TrialPlace PlaceOf(const std::vector<Cell>& cells, int trial) {
  ASSAY_CHECK(trial >= 1 && trial <= TrialCount(cells), "trial {}", trial);
  const auto after = std::ranges::upper_bound(cells, trial, {}, &Cell::first_trial);
  const auto cell = std::prev(after);
  return {static_cast<std::size_t>(cell - cells.begin()), trial - cell->first_trial + 1};
}

bool SharePlan(const Cell& a, const Cell& b) {
  return a.scenario == b.scenario && a.clearance == b.clearance && a.error_scale == b.error_scale &&
         a.propagation == b.propagation && a.resolvers == b.resolvers && a.grasp == b.grasp;
}

}  // namespace assay::sweep
