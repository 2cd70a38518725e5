#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sim/check/claims/claim.h"
#include "sim/check/claims/noise_floor.h"

namespace assay::sweep {

using check::VerdictCounts;

// Rows of the database. Apart from the seconds, they depend on nothing but the sweep file, the
// files that it names and the program's version.

// What was planned for a cell: one row of table `cell`, and of `gate` for each
// step, with one of `gate_component` for each component.
struct CellRecord {
  int cell = 0;
  std::string scenario;  // its path, as in the sweep file
  double clearance = 0;  // metres, what it really is
  double error_scale = 1;
  std::string propagation;
  std::string resolvers;  // "sensing,squeezing", what they really are
  std::string noise, sensing;
  std::int64_t seed = 0;
  int trials = 0;
  std::string grasp;
  // "planned", "untestable" (check::Noiseless does not hold), "none" or "budget"; there are trials
  // if planned.
  std::string outcome;
  int actions = 0;
  int errors = 0;  // steps not all of whose preconditions are proved
  bool proved = false;
  // Constraints that cannot hold together, limits, or what is wrong without noise; one a line.
  std::string conflict;
  std::string plan;  // plan.json on one line
  check::NoiseFloor gate = {};
};

// What a certificate says, in all trials of a cell alike: a row of table `claim`.
struct ClaimRecord {
  std::string claim;   // its name in the cell: "2/after/x of peg"
  int step = 0;        // place in the order of execution, from 1
  std::string action;  // the step's name: "action_3"
  std::string about;   // "before", "precondition", "after"
  std::string name, unit;
  double low = 0;
  double high = 0;
  bool proved = true;
  double gate = 0;  // in the same unit

  bool operator==(const ClaimRecord&) const = default;
};

// How a step's certificate came out in a trial: a row of table `verdict`.
struct VerdictRecord {
  int step = 0;
  std::string action;
  std::string verdict;
  std::string claim;  // the name of the worst claim
  double observed = 0, low = 0, high = 0, margin = 0, gate = 0;

  bool operator==(const VerdictRecord&) const = default;
};

// What was observed of a claim: a row of table `observation`.
struct ObservationRecord {
  std::string claim;
  double observed = 0;

  bool operator==(const ObservationRecord&) const = default;
};

// One trial: a row of table `trial`, with its verdicts and observations. A whole attack is one,
// too: its noise is that of the worst claim, its counts are of the certificates of all attempts,
// its verdicts the worst claims of each step; what was simulated is not counted, and 0.
struct TrialRecord {
  int trial = 0;  // in the sweep, from 1
  int cell = 0;
  int number = 0;          // in the cell, from 1
  std::string noise;       // noise::Text
  std::string outcome;     // check::Name; of an attack "succeeded" or "violated"
  std::string reason;      // empty if succeeded; of an attack: the worst claim
  double simulated = 0;    // seconds
  std::int64_t steps = 0;  // of the engine
  int errors_signalled = 0;
  int recovered = 0;
  bool operator_called = false;
  std::string warnings;  // of the engine
  VerdictCounts counts = {};
  std::vector<VerdictRecord> verdicts = {};
  std::vector<ObservationRecord> observations = {};

  bool operator==(const TrialRecord&) const = default;
};

// A claim as it came out at its worst in an attack: a row of table `attack_worst`.
struct WorstClaimRecord {
  std::string claim;  // as in table `claim`
  int step = 0;
  std::string action, about, name, unit;
  double observed = 0, low = 0, high = 0, margin = 0, gate = 0;
  std::string verdict, phase;  // check::Name
  std::int64_t attempt = 0;    // from 1
  std::string noise;           // noise::Text

  bool operator==(const WorstClaimRecord&) const = default;
};

// A shrunk violation: a row of table `counterexample`.
struct CounterexampleRecord {
  int number = 0;  // in its cell, from 1
  std::string claim, action, name, unit;
  double observed = 0, low = 0, high = 0, margin = 0, gate = 0;
  std::string noise;
  int steps = 0;          // how far the plan must be executed
  bool replayed = false;  // also from the start of the plan
  double multiple = 1;    // of its errors, with which it is violated still
  // The command that runs it again: with `assay run`, or, where that has no words for the cell,
  // with `assay replay DB TRIAL`, which makes the whole attack again.
  std::string replay;

  bool operator==(const CounterexampleRecord&) const = default;
};

// How much more noise than guaranteed it takes to break a plan: a row of table `conservatism`.
struct ConservatismRecord {
  std::string variable;  // "all": of all together
  double guaranteed = 0;
  std::optional<double> broken = {}, ratio = {};

  bool operator==(const ConservatismRecord&) const = default;
};

// What an attack came to, apart from its trial: a row of table `attack`, with those of the others.
struct AttackRecord {
  std::int64_t attempts = 0;
  VerdictCounts certificates = {}, claims = {};
  // In the order of their keys.
  std::vector<WorstClaimRecord> worst = {};
  std::vector<CounterexampleRecord> counterexamples = {};
  std::vector<ConservatismRecord> conservatism = {};

  bool operator==(const AttackRecord&) const = default;
};

}  // namespace assay::sweep
