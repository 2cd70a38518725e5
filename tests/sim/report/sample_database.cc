#include "tests/sim/report/sample_database.h"

#include <cmath>

#include "sim/sweep/database/store.h"

namespace assay::report {
namespace {

using sweep::CellRecord;
using sweep::ClaimRecord;
using sweep::TimedTrial;

CellRecord Cell(int number, const std::string& noise, int trials) {
  return {
      .cell = number,
      .scenario = kHostileScenario,
      .clearance = 0.0005,
      .error_scale = 1,
      .propagation = "sound",
      .resolvers = "sensing,squeezing",
      .noise = noise,
      .sensing = "drawn",
      .seed = 1,
      .trials = trials,
      .grasp = "friction",
      .outcome = "planned",
      .actions = 2,
      .errors = 1,
      .conflict = "",
      .plan = R"({"actions": [{"id": "action_2", "name": "pickup", "arguments": {"part": "peg"}},
                      {"id": "action_1", "name": "assemble",
                       "arguments": {"held": "peg", "fixed": "<block>"}}],
                      "verifications": [{}]})"};
}

const ClaimRecord kX = {
    "1/after/x", 1,     "action_2", "after", kHostilePart, domain::Dimension::kLength,
    -0.001,      0.001, true,       0.00001};
const ClaimRecord kTheta = {"2/after/theta",           2,     "action_1", "after", "theta of peg",
                            domain::Dimension::kAngle, -0.01, 0.01,       true,    0.001};

TimedTrial Trial(int trial, int cell, int number) {
  const double x = cell == 1 ? 0 : 0.0001 * (2 * number - 11);
  const double theta = cell == 1 || number < 9 ? 0 : number == 9 ? 0.0105 : 0.02;
  const std::string verdict = theta < 0.01    ? "contained"
                              : theta < 0.011 ? "inconclusive"
                                              : "violated";
  const bool errs = cell == 2 && number <= 4;
  const bool fails = errs && number > 2;
  TimedTrial timed;
  timed.seconds = 2;
  timed.claims = {kX, kTheta};
  timed.record = {.trial = trial,
                  .cell = cell,
                  .number = number,
                  .noise = "",
                  .outcome = fails ? "operator-called" : "succeeded",
                  .reason = "",
                  .errors_signalled = errs ? 1 : 0,
                  .recovered = errs && !fails ? 1 : 0,
                  .operator_called = fails,
                  .warnings = "",
                  .counts = {theta < 0.01 ? 2 : 1, verdict == "inconclusive" ? 1 : 0,
                             verdict == "violated" ? 1 : 0, 0},
                  .verdicts = {{1, "action_2", "contained", kX.name, x, kX.low, kX.high,
                                0.001 - std::abs(x), kX.gate},
                               {2, "action_1", verdict, kTheta.name, theta, kTheta.low, kTheta.high,
                                0.01 - theta, kTheta.gate}},
                  .observations = {{kX.claim, x}, {kTheta.claim, theta}}};
  return timed;
}

constexpr const char* kFalsification = R"sql(
INSERT INTO attack(cell, attempts, contained, inconclusive, violated, not_claimed, claims_contained,
  claims_inconclusive, claims_violated, claims_not_claimed)
  VALUES(3, 20000, 19990, 8, 2, 0, 99000, 10, 2, 0);
INSERT INTO attack_worst(cell, claim, step, action, about, name, unit, observed, low, high, margin,
  gate, verdict, phase, attempt, noise)
  VALUES(3, '2/after/y', 2, 'action_1', 'after', 'y of peg', 'm', 0.003, -0.001, 0.001, -0.002,
         0.00002, 'violated', 'vertices', 17, 'dy_block=0.0028 theta_block=-0.09');
INSERT INTO counterexample(cell, number, claim, action, name, unit, observed, low, high, margin,
  gate, noise, steps, replayed, multiple, replay)
  VALUES(3, 1, '2/after/y', 'action_1', 'y of peg', 'm', 0.0025, -0.001, 0.001, -0.0015, 0.00002,
         'theta_block=-0.08', 2, 1, 0.5, 'assay replay DB --counterexample 3/1');
INSERT INTO conservatism(cell, variable, guaranteed, broken, ratio)
  VALUES(3, 'all', 1, 3, 3), (3, 'dx_block', 1.5, NULL, NULL);
)sql";

}  // namespace

void WriteSampleDatabase(const std::filesystem::path& file, bool tried) {
  sweep::Store store = sweep::Store::Create(
      file,
      {{"format", "assay-sweep/1"},
       {"path", "sweeps/<sample>.yaml"},
       {"text", "format: assay-sweep/1\ntitle: Pegs & <holes>\nscenarios: [a.yaml]\ntrials: 10\n"},
       {"trials", "11"},
       {"version", "1.2.3"}});
  store.Add({.started = "2026-01-02T03:04:05Z",
             .shard = "1/1",
             .jobs = 2,
             .version = "1.2.3",
             .machine = "a & b",
             .cores = 2,
             .os = "an <os>"});
  store.Add({Cell(1, "none", 1), Cell(2, "uniform", 10), Cell(3, "attack", 0)}, 6);
  std::vector<TimedTrial> trials = {Trial(1, 1, 1)};
  for (int number = 1; number <= 10; ++number) trials.push_back(Trial(number + 1, 2, number));
  store.Add(trials);
  if (tried) store.database().Execute(kFalsification);
  store.Close();
}

}  // namespace assay::report
