#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sim/check/certificate_claims/claim.h"
#include "sim/check/noise_floor/noise_floor.h"

namespace assay::sweep {

using check::VerdictCounts;

// Records of the rows of the database. Apart from the seconds, they depend only on the sweep file,
// the files that it names and the program's version.

// The plan of a cell: one row of table `cell`. Each step has a row of table `gate`, and each
// component of the step's noise floor a row of table `gate_component`.
struct CellRecord {
  int cell = 0;
  std::string scenario;  // path of the scenario, as in the sweep file
  double clearance = 0;  // metres, the actual clearance
  double error_scale = 1;
  std::string propagation;
  std::string resolvers;  // the actual resolvers, like "sensing,squeezing"
  std::string noise, sensing;
  std::int64_t seed = 0;
  int trials = 0;
  std::string grasp;
  // "planned", "untestable" (check::Noiseless does not hold), "none" or "budget". Only a planned
  // cell has trials.
  std::string outcome;
  int actions = 0;
  int errors = 0;  // steps with a precondition that is not proved
  bool proved = false;
  // Why there are no trials, one reason per line: constraints that cannot hold together, limits of
  // the planner, or claims that are violated or cannot be tested in the execution without noise.
  std::string conflict;
  std::string plan;  // the contents of plan.json on one line
  check::NoiseFloor gate = {};
};

// A claim of a certificate, which is the same in all trials of a cell: a row of table `claim`.
struct ClaimRecord {
  std::string claim;   // name of the claim in the cell, like "2/after/x of peg"
  int step = 0;        // position in the order of execution, from 1
  std::string action;  // name of the step, like "action_3"
  std::string about;   // "before", "precondition" or "after"
  std::string name;
  domain::Dimension dimension = domain::Dimension::kRatio;  // column `unit`; a ratio for statements
  double low = 0;
  double high = 0;
  bool proved = true;
  double gate = 0;  // as in check::Claim

  bool operator==(const ClaimRecord&) const = default;
};

// The verdict on a step's certificate in a trial: a row of table `verdict`.
struct VerdictRecord {
  int step = 0;
  std::string action;
  std::string verdict;
  std::string claim;  // the name of the worst claim
  double observed = 0, low = 0, high = 0, margin = 0, gate = 0;

  bool operator==(const VerdictRecord&) const = default;
};

// The observed value of a claim: a row of table `observation`.
struct ObservationRecord {
  std::string claim;
  double observed = 0;

  bool operator==(const ObservationRecord&) const = default;
};

// One trial: a row of table `trial`, with its verdicts and observations. A whole falsification is
// one trial, too. Its noise is that of the worst claim. Its counts are sums over the certificates
// of all attempts, and its verdicts are the worst claims of each step. Its simulated time and steps
// are 0.
struct TrialRecord {
  int trial = 0;  // number in the sweep, from 1
  int cell = 0;
  int number = 0;          // number in the cell, from 1
  std::string noise;       // as noise::Text writes it
  std::string outcome;     // check::Name; for a falsification "succeeded" or "violated"
  std::string reason;      // empty if succeeded; for a falsification the worst claim
  double simulated = 0;    // seconds
  std::int64_t steps = 0;  // timesteps of the engine
  int errors_signalled = 0;
  int recovered = 0;
  bool operator_called = false;
  std::string warnings;  // warnings of the engine
  VerdictCounts counts = {};
  std::vector<VerdictRecord> verdicts = {};
  std::vector<ObservationRecord> observations = {};

  bool operator==(const TrialRecord&) const = default;
};

// The worst observation of a claim in a falsification: a row of table `attack_worst`.
struct WorstClaimRecord {
  std::string claim;  // the name in table `claim`
  int step = 0;
  std::string action, about, name;
  domain::Dimension dimension = domain::Dimension::kRatio;  // as in ClaimRecord
  double observed = 0, low = 0, high = 0, margin = 0, gate = 0;
  std::string verdict, phase;  // as check::Name writes them
  std::int64_t attempt = 0;    // number of the attempt, from 1
  std::string noise;           // as noise::Text writes it

  bool operator==(const WorstClaimRecord&) const = default;
};

// A shrunk violation, which needs every one of its errors: a row of table `counterexample`.
struct CounterexampleRecord {
  int number = 0;  // number in its cell, from 1
  std::string claim, action, name;
  domain::Dimension dimension = domain::Dimension::kRatio;  // as in ClaimRecord
  double observed = 0, low = 0, high = 0, margin = 0, gate = 0;
  std::string noise;
  int steps = 0;          // the number of steps that must be executed
  bool replayed = false;  // violated in an execution from the start of the plan, too
  double multiple = 1;    // a multiple of its errors with which the claim is still violated
  // The command that shows the violation again. It is `assay run` if its options can describe the
  // cell. Otherwise it is `assay replay DB TRIAL`, which repeats the whole falsification.
  std::string replay;

  // Returns whether the claim is a statement, which is either true (1) or false (0). Certificates
  // claim only that statements are true.
  bool IsStatement() const { return low == 1 && high == 1; }
  bool operator==(const CounterexampleRecord&) const = default;
};

// The noise that breaks a plan, compared with the guaranteed noise: a row of table `conservatism`.
struct ConservatismRecord {
  std::string variable;  // "all" stands for all variables together
  double guaranteed = 0;
  std::optional<double> broken = {}, ratio = {};

  bool operator==(const ConservatismRecord&) const = default;
};

// The results of a falsification beside its trial: a row of table `falsification`, with the rows of
// the tables for worst claims, counterexamples and conservatism.
struct FalsificationRecord {
  std::int64_t attempts = 0;
  VerdictCounts certificates = {}, claims = {};
  // The records are in the order of their keys.
  std::vector<WorstClaimRecord> worst = {};
  std::vector<CounterexampleRecord> counterexamples = {};
  std::vector<ConservatismRecord> conservatism = {};

  bool operator==(const FalsificationRecord&) const = default;
};

// The speed of trials, without falsifications.
struct Throughput {
  int trials = 0;
  std::int64_t steps = 0;  // timesteps of the engine
  double seconds = 0;      // wall time from the start of the first trial to the end of the last

  double StepsPerSecond() const { return seconds > 0 ? static_cast<double>(steps) / seconds : 0; }
};

// A start of the program on a database: a row of table `run`. It differs between machines.
struct RunRecord {
  std::string started;  // time in UTC
  std::string shard;    // like "1/1"
  int jobs = 1;
  std::string version, machine;
  int cores = 0;
  std::string os;
  Throughput throughput = {};  // empty until the run ends
};

}  // namespace assay::sweep
