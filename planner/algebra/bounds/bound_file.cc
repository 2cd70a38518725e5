#include "planner/algebra/bounds/bound_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

#include "planner/algebra/expression/name.h"
#include "planner/algebra/expression/parse.h"
#include "planner/algebra/expression/text.h"
#include "planner/base/input_files/document.h"
#include "planner/base/input_files/input_file.h"
#include "planner/numeric/interval_arithmetic.h"

namespace assay::algebra {
namespace {

constexpr const char* kEnds = "a number, \"N deg\", \"inf\" or \"-inf\"";
constexpr Interval kPi = {0x1.921fb54442d18p+1, 0x1.921fb54442d19p+1};  // contains pi
constexpr std::array<std::string_view, 7> kReserved = {"sin", "cos", "sqrt", "abs",
                                                       "min", "max", "deg"};

std::string_view Trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\n");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\n") - first + 1);
}

// Returns a number only if the whole text is one finite number.
std::optional<double> NumberIn(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool is_whole = error == std::errc() && end == text.data() + text.size();
  if (!is_whole || !std::isfinite(number)) return std::nullopt;
  return number;
}

// Returns an interval that contains the end. It is the number itself, except for degrees.
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
    value.Fail(fmt::format("the lower end {} is greater than the upper end {}", ends[0].Text(),
                           ends[1].Text()),
               "[low, high] with low <= high");
  }
  if (interval.low == kInfinity || interval.high == -kInfinity) {
    value.Fail("the interval holds no number", "[low, high] with a number between them");
  }
  return interval;
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

// The text of a file. It finds the text at the place of a value.
class Source {
 public:
  explicit Source(std::string_view text) {
    constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
    if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
    while (!text.empty()) {
      const std::size_t end = std::min(text.find('\n'), text.size() - 1);
      lines_.push_back(text.substr(0, end + 1));
      text.remove_prefix(end + 1);
    }
  }

  // Returns the text from the place to the end of its line.
  std::string_view From(const FilePlace& place) const {
    if (place.line < 1 || place.line > std::ssize(lines_) || place.column < 1) return {};
    const std::string_view line = lines_[static_cast<std::size_t>(place.line) - 1];
    return line.substr(std::min(static_cast<std::size_t>(place.column) - 1, line.size()));
  }

 private:
  std::vector<std::string_view> lines_;
};

// A text that contains one or two expressions.
struct ExpressionText {
  std::string text;
  FilePlace place;  // where the text begins; where the whole value begins if the layout is kOther
  Layout layout = Layout::kAsInFile;
};

// Reads a text and its layout. Escapes, line breaks and the indentation of blocks make the text
// differ from the characters in the file.
ExpressionText ReadText(const Value& value, const Source& source) {
  ExpressionText read = {.text = value.Text(), .place = value.Place()};
  std::string_view rest = source.From(read.place);
  const bool is_quoted = rest.starts_with('"') || rest.starts_with('\'');
  if (is_quoted) rest.remove_prefix(1);
  if (!rest.starts_with(read.text)) {
    read.layout = Layout::kOther;
  } else if (is_quoted) {
    ++read.place.column;
  }
  return read;
}

// Reads a part of the text as an expression.
Expression ReadPiece(const ExpressionText& whole, std::size_t first, std::size_t length,
                     ExpressionPool& pool) {
  const std::string_view piece = std::string_view(whole.text).substr(first, length);
  FilePlace place = whole.place;
  if (whole.layout == Layout::kAsInFile) place.column += static_cast<int>(first);
  const std::string_view trimmed = Trimmed(piece);
  if (trimmed.empty()) {
    throw InputError(place, fmt::format("an expression is missing in '{}'", whole.text),
                     "an expression, such as 3*cos(t) + x");
  }
  return Parse(whole.layout == Layout::kAsInFile ? piece : trimmed, pool, place, whole.layout);
}

struct Comparison {
  std::size_t begin = 0;  // offset in the text
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

void ReadConstraint(const Value& value, const Source& source, BoundProblem& problem) {
  const ExpressionText whole = ReadText(value, source);
  const Comparison comparison = FindComparison(value, whole.text);
  const Expression left = ReadPiece(whole, 0, comparison.begin, *problem.pool);
  const Expression right = ReadPiece(whole, comparison.end, std::string::npos, *problem.pool);
  std::vector<Inequality>& inequalities = problem.constraints.inequalities;
  if (comparison.kind != '>') inequalities.push_back({.lesser = left, .greater = right});
  if (comparison.kind != '<') inequalities.push_back({.lesser = right, .greater = left});
}

void ReadQuestions(const Value& expressions, const Source& source, BoundProblem& problem) {
  const std::vector<Value> items = expressions.Items();
  if (items.empty())
    expressions.Fail("the list of expressions is empty", "at least one expression");
  for (const Value& item : items) {
    const ExpressionText whole = ReadText(item, source);
    problem.questions.push_back(
        {.text = whole.text, .expression = ReadPiece(whole, 0, whole.text.size(), *problem.pool)});
  }
}

}  // namespace

BoundProblem ReadBoundProblem(const std::string& text, const std::string& file_name) {
  const Document document = Document::Parse(text, file_name);
  const Source source(text);
  const Value& root = document.root();
  root.AllowOnly({"variables", "constraints", "expressions"});
  BoundProblem problem{
      .pool = std::make_unique<ExpressionPool>(), .constraints = {}, .questions = {}};
  for (const auto& [name, interval] : root.At("variables").Entries()) {
    ReadVariable(name, interval, *problem.pool);
  }
  problem.constraints = DeclaredBox(*problem.pool);
  if (const std::optional<Value> constraints = root.Find("constraints")) {
    for (const Value& constraint : constraints->Items()) {
      ReadConstraint(constraint, source, problem);
    }
  }
  ReadQuestions(root.At("expressions"), source, problem);
  return problem;
}

BoundProblem LoadBoundProblem(const std::filesystem::path& file) {
  return ReadBoundProblem(ReadInput(file, "a YAML or JSON file that can be read"), file.string());
}

}  // namespace assay::algebra
