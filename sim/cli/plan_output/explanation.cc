#include "sim/cli/plan_output/explanation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <string_view>
#include <vector>

#include "planner/assembly/travel/unproved_ways.h"
#include "planner/plan/certificates/condition_table.h"
#include "planner/verify/proof.h"
#include "sim/cli/options/quantity.h"
#include "sim/cli/plan_output/certificate_text.h"
#include "sim/cli/plan_output/plan_text.h"
#include "sim/cli/plan_output/table.h"

namespace assay::cli {
namespace {

using plan::CertifiedPrecondition;
using plan::PlannedStep;
using plan::Relation;
using verify::CertificateProofs;
using verify::NarrowedVariable;
using verify::Proof;
using verify::VariableInProof;

constexpr std::size_t kLineWidth = 100;
constexpr std::string_view kIndent = "    ";
constexpr std::size_t kShownLines = 3;      // lines of an expression that are printed
constexpr double kShownShare = 0.001;       // smaller shares of the largest cost are left out
constexpr std::size_t kShownVariables = 8;  // the variables that cost most

// Preconditions that state the same condition for different points and planes. The tightest comes
// first.
struct ClaimKind {
  plan::Condition condition;
  std::string meaning;
  std::vector<const CertifiedPrecondition*> claims;

  double tightest() const { return claims.front()->margin; }
  std::size_t unproved() const {
    return std::ranges::count_if(claims, [](const auto* claim) { return !claim->holds(); });
  }
};

// Returns the kinds, with the tightest first.
std::vector<ClaimKind> KindsOf(const std::vector<CertifiedPrecondition>& preconditions) {
  std::vector<ClaimKind> kinds;
  for (const CertifiedPrecondition& claim : preconditions) {
    auto kind = std::ranges::find_if(kinds, [&](const ClaimKind& known) {
      return known.condition == claim.condition && known.meaning == claim.meaning;
    });
    if (kind == kinds.end()) {
      kind = kinds.insert(kinds.end(), {claim.condition, claim.meaning, {}});
    }
    kind->claims.push_back(&claim);
  }
  for (ClaimKind& kind : kinds) {
    std::ranges::stable_sort(kind.claims, {}, [](const auto* claim) { return claim->margin; });
  }
  std::ranges::stable_sort(kinds, {}, &ClaimKind::tightest);
  return kinds;
}

Unit UnitOf(const CertifiedPrecondition& claim) { return ShownUnitOf(claim.condition->dimension); }

// Returns whether the bound is infinite, or is the number that stands for a load that nothing
// bears.
bool IsUnbounded(const CertifiedPrecondition& claim) {
  return !std::isfinite(claim.bound) || claim.IsUnborne();
}

// Returns the bound: "INF -23.01 mm".
std::string BoundText(const CertifiedPrecondition& claim) {
  return fmt::format("{} {}", claim.relation == Relation::kLess ? "SUP" : "INF",
                     IsUnbounded(claim) ? "infinite" : QuantityText(claim.bound, UnitOf(claim)));
}

// Returns the limit: "> -19.55 mm".
std::string LimitText(const CertifiedPrecondition& claim) {
  return fmt::format("{} {}", claim.relation == Relation::kLess ? '<' : '>',
                     QuantityText(claim.limit, UnitOf(claim)));
}

std::string MarginText(const CertifiedPrecondition& claim) {
  return IsUnbounded(claim) ? "none" : QuantityText(claim.margin, UnitOf(claim));
}

std::string GapText(const CertifiedPrecondition& claim) {
  return std::isfinite(claim.gap) ? QuantityText(claim.gap, UnitOf(claim)) : "unknown";
}

// Returns the text with its decimal numbers in four digits.
std::string WithShortNumbers(const std::string& text) {
  std::string result;
  for (std::size_t i = 0; i < text.size();) {
    const bool in_name =
        i > 0 && (std::isalnum(static_cast<unsigned char>(text[i - 1])) != 0 || text[i - 1] == '_');
    if (in_name || std::isdigit(static_cast<unsigned char>(text[i])) == 0) {
      result += text[i++];
      continue;
    }
    char* end = nullptr;
    const double number = std::strtod(text.c_str() + i, &end);
    result += fmt::format("{:.4g}", number);
    i = static_cast<std::size_t>(end - text.c_str());
  }
  return result;
}

std::string Cut(const std::string& text) {
  constexpr std::size_t kWidth = kLineWidth - kIndent.size();
  return text.size() <= kWidth ? text : text.substr(0, kWidth - 3) + "...";
}

std::string OneLine(const std::string& expression) { return Cut(WithShortNumbers(expression)); }

// Returns the term with a sign before it: "+ 2*x", "- y".
std::string SignedTerm(const std::string& term) {
  const std::string text = WithShortNumbers(term);
  return text.starts_with('-') ? "- " + text.substr(1) : "+ " + text;
}

// Returns the terms as a sum in indented lines. Terms that do not fit are counted.
std::string FoldedSum(const std::vector<std::string>& terms) {
  std::string text;
  std::string line = OneLine(terms.front());
  std::size_t shown = 1;
  for (std::size_t lines = 1; shown < terms.size(); ++shown) {
    const std::string term = Cut(SignedTerm(terms[shown]));
    if (kIndent.size() + line.size() + 1 + term.size() <= kLineWidth) {
      line += " " + term;
      continue;
    }
    if (lines++ == kShownLines) break;
    text += fmt::format("{}{}\n", kIndent, line);
    line = term;
  }
  text += fmt::format("{}{}\n", kIndent, line);
  if (shown == terms.size()) return text;
  return text +
         fmt::format("{}... and {} more terms that vary less\n", kIndent, terms.size() - shown);
}

// Returns how many of the variables cost enough to be shown.
std::size_t CountShown(const std::vector<VariableInProof>& variables) {
  std::size_t shown = 0;
  while (shown < std::min(variables.size(), kShownVariables) &&
         variables[shown].cost >= kShownShare * variables.front().cost) {
    ++shown;
  }
  return shown;
}

std::string VariablesText(const Proof& proof) {
  if (proof.variables.empty()) return "";
  const Unit unit = UnitOf(proof.claim);
  Table table({{"    variable"},
               {"range", Align::kRight},
               {"worst corner", Align::kRight},
               {"costs", Align::kRight}});
  const std::size_t shown = CountShown(proof.variables);
  for (std::size_t i = 0; i < shown; ++i) {
    const VariableInProof& variable = proof.variables[i];
    const Unit own = ShownUnitOf(variable.dimension);
    table.Add({fmt::format("{}{}", kIndent, variable.name),
               fmt::format("{} {}", RangeText(variable.range, own), own.name),
               variable.worst ? QuantityText(*variable.worst, own) : "",
               QuantityText(variable.cost, unit)});
  }
  if (shown == proof.variables.size()) return table.Text();
  const double next = proof.variables[shown].cost;
  return table.Text() + fmt::format("{}{} more variables cost at most {} each\n", kIndent,
                                    proof.variables.size() - shown, QuantityText(next, unit));
}

std::string Verdict(const Proof& proof) {
  if (proof.claim.holds()) {
    return fmt::format("proved with {} to spare", MarginText(proof.claim));
  }
  if (proof.claim.IsUnborne()) return "at worst, nothing bears the load";
  if (IsUnbounded(proof.claim)) return "no finite bound is known";
  const std::string short_by = QuantityText(-proof.claim.margin, UnitOf(proof.claim));
  return proof.IsRefuted()
             ? fmt::format("{} short of a proof; at the worst corner it is false", short_by)
             : fmt::format("{} short of a proof; no corner is known at which it is false",
                           short_by);
}

std::string RemedyText(const Proof& proof) {
  if (proof.claim.holds()) return "";
  if (!proof.remedy) return "  No smaller range of a single variable is enough for a proof.\n";
  const NarrowedVariable& remedy = *proof.remedy;
  const Unit unit = ShownUnitOf(remedy.dimension);
  return fmt::format("  A smaller range of {} is enough for a proof: {} instead of {} {}.\n",
                     remedy.name, NarrowRangeText(remedy.enough, unit),
                     RangeText(remedy.range, unit), unit.name);
}

// Returns the values of the expression: "0 mm if all is as believed, 7 mm at the worst corner".
std::string ValuesText(const Proof& proof) {
  if (proof.is_number) return "one number for all errors together";
  const Unit unit = UnitOf(proof.claim);
  const std::string text = QuantityText(proof.nominal, unit) + " if all is as believed";
  if (!proof.at_worst) return text;
  return fmt::format("{}, {} at the worst corner", text, QuantityText(*proof.at_worst, unit));
}

// Returns the whole proof of one precondition.
std::string ChainText(const Proof& proof) {
  const CertifiedPrecondition& claim = proof.claim;
  const std::string text = fmt::format("  {}, must be {}: {}\n  {}; rung {}, gap {}\n",
                                       BoundText(claim), LimitText(claim), Verdict(proof),
                                       ValuesText(proof), claim.method, GapText(claim));
  if (proof.is_number) return text;
  return text + FoldedSum(proof.terms) + VariablesText(proof) + RemedyText(proof);
}

// Returns a table of the claims. Claims with the same text are counted in one line, with the
// largest of their gaps.
std::string ClaimsTable(const std::vector<const CertifiedPrecondition*>& claims) {
  struct Line {
    const CertifiedPrecondition* widest;
    std::vector<std::string> cells;
    int count = 0;
  };
  std::vector<Line> lines;
  for (const CertifiedPrecondition* claim : claims) {
    std::vector<std::string> cells = {BoundText(*claim), LimitText(*claim), MarginText(*claim),
                                      claim->method};
    auto line = std::ranges::find(lines, cells, &Line::cells);
    if (line == lines.end()) line = lines.insert(line, {claim, std::move(cells)});
    if (claim->gap > line->widest->gap) line->widest = claim;
    ++line->count;
  }
  Table table({{"    cases", Align::kRight},
               {"bound", Align::kRight},
               {"must be", Align::kRight},
               {"margin", Align::kRight},
               {"rung"},
               {"gap", Align::kRight}});
  for (Line& line : lines) {
    std::vector<std::string> row = {std::to_string(line.count)};
    std::ranges::move(line.cells, std::back_inserter(row));
    row.push_back(GapText(*line.widest));
    table.Add(std::move(row));
  }
  return table.Text();
}

std::string StandingText(std::size_t unproved, std::size_t all, bool absorbed) {
  std::string cases;
  if (all > 1) {
    cases = unproved == 0 || unproved == all ? fmt::format(" in all {} cases", all)
                                             : fmt::format(" in {} of {} cases", unproved, all);
  }
  if (unproved == 0) return "proved" + cases;
  if (absorbed) return fmt::format("not proved{}, and absorbed by fine motion", cases);
  return "NOT PROVED" + cases;
}

// Returns the text of a kind. With `in_full`, its tightest claim is explained in full.
std::string KindText(const ClaimKind& kind, const CertificateProofs& proofs, bool absorbed,
                     bool in_full) {
  const std::size_t unproved = kind.unproved();
  const std::size_t all = kind.claims.size();
  std::string text = fmt::format("\n{}: {}: {}\n", kind.condition.name(), kind.meaning,
                                 StandingText(unproved, all, absorbed));
  if (!in_full) {
    if (!proofs.IsNumber(*kind.claims.front())) {
      text += fmt::format("{}{}\n", kIndent, OneLine(proofs.ExpressionText(*kind.claims.front())));
    }
    return text + ClaimsTable(kind.claims);
  }
  text += ChainText(proofs.Of(*kind.claims.front()));
  if (all == 1) return text;
  return text + "  The other cases:\n" + ClaimsTable({kind.claims.begin() + 1, kind.claims.end()});
}

// Explains in full the kinds that are not proved. If all are proved, the tightest kind is explained
// in full.
std::string PreconditionsText(const PlannedStep& step, const std::string& file) {
  const std::vector<CertifiedPrecondition>& all = step.certificate.preconditions;
  if (all.empty()) return "\nThe step has no uncertainty-reduction preconditions.\n";
  const CertificateProofs proofs(step, file);
  const std::vector<ClaimKind> kinds = KindsOf(all);
  std::string text = fmt::format(
      "\nUncertainty-reduction preconditions: {}, the tightest first.\n"
      "Expressions are in metres and radians; the terms that vary most come first.\n",
      CertificateText(step));
  bool is_tightest = true;  // of the claims that are not absorbed
  for (const ClaimKind& kind : kinds) {
    const bool absorbed = plan::Absorbs(step.strategy, kind.condition);
    text += KindText(kind, proofs, absorbed, !absorbed && (kind.unproved() > 0 || is_tightest));
    is_tightest &= absorbed;
  }
  for (const auto& [condition, reason] : step.certificate.not_needed) {
    if (condition->needed_by == plan::NeededBy::kWay) continue;
    text += fmt::format("\n{}: not needed: {}\n", condition.name(), reason);
  }
  for (const plan::NotNeeded& kind : step.certificate.not_needed) {
    if (kind.condition->needed_by != plan::NeededBy::kWay) continue;
    text += fmt::format("\n{}: NOT PROVED\n", kind.condition.name());
  }
  return text;
}

void AddErrorSets(const char* when, const std::vector<plan::ErrorSet>& sets,
                  const domain::Problem& problem, Table& table) {
  for (const plan::ErrorSet& set : sets) {
    std::vector<std::string> row = {when, problem.part(set.part).name,
                                    set.in_hand ? "in the hand" : "resting"};
    for (const plan::ErrorComponent& component : plan::ErrorComponents()) {
      row.push_back(RangeText(set.*component.range, ShownUnitOf(component.dimension)));
    }
    table.Add(std::move(row));
  }
}

std::string ErrorSetsText(const domain::Problem& problem, const plan::Certificate& certificate) {
  std::vector<Table::Column> columns = {{""}, {"part"}, {""}};
  for (const plan::ErrorComponent& component : plan::ErrorComponents()) {
    columns.push_back({fmt::format("{} {}", component.name, ShownUnitOf(component.dimension).name),
                       Align::kRight});
  }
  Table table(std::move(columns));
  AddErrorSets("before", certificate.before, problem, table);
  AddErrorSets("after", certificate.after, problem, table);
  return "\nRanges of the true pose of each part about its believed pose\n" + table.Text();
}

std::string InsertedText(const plan::Plan& plan, plan::StepId id) {
  const std::string text = ResolutionsText(plan, id);
  return text.empty() ? text : "\nWhat the plan does about errors: " + text;
}

// Returns the steps for which this one was inserted.
std::string PurposeText(const plan::Plan& plan, plan::StepId id) {
  std::vector<plan::StepId> served;
  for (std::size_t s = 0; s < plan.steps.size(); ++s) {
    for (const plan::Resolution& resolution : plan.steps[s].certificate.resolutions) {
      if (std::ranges::count(resolution.steps, id) > 0) served.emplace_back(s);
    }
  }
  return served.empty() ? "" : fmt::format("inserted for {}\n", StepsText(plan, served));
}

}  // namespace

std::string Explanation(const domain::Problem& problem, const plan::Plan& plan, plan::StepId id,
                        const std::string& file) {
  const PlannedStep& step = plan.step(id);
  std::string text = fmt::format("step {} of {}, {}: {}\n{}", step.executed, plan.steps.size(),
                                 step.name, FullText(problem, step.action), PurposeText(plan, id));
  if (step.certificate.before.empty()) {
    return text + "The step has no certificate: the plan was made without regard to uncertainty.\n";
  }
  return text + ErrorSetsText(problem, step.certificate) + InsertedText(plan, id) +
         PreconditionsText(step, file);
}

std::string UnprovedWaysText(const domain::Problem& problem, const plan::Plan& plan,
                             plan::StepId id) {
  const bool is_last = plan.ExecutionOrder().back() == id;
  std::string text;
  for (const assembly::UnprovedWay& way : assembly::UnprovedWays(problem, plan)) {
    if (way.step != id && !(way.step.IsNone() && is_last)) continue;
    text += fmt::format("  With errors{}, {}.\n", way.step.IsNone() ? " on the way home" : "",
                        way.why.text);
    if (way.share) {
      text +=
          fmt::format("  It would be proved if the tool's pose had only {:.0f} % of its errors.\n",
                      100 * *way.share);
    }
  }
  return text;
}

}  // namespace assay::cli
