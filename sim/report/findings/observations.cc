#include "sim/report/findings/observations.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "sim/sweep/database/schema.h"

namespace assay::report {
namespace {

using sweep::ClaimRecord;
using sweep::Statement;
using sweep::VerdictRecord;

// Returns the verdict on one observation of a claim. The database has one verdict for each step and
// trial, that of the step's worst claim. The verdict on another claim of the step follows from it:
// - If nothing was claimed of the step, the claim was not claimed.
// - If the observation alone would give a worse verdict than the step's, the claim was not claimed.
//   Otherwise the step's verdict would be as bad.
// - All other observations are judged by the claim's prediction and gate. If the step's
//   certificate is violated, a claim that was not claimed also counts as violated if the
//   observation is outside the prediction.
ClaimVerdict VerdictOn(const ClaimRecord& claim, double observed, ClaimVerdict of_step) {
  if (of_step == ClaimVerdict::kNotClaimed || !claim.proved) return ClaimVerdict::kNotClaimed;
  check::Claim observation;
  observation.predicted = {claim.low, claim.high};
  observation.observed = observed;
  observation.gate = claim.gate;
  const ClaimVerdict verdict = check::Judged(observation).verdict;
  return Rank(verdict) < Rank(of_step) ? ClaimVerdict::kNotClaimed : verdict;
}

// Returns a quantile of sorted values by linear interpolation.
double Quantile(const std::vector<double>& values, double share) {
  const double place = share * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, values.size() - 1);
  const double rest = place - static_cast<double>(below);
  return values[below] + rest * (values[above] - values[below]);
}

void Summarize(std::vector<double> values, Observed& observed) {
  if (values.empty()) return;
  std::ranges::sort(values);
  observed.least = values.front();
  observed.lower_quartile = Quantile(values, 0.25);
  observed.median = Quantile(values, 0.5);
  observed.upper_quartile = Quantile(values, 0.75);
  observed.greatest = values.back();
}

// Returns the claim of the verdict; null if there is none. The prediction must agree, too, because
// an input and an output may have the same name.
const ClaimRecord* FindClaim(const std::vector<ClaimRecord>& claims, const VerdictRecord& verdict) {
  const auto found = std::ranges::find_if(claims, [&](const ClaimRecord& claim) {
    return claim.step == verdict.step && claim.name == verdict.claim && claim.low == verdict.low &&
           claim.high == verdict.high;
  });
  return found == claims.end() ? nullptr : &*found;
}

bool IsWorse(const WorstVerdict& a, const WorstVerdict& b) {
  const auto key = [](const WorstVerdict& worst) {
    return std::tuple(Rank(VerdictNamed(worst.verdict.verdict)),
                      check::AsLength(worst.verdict.margin, worst.dimension), worst.trial);
  };
  return key(a) < key(b);
}

// Collects the findings of one cell from the rows of the database.
class StepReader {
 public:
  StepReader(const sweep::Store& store, int cell)
      : database_(store.database()), cell_(cell), claims_(store.Claims(cell)) {}

  std::vector<StepFindings> Read() {
    ReadVerdicts();
    for (const ClaimRecord& claim : claims_) {
      Step(claim.step, claim.action).claims.push_back({claim, ReadObserved(claim)});
    }
    std::vector<StepFindings> steps;
    for (auto& [number, step] : steps_) steps.push_back(std::move(step));
    return steps;
  }

 private:
  StepFindings& Step(int number, const std::string& action) {
    StepFindings& step = steps_[number];
    step.step = number;
    if (step.action.empty()) step.action = action;
    return step;
  }

  void ReadVerdicts() {
    Statement rows = database_.Prepare(
        "SELECT t.trial, v.step, v.action, v.verdict, v.claim, v.observed, v.low, v.high, "
        "v.margin, v.gate FROM trial t JOIN verdict v ON v.trial = t.trial WHERE t.cell = ? ORDER "
        "BY t.trial, v.step");
    rows.Bind(cell_);
    while (rows.Next()) Take(ReadVerdict(rows));
  }

  WorstVerdict ReadVerdict(const Statement& row) const {
    WorstVerdict worst{.verdict = {.step = row.Int(1),
                                   .action = row.Text(2),
                                   .verdict = row.Text(3),
                                   .claim = row.Text(4),
                                   .observed = row.Real(5),
                                   .low = row.Real(6),
                                   .high = row.Real(7),
                                   .margin = row.Real(8),
                                   .gate = row.Real(9)},
                       .about = "",
                       .trial = row.Int(0)};
    if (const ClaimRecord* const claim = FindClaim(claims_, worst.verdict)) {
      worst.about = claim->about;
      worst.dimension = claim->dimension;
    }
    return worst;
  }

  void Take(WorstVerdict verdict) {
    StepFindings& step = Step(verdict.verdict.step, verdict.verdict.action);
    step.counts.Add(StandingOf(verdict.verdict));
    if (step.worst.trial == 0 || IsWorse(verdict, step.worst)) step.worst = std::move(verdict);
  }

  Observed ReadObserved(const ClaimRecord& claim) const {
    Statement rows = database_.Prepare(
        "SELECT o.observed, coalesce(v.verdict, '') FROM trial t JOIN observation o ON o.trial = "
        "t.trial AND o.claim = ? LEFT JOIN verdict v ON v.trial = t.trial AND v.step = ? WHERE "
        "t.cell = ?");
    rows.Bind(claim.claim, claim.step, cell_);
    Observed observed;
    std::vector<double> values;
    while (rows.Next()) {
      const ClaimVerdict verdict = VerdictOn(claim, rows.Real(0), VerdictNamed(rows.Text(1)));
      // The standing follows from the claim's own gate, so that an inconclusive verdict means
      // within the engine's resolution.
      const double margin = std::min(rows.Real(0) - claim.low, claim.high - rows.Real(0));
      observed.verdicts.Add(StandingOf({check::Name(verdict), margin, claim.gate}));
      if (verdict != ClaimVerdict::kNotClaimed) values.push_back(rows.Real(0));
    }
    Summarize(std::move(values), observed);
    return observed;
  }

  const sweep::Database& database_;
  const int cell_;
  const std::vector<ClaimRecord> claims_;
  std::map<int, StepFindings> steps_;
};

// The merit of a trial. Greater keys are better.
struct Merit {
  bool succeeded = false;
  int rank = 3;  // rank of its worst verdict
  double margin = std::numeric_limits<double>::infinity();
  int trial = 0;

  auto Key() const { return std::tuple(succeeded, rank, margin, -trial); }
};

// Returns the merit of each trial. `condition` is an SQL condition on the cell.
std::vector<Merit> Merits(const sweep::Store& store, const std::string& condition) {
  Statement rows = store.database().Prepare(
      "SELECT t.trial, t.outcome = 'succeeded', coalesce(v.verdict, ''), v.margin, (SELECT unit "
      "FROM claim c WHERE c.cell = t.cell AND c.step = v.step AND c.name = v.claim  LIMIT 1) FROM "
      "trial t LEFT JOIN verdict v ON v.trial = t.trial JOIN cell USING(cell) WHERE " +
      condition + " ORDER BY t.trial");
  std::vector<Merit> merits;
  while (rows.Next()) {
    if (merits.empty() || merits.back().trial != rows.Int(0)) {
      merits.push_back({.succeeded = rows.Int(1) != 0, .trial = rows.Int(0)});
    }
    Merit& merit = merits.back();
    const ClaimVerdict verdict = VerdictNamed(rows.Text(2));
    if (verdict == ClaimVerdict::kNotClaimed) continue;
    merit.rank = std::min(merit.rank, Rank(verdict));
    merit.margin =
        std::min(merit.margin, check::AsLength(rows.Real(3), sweep::DimensionNamed(rows.Text(4))));
  }
  return merits;
}

}  // namespace

std::vector<StepFindings> ReadSteps(const sweep::Store& store, int cell) {
  return StepReader(store, cell).Read();
}

NotableTrials FindNotable(const sweep::Store& store) {
  std::vector<Merit> merits = Merits(store, "cell.noise NOT IN ('none', 'attack')");
  if (merits.empty()) merits = Merits(store, "cell.noise = 'none'");
  if (merits.empty()) return {};
  std::ranges::sort(merits, std::greater(), &Merit::Key);
  return {.best = merits.front().trial,
          .typical = merits[merits.size() / 2].trial,
          .worst = merits.back().trial};
}

}  // namespace assay::report
