#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "planner/algebra/bounds/bound_file.h"
#include "planner/algebra/bounds/sensitivity.h"
#include "planner/algebra/expression/text.h"
#include "planner/algebra/sup_inf/sup_inf.h"
#include "planner/base/input_files/document.h"
#include "planner/base/input_files/nearest_name.h"
#include "planner/plan/plan_files/json_layout.h"
#include "sim/cli/command_line/console.h"
#include "sim/cli/command_line/progress.h"
#include "sim/cli/command_line/stopwatch.h"
#include "sim/cli/command_line/usage_error.h"
#include "sim/cli/command_line/verb.h"
#include "sim/cli/options/quantity_option.h"
#include "sim/cli/plan_output/table.h"
#include "sim/cli/tasks/output_file.h"

namespace assay::cli {
namespace bound_verb {

using algebra::Bound;
using algebra::BoundingMethod;
using algebra::BoundProblem;
using algebra::BoundRequest;
using algebra::Expression;
using algebra::VariableId;
using Json = nlohmann::ordered_json;

constexpr std::size_t kShownText = 40;   // characters of an expression
constexpr std::size_t kShownShares = 3;  // variables with the greatest cost
constexpr int kShownDigits = 9;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Options {
  std::filesystem::path problem;
  std::filesystem::path output;
  std::string method = "refined";
  std::vector<std::string> keep;
  BoundRequest request;
  bool json = false;
};

// The bounds of one expression.
struct Answer {
  const BoundProblem::Question& question;
  Bound inf, sup;
  Bound termwise_inf, termwise_sup;
  std::optional<Expression> kept_inf, kept_sup;  // with --keep
  double seconds = 0;
};

// Returns whether no point satisfies the constraints, or the expression has no value at the points
// that satisfy them. Either of the two bounds may show this.
bool IsVacuous(const Answer& answer) {
  return answer.sup.value == -kInfinity || answer.inf.value == kInfinity;
}

double GapOf(const Answer& answer) { return std::max(answer.inf.gap, answer.sup.gap); }
BoundingMethod BoundingMethodOf(const Answer& answer) {
  return std::max(answer.inf.method, answer.sup.method);
}

std::set<VariableId> KeptVariables(const BoundProblem& problem, const Options& options) {
  std::vector<std::string> names;
  for (int v = 0; v < problem.pool->variable_count(); ++v) {
    names.push_back(problem.pool->name(VariableId(v)));
  }
  std::set<VariableId> kept;
  for (const std::string& name : options.keep) {
    const std::optional<VariableId> variable = problem.pool->Find(name);
    if (!variable) {
      const std::string nearest = NearestName(name, names);
      throw UsageError(fmt::format("--keep: there is no variable '{}'{}", name,
                                   nearest.empty() ? "" : "; did you mean '" + nearest + "'?"));
    }
    kept.insert(*variable);
  }
  return kept;
}

Answer AnswerTo(const BoundProblem::Question& question, const BoundProblem& problem,
                const std::set<VariableId>& keep, const BoundRequest& request) {
  const Stopwatch stopwatch;
  BoundRequest termwise = request;
  termwise.highest = BoundingMethod::kTermwise;
  const Expression& e = question.expression;
  algebra::PreparedExpression prepared(e);
  const algebra::BothBounds refined = prepared.Both(problem.constraints, request);
  const algebra::BothBounds by_terms = prepared.Both(problem.constraints, termwise);
  Answer answer{.question = question,
                .inf = refined.inf,
                .sup = refined.sup,
                .termwise_inf = by_terms.inf,
                .termwise_sup = by_terms.sup,
                .kept_inf = {},
                .kept_sup = {}};
  if (!keep.empty()) {
    answer.kept_inf = Inf(e, keep, problem.constraints);
    answer.kept_sup = Sup(e, keep, problem.constraints);
  }
  if (IsVacuous(answer)) {
    answer.inf.value = kInfinity;
    answer.sup.value = -kInfinity;
  }
  answer.seconds = stopwatch.Seconds();
  return answer;
}

// JSON has no infinite numbers. Adding 0 turns -0 into 0.
Json ToJson(double number) {
  if (std::isinf(number)) return number > 0 ? "inf" : "-inf";
  return number + 0.0;
}

std::string TextOf(const Expression& e) {
  if (e.IsConstant() && std::isinf(e.constant())) return e.constant() > 0 ? "inf" : "-inf";
  return algebra::Text(e);
}

Json ToJson(const Answer& answer) {
  Json json = {
      {"expression", answer.question.text},
      {"inf", ToJson(answer.inf.value)},
      {"sup", ToJson(answer.sup.value)},
      {"vacuous", IsVacuous(answer)},
      {"rung", Name(BoundingMethodOf(answer))},
      {"gap", ToJson(GapOf(answer))},
      {"evaluations", answer.inf.evaluations + answer.sup.evaluations},
      {"termwise",
       {{"inf", ToJson(answer.termwise_inf.value)}, {"sup", ToJson(answer.termwise_sup.value)}}},
  };
  if (answer.kept_inf && answer.kept_sup) {
    json["kept"] = {{"inf", TextOf(*answer.kept_inf)}, {"sup", TextOf(*answer.kept_sup)}};
  }
  json["seconds"] = answer.seconds;
  return json;
}

std::string JsonText(const std::vector<Answer>& answers) {
  Json list = Json::array();
  for (const Answer& answer : answers) list.push_back(ToJson(answer));
  return plan::JsonText(Json{{"expressions", list}});
}

double ParsedNumber(const std::string& text) {
  double number = 0;
  std::from_chars(text.data(), text.data() + text.size(), number);
  return number;
}

enum class Side { kInf, kSup };

// Returns the bound in few digits, rounded outward so that the text is a bound as well.
std::string OutwardText(double bound, Side side) {
  const auto few_digits = [](double x) { return fmt::format("{:.{}g}", x + 0.0, kShownDigits); };
  const std::string text = few_digits(bound);
  if (bound == 0 || !std::isfinite(bound)) return text;
  const double shown = ParsedNumber(text);
  if (side == Side::kInf ? shown <= bound : shown >= bound) return text;
  const double last_digit =
      std::pow(10, std::floor(std::log10(std::abs(bound))) - kShownDigits + 1);
  return few_digits(side == Side::kInf ? shown - last_digit : shown + last_digit);
}

std::string ShortText(const std::string& text) {
  return text.size() <= kShownText ? text : text.substr(0, kShownText - 3) + "...";
}

std::string SharesText(const std::string& what, const std::vector<algebra::Share>& shares,
                       const BoundProblem& problem) {
  if (shares.empty()) return "";
  std::vector<std::string> texts;
  for (const algebra::Share& share : shares) {
    if (texts.size() == kShownShares) break;
    texts.push_back(fmt::format("{} {:.3g}", problem.pool->name(share.variable), share.cost));
  }
  return fmt::format("  {} would improve most if these variables were known: {}\n", what,
                     fmt::join(texts, ", "));
}

// The cheap bounding methods compute how each bound would change with a variable at its midpoint.
std::string Explanation(const Answer& answer, const BoundProblem& problem) {
  const BoundRequest cheap = {.highest = BoundingMethod::kMonotone};
  const Expression& e = answer.question.expression;
  std::string text;
  if (IsVacuous(answer)) {
    text += "  no point satisfies the constraints, or the expression has no value\n";
  }
  if (std::isfinite(answer.inf.value)) {
    text += SharesText("inf", SharesOfInf(e, problem.constraints, cheap), problem);
  }
  if (std::isfinite(answer.sup.value)) {
    text += SharesText("sup", SharesOfSup(e, problem.constraints, cheap), problem);
  }
  if (answer.kept_inf && answer.kept_sup) {
    text += fmt::format("  inf >= {}\n  sup <= {}\n", TextOf(*answer.kept_inf),
                        TextOf(*answer.kept_sup));
  }
  return text.empty() ? text : fmt::format("\n{}\n{}", ShortText(answer.question.text), text);
}

std::string TableText(const std::vector<Answer>& answers, const BoundProblem& problem) {
  Table table({{"expression"},
               {"inf", Align::kRight},
               {"sup", Align::kRight},
               {"gap", Align::kRight},
               {"rung"},
               {"termwise inf", Align::kRight},
               {"termwise sup", Align::kRight}});
  std::string explanations;
  for (const Answer& answer : answers) {
    table.Add({ShortText(answer.question.text), OutwardText(answer.inf.value, Side::kInf),
               OutwardText(answer.sup.value, Side::kSup), fmt::format("{:.2g}", GapOf(answer)),
               std::string(Name(BoundingMethodOf(answer))),
               OutwardText(answer.termwise_inf.value, Side::kInf),
               OutwardText(answer.termwise_sup.value, Side::kSup)});
    explanations += Explanation(answer, problem);
  }
  return table.Text() + explanations;
}

// Returns whether a finite bound is not known to be as tight as requested. It would have needed
// more evaluations than allowed, or doubles resolve no better. An infinite bound is an answer,
// since no gap was promised for it.
bool IsLoose(const Bound& bound, const BoundRequest& request) {
  return request.highest == BoundingMethod::kBranchAndBound && std::isfinite(bound.value) &&
         bound.gap > request.gap;
}

void TellLoose(const Answer& answer, const BoundRequest& request) {
  for (const Bound* bound : {&answer.inf, &answer.sup}) {
    if (!IsLoose(*bound, request)) continue;
    PrintError(fmt::format("{} of {} is known to within {:.3g}, not {:.3g}: {}",
                           bound == &answer.inf ? "INF" : "SUP", ShortText(answer.question.text),
                           bound->gap, request.gap,
                           bound->evaluations >= request.evaluations
                               ? "more evaluations are needed (--evaluations)"
                               : "numbers of such magnitude have no finer rounding"));
  }
}

ExitCode Execute(const Options& options) {
  const BoundProblem problem = algebra::LoadBoundProblem(options.problem);
  RequireWritable(options.output);
  const std::set<VariableId> keep = KeptVariables(problem, options);
  BoundRequest request = options.request;
  if (options.method == "termwise") request.highest = BoundingMethod::kTermwise;
  std::vector<Answer> answers;
  std::string text;
  {
    const Progress progress("bounding " + options.problem.string());
    for (const BoundProblem::Question& question : problem.questions) {
      answers.push_back(AnswerTo(question, problem, keep, request));
    }
    text =
        options.json || !options.output.empty() ? JsonText(answers) : TableText(answers, problem);
  }
  if (options.output.empty()) {
    Print(text);
  } else {
    WriteFile(options.output, text);
  }
  for (const Answer& answer : answers) TellLoose(answer, request);
  const bool is_loose = std::ranges::any_of(answers, [&](const Answer& answer) {
    return IsLoose(answer.inf, request) || IsLoose(answer.sup, request);
  });
  return is_loose ? ExitCode::kBudgetSpent : ExitCode::kDone;
}

Execution Declare(CLI::App& command) {
  const auto options = std::make_shared<Options>();
  command.add_option("problem", options->problem, "variables and expressions, JSON or YAML")
      ->required();
  command
      .add_option("--rung", options->method,
                  "termwise: bound each term alone, as in the paper; refined: refine the bounds "
                  "until the gap is reached")
      ->check(CLI::IsMember({"termwise", "refined"}))
      ->capture_default_str();
  command
      .add_option("--gap", options->request.gap,
                  "wanted gap between a bound and the true extreme value")
      ->check(Within(domain::kAtLeastZero, domain::kRatio))
      ->capture_default_str();
  command
      .add_option("--evaluations", options->request.evaluations,
                  "limit of evaluations for each bound; if the gap needs more, the exit code is 11")
      ->check(CLI::Range(1, std::numeric_limits<int>::max()))
      ->capture_default_str();
  command
      .add_option("--keep", options->keep,
                  "also print bounds that are expressions in these variables, given as x,y")
      ->delimiter(',');
  command.add_flag("--json", options->json, "print JSON instead of a table");
  command.add_option("-o,--output", options->output, "write JSON to this file");
  return [options] { return Execute(*options); };
}

}  // namespace bound_verb

const Verb kBound = {
    .name = "bound",
    .summary = "bounds expressions over intervals and inequalities",
    .page = "planner/bounds-and-labels.md",
    .example =
        "assay bound clearance.yaml --gap 1e-9\n"
        "  where clearance.yaml is\n"
        "  variables: {x: [0, inf], y: [-1, 2], t: [-5.5 deg, 5.5 deg]}\n"
        "  constraints: [x <= y + 1]\n"
        "  expressions: [3*cos(t) + x, \"min(x, y)/4\"]",
    .declare = bound_verb::Declare,
};

}  // namespace assay::cli
