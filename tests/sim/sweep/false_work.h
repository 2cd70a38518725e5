#pragma once

#include <fmt/format.h>

#include <limits>
#include <string>

#include "planner/base/random.h"
#include "sim/sweep/work.h"

namespace assay::sweep {

// Plans and trials without planner and physics, which depend on cell and number alone, as the real
// ones do.
inline CellRecord FalseCell(const Cell& cell) {
  return {.cell = cell.number,
          .scenario = cell.scenario,
          .clearance = cell.clearance.value_or(0.0005),
          .error_scale = cell.error_scale,
          .propagation = std::string(Name(cell.propagation)),
          .noise = std::string(noise::Name(cell.noise)),
          .sensing = std::string(Name(cell.sensing)),
          .seed = static_cast<std::int64_t>(cell.seed),
          .trials = cell.trials,
          .grasp = std::string(Name(cell.grasp)),
          .outcome = "planned",
          .actions = 2,
          .errors = 1,
          .conflict = "",
          .plan = "{\"plan\": \"of " + cell.scenario + "\"}",
          .gate = {{{.components = {{check::Claimed::kBefore, "x of 'peg'", 1e-6, 2e-6},
                                    {check::Claimed::kPrecondition, "", 0, 3e-6}},
                     .arm = 0.01,
                     .penetration = 4e-6},
                    {.creep = 3e-7, .force_ripple = 0.5}}}};
}

inline TimedTrial FalseTrial(const PlannedCell& planned, int number) {
  RandomStream random(planned.cell.seed, fmt::format("{} {} {}", planned.cell.scenario,
                                                     noise::Name(planned.cell.noise), number));
  const double x = random.Uniform(-1, 1);
  const bool failed = x > 0.5;
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  TimedTrial timed;
  timed.seconds = 0.001 * random.Uniform();
  timed.claims = {
      {"1/before/x of 'peg'", 1, "action_2", "before", "x of 'peg'", "m", -0.5, 0.5, true, 1e-6},
      {"2/after/y of peg", 2, "action_1", "after", "y of peg", "m", -kInfinity, 0.75, false, 2e-6}};
  timed.record = {
      .noise = fmt::format("dx_peg={}", x),
      .outcome = failed ? "not-seated" : "succeeded",
      .reason = failed ? "because" : "",
      .simulated = 10 + x,
      .steps = 20'000 + random.Index(100),
      .errors_signalled = failed ? 2 : 0,
      .recovered = failed ? 1 : 0,
      .operator_called = failed,
      .warnings = "",
      .counts = {1, 0, failed ? 1 : 0, failed ? 0 : 1},
      .verdicts = {{1, "action_2", failed ? "violated" : "contained", "x of 'peg'", x, -0.5, 0.5,
                    0.5 - x, 1e-6},
                   {2, "action_1", "contained", "y of peg", -x, -kInfinity, 0.75, 0.75 + x, 2e-6}},
      .observations = {{"1/before/x of 'peg'", x}, {"2/after/y of peg", -x}}};
  return timed;
}

inline Work FalseWork() {
  return {.plan =
              [](const Cell& cell) {
                return PlannedCell{cell, FalseCell(cell), nullptr};
              },
          .restore =
              [](const Cell& cell, const CellRecord& record) {
                return PlannedCell{cell, record, nullptr};
              },
          .run = FalseTrial};
}

}  // namespace assay::sweep
