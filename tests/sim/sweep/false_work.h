#pragma once

#include <fmt/format.h>

#include <limits>
#include <string>

#include "planner/base/random.h"
#include "sim/sweep/runner/work.h"

namespace assay::sweep {

// Plans and trials without planner and physics. They depend on the cell and the number alone, as
// the real ones do.
inline CellRecord FalseCell(const Cell& cell) {
  return {.cell = cell.number,
          .scenario = cell.scenario,
          .clearance = cell.clearance.value_or(0.0005),
          .error_scale = cell.error_scale,
          .propagation = std::string(Name(cell.propagation)),
          .resolvers = cell.resolvers ? Name(*cell.resolvers) : "sensing",
          .noise = std::string(Name(cell.noise)),
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
                    {.lag = 3e-7, .lag_turn = 5e-7}}}};
}

inline TimedTrial FalseTrial(const PlannedCell& planned, int number) {
  RandomStream random(planned.cell.seed, fmt::format("{} {} {}", planned.cell.scenario,
                                                     Name(planned.cell.noise), number));
  const double x = random.Uniform(-1, 1);
  const bool failed = x > 0.5;
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  TimedTrial timed;
  timed.seconds = 0.001 * random.Uniform();
  timed.claims = {{"1/before/x of 'peg'", 1, "action_2", "before", "x of 'peg'",
                   domain::Dimension::kLength, -0.5 + 0.001 * number, 0.5, true, 1e-6},
                  {"2/after/y of peg", 2, "action_1", "after", "y of peg",
                   domain::Dimension::kLength, -kInfinity, 0.75, false, 2e-6}};
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

constexpr int kFalseAttempts = 25;

// Returns a record in which some plans are falsified. For one variable, no ratio is known.
inline FalsificationRecord MadeUpFalsificationRecord(const Cell& cell) {
  RandomStream random(cell.seed, fmt::format("{} {}", cell.scenario, cell.error_scale));
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const double x = random.Uniform(-1, 1);
  const bool broken = x < 0;
  const std::string noise = fmt::format("dx_peg={}", x);
  FalsificationRecord record{
      .attempts = kFalseAttempts,
      .certificates = {kFalseAttempts - (broken ? 3 : 0), 0, broken ? 3 : 0, 0},
      .claims = {40, 7, broken ? 4 : 0, 2}};
  record.worst = {
      {"1/before/x of 'peg'", 1, "action_2", "before", "x of 'peg'", domain::Dimension::kLength,
       0.1, -0.5, 0.5, 0.4, 1e-6, "contained", "vertices", 4, noise},
      {"2/after/y of peg", 2, "action_1", "after", "y of peg", domain::Dimension::kLength, 0.75 - x,
       -kInfinity, 0.75, x, 2e-6, broken ? "violated" : "contained", "local-search", 24, noise}};
  if (broken) {
    record.counterexamples = {{1, "2/after/y of peg", "action_1", "y of peg",
                               domain::Dimension::kLength, 0.75 - x, -kInfinity, 0.75, x, 2e-6,
                               noise, 2, true, 0.25,
                               "assay run " + cell.scenario + " --errors '" + noise + "'"}};
  }
  record.conservatism = {{"all", 1.5, broken ? std::optional(2.25) : std::nullopt,
                          broken ? std::optional(1.5) : std::nullopt},
                         {"x of 'peg'", 0, 4, std::nullopt}};
  return record;
}

inline TimedTrial MadeUpFalsification(const PlannedCell& planned,
                                      const FalsificationControl& control) {
  for (int attempt = 1; attempt <= kFalseAttempts; ++attempt) {
    if (control.progress) control.progress(attempt);
  }
  TimedTrial timed;
  timed.falsification = MadeUpFalsificationRecord(planned.cell);
  timed.seconds = 100;
  const WorstClaimRecord& worst = timed.falsification->worst.back();
  const bool broken = timed.falsification->certificates.violated > 0;
  timed.record = {.noise = worst.noise,
                  .outcome = broken ? "violated" : "succeeded",
                  .reason = broken ? "step 2 (action_1): y of peg" : "",
                  .warnings = "",
                  .counts = timed.falsification->certificates,
                  .verdicts = {{worst.step, worst.action, worst.verdict, worst.name, worst.observed,
                                worst.low, worst.high, worst.margin, worst.gate}}};
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
          .run = FalseTrial,
          .falsification = MadeUpFalsification};
}

}  // namespace assay::sweep
