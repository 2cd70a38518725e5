#include "sim/sweep/database/recording.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace assay::sweep {
namespace {

// Returns the name of a claim, like "2/after/x of peg". It is unique within a falsification.
std::string ClaimName(const plan::Plan& plan, const check::Claim& claim) {
  return fmt::format("{}/{}/{}", plan.step(claim.step).executed, check::Name(claim.about),
                     claim.name);
}

// Returns the names of the claims of a trial, in their order. A repeated name gets a number.
std::vector<std::string> ClaimNames(const plan::Plan& plan,
                                    const std::vector<check::Claim>& claims) {
  std::map<std::string, int> seen;
  std::vector<std::string> names;
  for (const check::Claim& claim : claims) {
    std::string name = ClaimName(plan, claim);
    const int count = ++seen[name];
    names.push_back(count == 1 ? std::move(name) : fmt::format("{} #{}", name, count));
  }
  return names;
}

domain::Dimension DimensionOf(const check::Claim& claim) {
  return claim.dimension.value_or(domain::Dimension::kRatio);
}

ClaimRecord RecordOf(const plan::PlannedStep& step, const check::Claim& claim, std::string name) {
  return {.claim = std::move(name),
          .step = step.executed,
          .action = step.name,
          .about = std::string(check::Name(claim.about)),
          .name = claim.name,
          .dimension = DimensionOf(claim),
          .low = claim.predicted.low,
          .high = claim.predicted.high,
          .proved = claim.proved,
          .gate = claim.gate};
}

VerdictRecord RecordOf(const plan::PlannedStep& step, const check::CertificateVerdict& verdict) {
  const check::Claim& worst = verdict.worst;
  return {.step = step.executed,
          .action = step.name,
          .verdict = std::string(check::Name(verdict.verdict)),
          .claim = worst.name,
          .observed = worst.observed,
          .low = worst.predicted.low,
          .high = worst.predicted.high,
          .margin = worst.margin,
          .gate = worst.gate};
}

// Adds the verdicts in the order of execution, which is their order in a database.
void AddVerdicts(const plan::Plan& plan, const std::vector<check::Claim>& claims,
                 TimedTrial& timed) {
  const auto place = [&](const check::CertificateVerdict& verdict) {
    return plan.step(verdict.step).executed;
  };
  timed.verdicts = check::ByStep(claims);
  std::ranges::sort(timed.verdicts, {}, place);
  for (const check::CertificateVerdict& verdict : timed.verdicts) {
    timed.record.verdicts.push_back(RecordOf(plan.step(verdict.step), verdict));
  }
}

WorstClaimRecord RecordOf(const plan::Plan& plan, const check::WorstClaim& worst) {
  const check::Claim& claim = worst.claim;
  const plan::PlannedStep& step = plan.step(claim.step);
  return {.claim = ClaimName(plan, claim),
          .step = step.executed,
          .action = step.name,
          .about = std::string(check::Name(claim.about)),
          .name = claim.name,
          .dimension = DimensionOf(claim),
          .observed = claim.observed,
          .low = claim.predicted.low,
          .high = claim.predicted.high,
          .margin = claim.margin,
          .gate = claim.gate,
          .verdict = std::string(check::Name(claim.verdict)),
          .phase = std::string(check::Name(worst.phase)),
          .attempt = worst.attempt,
          .noise = noise::Text(worst.noise)};
}

CounterexampleRecord RecordOf(const plan::Plan& plan, const check::Counterexample& example,
                              const MadeFalsification& made) {
  const check::Claim& claim = example.claim;
  const std::string noise = noise::Text(example.noise);
  return {.claim = ClaimName(plan, claim),
          .action = plan.step(claim.step).name,
          .name = claim.name,
          .dimension = DimensionOf(claim),
          .observed = claim.observed,
          .low = claim.predicted.low,
          .high = claim.predicted.high,
          .margin = claim.margin,
          .gate = claim.gate,
          .noise = noise,
          .steps = example.steps,
          .replayed = example.replayed,
          .multiple = example.multiple,
          .replay =
              made.run_command ? made.run_command->WithErrors(noise).Text() : made.replay_command};
}

FalsificationRecord RecordOf(const plan::Plan& plan, const MadeFalsification& made) {
  const check::FalsificationResult& result = made.result;
  VerdictCounts certificates;
  for (const VerdictCounts& counts : result.certificates) certificates += counts;
  FalsificationRecord record{
      .attempts = result.attempts, .certificates = certificates, .claims = result.claims};
  for (const check::WorstClaim& worst : result.worst) record.worst.push_back(RecordOf(plan, worst));
  for (const check::Counterexample& example : result.counterexamples) {
    record.counterexamples.push_back(RecordOf(plan, example, made));
    record.counterexamples.back().number = static_cast<int>(record.counterexamples.size());
  }
  for (const check::ConservatismRatio& ratio : made.ratios) {
    record.conservatism.push_back({ratio.variable, ratio.guaranteed, ratio.broken, ratio.ratio()});
  }
  // A database returns the records in this order.
  std::ranges::sort(record.worst, {}, &WorstClaimRecord::claim);
  std::ranges::sort(record.conservatism, {}, &ConservatismRecord::variable);
  return record;
}

// Returns the worst of all claims; null if nothing was claimed.
const check::WorstClaim* WorstOf(const check::FalsificationResult& result) {
  const auto worst = std::ranges::min_element(
      result.worst, [](const check::WorstClaim& a, const check::WorstClaim& b) {
        return IsWorse(a.claim, b.claim);
      });
  return worst == result.worst.end() ? nullptr : &*worst;
}

// Returns a claim in words: "step 2 (action_3): y of peg: observed 0.0012 m, predicted [-0.001,
// 0.001]". A statement without a number is violated: "step 2 (action_3): comes to its end: it does
// not".
std::string ClaimText(const plan::Plan& plan, const check::Claim& claim) {
  const plan::PlannedStep& step = plan.step(claim.step);
  if (!claim.dimension) {
    return fmt::format("step {} ({}): {}: it does not", step.executed, step.name, claim.name);
  }
  return fmt::format("step {} ({}): {}: observed {:.6g} {}, predicted [{:.6g}, {:.6g}]",
                     step.executed, step.name, claim.name, claim.observed, claim.UnitName(),
                     claim.predicted.low, claim.predicted.high);
}

}  // namespace

std::string WrongWithoutNoise(const plan::Plan& plan, const check::Noiseless& noiseless,
                              const check::NoiseFloor& gate) {
  std::vector<std::string> lines;
  for (const check::Claim& claim : noiseless.violated) {
    lines.push_back("violated without any noise: " + ClaimText(plan, claim));
  }
  for (const check::Claim& claim : noiseless.hidden) {
    lines.push_back(
        fmt::format("{}: the noise floor, {:.6g} {}, is wider than the certified set or the "
                    "clearance: the plan cannot be tested",
                    ClaimText(plan, claim), gate.Floor(claim), claim.UnitName()));
  }
  return fmt::format("{}", fmt::join(lines, "\n"));
}

TimedTrial Recorded(const plan::Plan& plan, const check::Trial& trial) {
  const execution::ExecutionEnd& end = trial.trace.end();
  const bool warned = end.outcome == execution::TrialOutcome::kEngineWarning;
  TimedTrial timed{.record = {.noise = noise::Text(trial.noise),
                              .outcome = std::string(execution::Name(trial.verdict.outcome)),
                              .reason = trial.verdict.reason,
                              .simulated = end.snapshot.time,
                              .steps = end.steps,
                              .errors_signalled = trial.errors_signalled,
                              .recovered = trial.recovered,
                              .operator_called = trial.operator_called,
                              .warnings = warned ? end.reason : std::string()}};
  const std::vector<std::string> names = ClaimNames(plan, trial.claims);
  for (std::size_t i = 0; i < names.size(); ++i) {
    const check::Claim& claim = trial.claims[i];
    timed.claims.push_back(RecordOf(plan.step(claim.step), claim, names[i]));
    timed.record.observations.push_back({names[i], claim.observed});
  }
  AddVerdicts(plan, trial.claims, timed);
  for (const check::CertificateVerdict& verdict : timed.verdicts) {
    timed.record.counts.Add(verdict.verdict);
  }
  // A database returns the observations in this order.
  std::ranges::sort(timed.record.observations, {}, &ObservationRecord::claim);
  return timed;
}

TimedTrial Recorded(const plan::Plan& plan, const MadeFalsification& made) {
  const check::FalsificationResult& result = made.result;
  TimedTrial timed;
  timed.falsification = RecordOf(plan, made);
  TrialRecord& record = timed.record;
  record.counts = timed.falsification->certificates;
  record.outcome = record.counts.violated > 0 ? "violated"
                   : result.attempts > 0      ? "succeeded"
                                              : "untried";
  if (record.outcome == "untried") record.reason = "no attempt was made";
  if (const check::WorstClaim* const worst = WorstOf(result)) {
    record.noise = noise::Text(worst->noise);
    if (record.counts.violated > 0) record.reason = ClaimText(plan, worst->claim);
  }
  std::vector<check::Claim> claims;
  for (const check::WorstClaim& worst : result.worst) claims.push_back(worst.claim);
  AddVerdicts(plan, claims, timed);
  for (const check::Claim& claim : claims) {
    timed.claims.push_back(RecordOf(plan.step(claim.step), claim, ClaimName(plan, claim)));
  }
  return timed;
}

}  // namespace assay::sweep
