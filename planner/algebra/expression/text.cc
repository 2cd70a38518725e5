#include "planner/algebra/expression/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <map>
#include <numbers>
#include <ranges>
#include <span>
#include <system_error>
#include <unordered_map>
#include <utility>
#include <vector>

#include "planner/algebra/expression/name.h"
#include "planner/base/check.h"
#include "planner/base/document/document.h"
#include "planner/base/document/nearest_name.h"

namespace assay::algebra {

namespace {

struct Function {
  std::string_view name;
  Operator op;
  std::size_t arguments;
};

constexpr Function kFunctions[] = {
    {"sin", Operator::kSin, 1}, {"cos", Operator::kCos, 1}, {"sqrt", Operator::kSqrt, 1},
    {"abs", Operator::kAbs, 1}, {"min", Operator::kMin, 2}, {"max", Operator::kMax, 2},
};

constexpr int kDeepestNesting = 200;

// The position of a sub-expression, which decides whether it needs parentheses.
enum class Place {
  kWhole,        // the whole text, an argument, or inside parentheses
  kTerm,         // a term of a sum, with its sign
  kNegatedTerm,  // a term of a sum whose minus sign is already written
  kNumerator,
  kFirstFactor,
  kFactor,  // a factor after the first, or a denominator
  kBase,    // the base of a power
};

// Returns true if the text of e begins with a minus sign. Parse applies that sign to the whole
// product. The sign folds into the product's number only if the product is small enough to be
// flattened.
bool IsNegated(const Expression& e) {
  if (e.IsConstant()) return e.constant() < 0;
  return e.op() == Operator::kProduct && e.operands().size() <= Expression::kMostFlattened &&
         e.operands()[0].IsConstant() && e.operands()[0].constant() < 0;
}

bool TakesParentheses(const Expression& e, Place place) {
  const bool is_at_sum =
      place == Place::kWhole || place == Place::kTerm || place == Place::kNegatedTerm;
  switch (e.op()) {
    case Operator::kConstant:
      return !is_at_sum && IsNegated(e);
    case Operator::kSum:
      return place != Place::kWhole;
    case Operator::kProduct:
      return !is_at_sum && (place != Place::kNumerator || IsNegated(e));
    case Operator::kQuotient:
      return place == Place::kFactor || place == Place::kBase;
    case Operator::kPower:
      return place == Place::kBase;
    case Operator::kVariable:
    case Operator::kSin:
    case Operator::kCos:
    case Operator::kSqrt:
    case Operator::kAbs:
    case Operator::kMin:
    case Operator::kMax:
      return false;
  }
  return false;
}

// The places of the sub-expressions that are written once, by Expression::index.
using SharedPlaces = std::unordered_map<int, std::size_t>;

// Writes an expression by recursion down to a fixed depth. Deeper pieces wait in an explicit stack,
// so that no expression overflows the call stack.
class Writer {
 public:
  explicit Writer(const SharedPlaces& shared) : shared_(shared) {}

  std::string Write(const Expression& e) {
    Put(e, Place::kWhole);
    FlushPieces();
    while (!stack_.empty()) {
      const Piece piece = std::move(stack_.back());
      stack_.pop_back();
      text_ += piece.text;
      if (piece.text.empty()) Expand(piece.expression, piece.place);
      FlushPieces();
    }
    return std::move(text_);
  }

 private:
  struct Piece {
    std::string text;  // if empty, `expression` is written instead
    Expression expression = {};
    Place place = Place::kWhole;
  };

  void Put(std::string_view text) {
    if (pieces_.empty()) {
      text_ += text;
    } else {
      pieces_.push_back({.text = std::string(text)});
    }
  }
  void Put(const Expression& e, Place place) {
    if (const auto shared = shared_.find(e.index()); IsShared(e)) {
      Put(fmt::format("#{}", shared->second));
    } else if (pieces_.empty() && nesting_ < kDeepestNesting) {
      ++nesting_;
      Expand(e, place);
      --nesting_;
    } else {
      pieces_.push_back({.text = {}, .expression = e, .place = place});
    }
  }

  bool IsShared(const Expression& e) const { return shared_.contains(e.index()); }

  // Moves the pieces onto the stack, so that the first of them is written next.
  void FlushPieces() {
    std::move(pieces_.rbegin(), pieces_.rend(), std::back_inserter(stack_));
    pieces_.clear();
  }

  void Expand(const Expression& e, Place place) {
    if (TakesParentheses(e, place)) {
      Put("(");
      Put(e, Place::kWhole);
      Put(")");
    } else if (place != Place::kNegatedTerm && IsNegated(e)) {
      Put("-");
      Put(e, Place::kNegatedTerm);
    } else {
      ExpandOperation(e, place);
    }
  }

  void ExpandOperation(const Expression& e, Place place) {
    switch (e.op()) {
      case Operator::kConstant:
        Put(fmt::format("{}", place == Place::kNegatedTerm ? -e.constant() : e.constant()));
        return;
      case Operator::kVariable:
        Put(e.pool()->name(e.variable()));
        return;
      case Operator::kSum:
        ExpandSum(e.operands());
        return;
      case Operator::kProduct:
        ExpandProduct(e.operands(), place);
        return;
      case Operator::kPower:
        Put(e.operands()[0], Place::kBase);
        Put(fmt::format("^{}", e.exponent()));
        return;
      case Operator::kQuotient:
        Put(e.operands()[0], Place::kNumerator);
        Put("/");
        Put(e.operands()[1], Place::kFactor);
        return;
      case Operator::kSin:
      case Operator::kCos:
      case Operator::kSqrt:
      case Operator::kAbs:
      case Operator::kMin:
      case Operator::kMax:
        ExpandFunction(e);
        return;
    }
  }

  void ExpandSum(std::span<const Expression> terms) {
    Put(terms[0], Place::kTerm);
    for (const Expression& term : terms.subspan(1)) {
      const bool is_negated = !IsShared(term) && IsNegated(term);
      Put(is_negated ? " - " : " + ");
      Put(term, is_negated ? Place::kNegatedTerm : Place::kTerm);
    }
  }

  void ExpandProduct(std::span<const Expression> factors, Place place) {
    if (place == Place::kNegatedTerm && factors[0].IsConstant(-1)) {
      factors = factors.subspan(1);
      Put(factors[0], Place::kFirstFactor);
    } else {
      Put(factors[0], place == Place::kNegatedTerm ? place : Place::kFirstFactor);
    }
    for (const Expression& factor : factors.subspan(1)) PutTimes(factor);
  }

  void PutTimes(const Expression& factor) {
    Put("*");
    Put(factor, Place::kFactor);
  }

  void ExpandFunction(const Expression& e) {
    Put(std::ranges::find(kFunctions, e.op(), &Function::op)->name);
    Put("(");
    Put(e.operands()[0], Place::kWhole);
    for (const Expression& argument : e.operands().subspan(1)) {
      Put(", ");
      Put(argument, Place::kWhole);
    }
    Put(")");
  }

  const SharedPlaces& shared_;
  std::string text_;
  int nesting_ = 0;
  std::vector<Piece> stack_;   // the piece to write next is last
  std::vector<Piece> pieces_;  // the waiting pieces of one expansion, in order
};

constexpr int kLargestWrittenExponent = 100;
constexpr std::string_view kOperandAllowed = "a number, a variable, a function or a parenthesis";

bool IsSpace(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

// A recursive-descent parser with one member function for each rule of the grammar.
class Parser {
 public:
  Parser(std::string_view text, ExpressionPool& pool, const FilePlace& place, Layout layout,
         std::span<const Expression> shared)
      : text_(text), pool_(pool), place_(place), layout_(layout), shared_(shared) {}

  Expression ParseAll() {
    const Expression e = ParseSum();
    if (at_ < text_.size()) FailAtNext("an operator, or the end");
    return e;
  }

 private:
  [[noreturn]] void Fail(std::size_t at, const std::string& what, std::string_view allowed) const {
    FilePlace place = place_;
    switch (layout_) {
      case Layout::kAsInFile:
        place.column += static_cast<int>(at);
        throw InputError(place, what, std::string(allowed));
      case Layout::kOther:
        throw InputError(place, fmt::format("{} of the expression: {}", PlaceText(at), what),
                         std::string(allowed));
    }
    ASSAY_CHECK(false, "no such layout");
  }

  std::string PlaceText(std::size_t at) const {
    return layout_ == Layout::kAsInFile
               ? fmt::format("column {}", place_.column + static_cast<int>(at))
               : fmt::format("character {}", at + 1);
  }

  // Reports that the text at at_ is not what the grammar allows there.
  [[noreturn]] void FailAtNext(std::string_view allowed) const {
    if (at_ >= text_.size()) Fail(at_, "the expression ends too early", allowed);
    Fail(at_, fmt::format("unexpected '{}' in an expression", NextWord()), allowed);
  }

  // Returns the name, number or character at at_, for error messages.
  std::string_view NextWord() const {
    std::size_t end = at_;
    while (end < text_.size() && (IsLetter(text_[end]) || IsDigit(text_[end]))) ++end;
    // A character beyond ASCII has several bytes.
    if (end == at_) ++end;
    while (end < text_.size() && (static_cast<unsigned char>(text_[end]) & 0xC0U) == 0x80U) ++end;
    return text_.substr(at_, end - at_);
  }

  void SkipSpace() {
    while (at_ < text_.size() && IsSpace(text_[at_])) ++at_;
  }

  // Skips white space before it tests the next character.
  bool IsNext(char c) {
    SkipSpace();
    return at_ < text_.size() && text_[at_] == c;
  }

  bool Take(char c) {
    if (!IsNext(c)) return false;
    ++at_;
    return true;
  }

  Expression ParseSum() {
    std::vector<Expression> terms;
    terms.push_back(Take('-') ? -ParseProduct() : ParseProduct());
    while (true) {
      if (Take('+')) {
        terms.push_back(ParseProduct());
      } else if (Take('-')) {
        terms.push_back(-ParseProduct());
      } else {
        return Sum(terms);
      }
    }
  }

  Expression ParseProduct() {
    std::vector<Expression> factors = {ParseFactor()};
    while (true) {
      if (Take('*')) {
        factors.push_back(ParseFactor());
      } else if (Take('/')) {
        const Expression numerator = Product(factors);
        factors = {numerator / ParseFactor()};
      } else {
        return Product(factors);
      }
    }
  }

  Expression ParseFactor() {
    if (Take('-')) return -ParsePower();
    return ParsePower();
  }

  Expression ParsePower() {
    const Expression base = ParseAtom();
    if (!Take('^')) return base;
    const int exponent = ParseExponent();
    if (IsNext('^')) Fail(at_, "a power of a power", "parentheses around the first one");
    return Power(base, exponent);
  }

  int ParseExponent() {
    const std::string allowed =
        fmt::format("an integer from -{} to {}", kLargestWrittenExponent, kLargestWrittenExponent);
    SkipSpace();
    const std::size_t begin = at_;
    int exponent = 0;
    const auto [end, error] =
        std::from_chars(text_.data() + at_, text_.data() + text_.size(), exponent);
    if (error == std::errc::invalid_argument) FailAtNext(allowed);
    at_ = static_cast<std::size_t>(end - text_.data());
    const bool is_cut = at_ < text_.size() && (text_[at_] == '.' || IsLetter(text_[at_]));
    if (error != std::errc() || std::abs(exponent) > kLargestWrittenExponent || is_cut) {
      while (at_ < text_.size() &&
             (text_[at_] == '.' || IsLetter(text_[at_]) || IsDigit(text_[at_]))) {
        ++at_;
      }
      Fail(begin, fmt::format("the exponent {}", text_.substr(begin, at_ - begin)), allowed);
    }
    return exponent;
  }

  Expression ParseAtom() {
    SkipSpace();
    if (at_ >= text_.size()) FailAtNext(kOperandAllowed);
    const char next = text_[at_];
    if (IsDigit(next) || next == '.') return ParseNumber();
    if (IsLetter(next)) return ParseName();
    if (next == '#') return ParseShared();
    if (next != '(') FailAtNext(kOperandAllowed);
    const std::size_t opening = at_++;
    Descend(opening);
    const Expression e = ParseSum();
    Ascend(opening);
    return e;
  }

  void Descend(std::size_t at) {
    if (++depth_ > kDeepestNesting) {
      Fail(at, "the expression is nested too deeply", fmt::format("{} levels", kDeepestNesting));
    }
  }

  void Ascend(std::size_t opening) {
    if (!Take(')')) {
      FailAtNext(fmt::format("an operator, or ')' for the '(' in {}", PlaceText(opening)));
    }
    --depth_;
  }

  std::size_t EndOfDigits(std::size_t at) const {
    while (at < text_.size() && IsDigit(text_[at])) ++at;
    return at;
  }

  std::size_t EndOfNumber() const {
    std::size_t end = EndOfDigits(at_);
    if (end < text_.size() && text_[end] == '.') end = EndOfDigits(end + 1);
    if (end < text_.size() && (text_[end] == 'e' || text_[end] == 'E')) {
      std::size_t digits = end + 1;
      if (digits < text_.size() && (text_[digits] == '+' || text_[digits] == '-')) ++digits;
      if (EndOfDigits(digits) > digits) end = EndOfDigits(digits);
    }
    return end;
  }

  Expression ParseNumber() {
    const std::size_t begin = at_;
    const std::string_view digits = text_.substr(begin, EndOfNumber() - begin);
    double value = 0;
    const auto error = std::from_chars(digits.data(), digits.data() + digits.size(), value).ec;
    if (error == std::errc::invalid_argument) FailAtNext(kOperandAllowed);
    if (error == std::errc::result_out_of_range) {
      Fail(begin, fmt::format("the number {}", digits), "a finite number that a double can hold");
    }
    at_ += digits.size();
    SkipSpace();
    if (at_ >= text_.size() || !IsLetter(text_[at_])) return pool_.Constant(value);
    const std::string_view word = NextWord();
    if (word != "deg") {
      Fail(at_, fmt::format("'{}' follows the number {} without an operator", word, digits),
           fmt::format("{}*{}, or deg after a number", digits, word));
    }
    at_ += word.size();
    return pool_.Constant(value * std::numbers::pi / 180);
  }

  Expression ParseShared() {
    const std::size_t begin = at_++;
    std::size_t place = 0;
    const std::size_t end = EndOfDigits(at_);
    const auto error = std::from_chars(text_.data() + at_, text_.data() + end, place).ec;
    if (error != std::errc() || place >= shared_.size()) {
      Fail(begin, fmt::format("there is no shared expression {}", text_.substr(begin, end - begin)),
           fmt::format("# and a place of the {} shared expressions before this one, from 0",
                       shared_.size()));
    }
    at_ = end;
    return shared_[place];
  }

  Expression ParseName() {
    const std::size_t begin = at_;
    const std::string_view name = NextWord();
    at_ += name.size();
    if (IsNext('(')) return ParseCall(begin, name);
    if (const auto variable = pool_.Find(name)) return pool_.Variable(*variable);
    FailUnknown(begin, name, VariableNames(), "variable");
  }

  Expression ParseCall(std::size_t begin, std::string_view name) {
    const auto* const function = std::ranges::find(kFunctions, name, &Function::name);
    if (function == std::end(kFunctions)) FailUnknown(begin, name, FunctionNames(), "function");
    const std::size_t opening = at_++;
    Descend(opening);
    std::vector<Expression> arguments = {ParseSum()};
    while (Take(',')) arguments.push_back(ParseSum());
    Ascend(opening);
    if (arguments.size() != function->arguments) {
      Fail(begin, fmt::format("{} is given {} arguments", name, arguments.size()),
           fmt::format("exactly {}", function->arguments));
    }
    return Apply(function->op, arguments);
  }

  std::vector<std::string> VariableNames() const {
    std::vector<std::string> names;
    for (int i = 0; i < pool_.variable_count(); ++i) names.push_back(pool_.name(VariableId(i)));
    return names;
  }

  static std::vector<std::string> FunctionNames() {
    std::vector<std::string> names;
    for (const Function& function : kFunctions) names.emplace_back(function.name);
    return names;
  }

  [[noreturn]] void FailUnknown(std::size_t at, std::string_view name,
                                const std::vector<std::string>& known,
                                std::string_view kind) const {
    const std::string nearest = NearestName(name, known);
    std::string what = fmt::format("unknown {} '{}'", kind, name);
    if (!nearest.empty()) what += fmt::format("; did you mean '{}'?", nearest);
    constexpr std::size_t kMostListed = 12;
    const bool is_short = !known.empty() && known.size() <= kMostListed;
    Fail(at, what, is_short ? fmt::format("{}", fmt::join(known, ", ")) : "a declared variable");
  }

  std::string_view text_;
  ExpressionPool& pool_;
  const FilePlace& place_;
  Layout layout_;
  std::span<const Expression> shared_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

// Returns the operations that occur more than once, each after its own operands.
std::vector<Expression> SharedBy(std::span<const Expression> expressions) {
  std::map<int, Expression> found, shared;
  std::vector<Expression> pending(expressions.begin(), expressions.end());
  while (!pending.empty()) {
    const Expression e = pending.back();
    pending.pop_back();
    if (e.operands().empty()) continue;
    if (found.emplace(e.index(), e).second) {
      pending.insert(pending.end(), e.operands().begin(), e.operands().end());
    } else {
      shared.emplace(e.index(), e);
    }
  }
  const auto of_shared = std::views::values(shared);
  return {of_shared.begin(), of_shared.end()};
}

}  // namespace

std::string Text(const Expression& e) { return Writer({}).Write(e); }

SharedTexts TextsOf(std::span<const Expression> expressions) {
  SharedTexts texts;
  SharedPlaces places;
  for (const Expression& e : SharedBy(expressions)) {
    texts.shared.push_back(Writer(places).Write(e));
    places.emplace(e.index(), places.size());
  }
  for (const Expression& e : expressions) texts.expressions.push_back(Writer(places).Write(e));
  return texts;
}

std::vector<Expression> ParseShared(std::span<const std::string> shared, ExpressionPool& pool,
                                    const FilePlace& place) {
  std::vector<Expression> parsed;
  for (const std::string& text : shared) {
    parsed.push_back(Parse(text, pool, place, Layout::kOther, parsed));
  }
  return parsed;
}

Expression Parse(std::string_view text, ExpressionPool& pool, const FilePlace& place, Layout layout,
                 std::span<const Expression> shared) {
  return Parser(text, pool, place, layout, shared).ParseAll();
}

}  // namespace assay::algebra
