#include "planner/algebra/bound_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>

#include "planner/algebra/interval_arithmetic.h"
#include "planner/algebra/text.h"

namespace assay::algebra {
namespace {

constexpr const char* kEnds = "a number, \"N deg\", \"inf\" or \"-inf\"";
constexpr Interval kPi = {0x1.921fb54442d18p+1, 0x1.921fb54442d19p+1};  // holds pi
constexpr std::array<std::string_view, 7> kReserved = {"sin", "cos", "sqrt", "abs",
                                                       "min", "max", "deg"};

std::string_view Trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\n");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\n") - first + 1);
}

// None if it is not a finite number and nothing else.
std::optional<double> NumberIn(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool is_whole = error == std::errc() && end == text.data() + text.size();
  if (!is_whole || !std::isfinite(number)) return std::nullopt;
  return number;
}

// The interval in which the end lies: the number itself, except for degrees.
Interval ReadEnd(const Value& value) {
  const std::string whole = value.Text();
  const std::string_view text = Trimmed(whole);
  if (text == "inf" || text == "+inf") return {kInfinity, kInfinity};
  if (text == "-inf") return {-kInfinity, -kInfinity};
  if (text.ends_with("deg")) {
    const std::optional<double> degrees = NumberIn(Trimmed(text.substr(0, text.size() - 3)));
    if (degrees) return Interval{*degrees, *degrees} * kPi / Interval{180, 180};
  }
  const std::optional<double> number = NumberIn(text);
  if (!number) value.Fail(fmt::format("'{}' is not an end of an interval", whole), kEnds);
  return {*number, *number};
}

Interval ReadInterval(const Value& value) {
  const std::vector<Value> ends = value.Items();
  if (ends.size() != 2) {
    value.Fail(fmt::format("an interval with {} ends", ends.size()), "[low, high]");
  }
  const Interval interval = {ReadEnd(ends[0]).low, ReadEnd(ends[1]).high};
  if (interval.low > interval.high) {
    value.Fail(fmt::format("the interval goes down, from {} to {}", ends[0].Text(), ends[1].Text()),
               "[low, high] with low <= high");
  }
  if (interval.low == kInfinity || interval.high == -kInfinity) {
    value.Fail("the interval holds no number", "[low, high] with a number between them");
  }
  return interval;
}

bool IsLetter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }

bool IsName(std::string_view text) {
  const auto goes_on = [](char c) { return IsLetter(c) || (c >= '0' && c <= '9'); };
  return !text.empty() && IsLetter(text[0]) && std::ranges::all_of(text, goes_on);
}

void ReadVariable(const Value& name, const Value& interval, ExpressionPool& pool) {
  const std::string text = name.Text();
  if (!IsName(text)) {
    name.Fail(fmt::format("'{}' is not the name of a variable", text),
              "a letter or _, then letters, digits and _");
  }
  if (std::ranges::count(kReserved, text) > 0) {
    name.Fail(fmt::format("'{}' has a meaning of its own in expressions", text), "another name");
  }
  if (pool.Find(text)) name.Fail(fmt::format("variable '{}' is given twice", text));
  pool.Declare(text, ReadInterval(interval));
}

// A piece of the text that the value is, as an expression.
Expression ReadPiece(const Value& value, std::string_view text, std::size_t first,
                     std::size_t length, ExpressionPool& pool) {
  const std::string_view piece = text.substr(first, length);
  FilePlace place = value.Place();
  place.column += static_cast<int>(first);
  if (Trimmed(piece).empty()) {
    throw InputError(place, fmt::format("an expression is missing in '{}'", text),
                     "an expression, such as 3*cos(t) + x");
  }
  return Parse(piece, pool, place);
}

struct Comparison {
  std::size_t begin = 0;  // in the text
  std::size_t end = 0;
  char kind = '<';  // '<', '>' or '='
};

Comparison FindComparison(const Value& value, std::string_view text) {
  constexpr const char* kAllowed = "two expressions with one of <=, >=, <, >, == between them";
  constexpr std::string_view kSigns = "<>=";
  const auto fail = [&](std::string_view what) {
    value.Fail(fmt::format("'{}' {}", text, what), kAllowed);
  };
  const std::size_t begin = text.find_first_of(kSigns);
  if (begin == std::string_view::npos) fail("compares nothing");
  const std::size_t end = std::min(text.find_first_not_of(kSigns, begin), text.size());
  const std::string_view sign = text.substr(begin, end - begin);
  constexpr std::array<std::string_view, 5> kKnown = {"<=", ">=", "<", ">", "=="};
  if (std::ranges::count(kKnown, sign) == 0) fail(fmt::format("has the unknown sign {}", sign));
  if (text.find_first_of(kSigns, end) != std::string_view::npos) fail("compares more than once");
  return {.begin = begin, .end = end, .kind = sign[0]};
}

void ReadConstraint(const Value& value, BoundProblem& problem) {
  const std::string text = value.Text();
  const Comparison comparison = FindComparison(value, text);
  const Expression left = ReadPiece(value, text, 0, comparison.begin, *problem.pool);
  const Expression right = ReadPiece(value, text, comparison.end, std::string::npos, *problem.pool);
  std::vector<Inequality>& inequalities = problem.constraints.inequalities;
  if (comparison.kind != '>') inequalities.push_back({.lesser = left, .greater = right});
  if (comparison.kind != '<') inequalities.push_back({.lesser = right, .greater = left});
}

}  // namespace

BoundProblem ReadBoundProblem(const Document& document) {
  const Value& root = document.root();
  root.AllowOnly({"variables", "constraints", "expressions"});
  BoundProblem problem{
      .pool = std::make_unique<ExpressionPool>(), .constraints = {}, .questions = {}};
  for (const auto& [name, interval] : root.At("variables").Entries()) {
    ReadVariable(name, interval, *problem.pool);
  }
  problem.constraints = DeclaredBox(*problem.pool);
  if (const std::optional<Value> constraints = root.Find("constraints")) {
    for (const Value& constraint : constraints->Items()) ReadConstraint(constraint, problem);
  }
  for (const Value& expression : root.At("expressions").Items()) {
    const std::string text = expression.Text();
    problem.questions.push_back(
        {.text = text, .expression = ReadPiece(expression, text, 0, text.size(), *problem.pool)});
  }
  return problem;
}

BoundProblem LoadBoundProblem(const std::filesystem::path& file) {
  return ReadBoundProblem(Document::Load(file));
}

}  // namespace assay::algebra
