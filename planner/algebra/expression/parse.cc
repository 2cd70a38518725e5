#include "planner/algebra/expression/parse.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>

#include "planner/algebra/expression/evaluation.h"
#include "planner/algebra/expression/name.h"
#include "planner/algebra/operators/operator_rule.h"
#include "planner/algebra/operators/table.h"
#include "planner/base/input_files/nearest_name.h"

namespace assay::algebra {

namespace {

constexpr int kDeepestNesting = 200;

// A recursive-descent parser with one member function for each rule of the grammar.
class Parser {
 public:
  Parser(std::string_view text, ExpressionPool& pool, const FilePlace& place, Layout layout,
         std::span<const Expression> shared)
      : scanner_(text, place, layout), pool_(pool), shared_(shared) {}

  Expression ParseAll() {
    const Expression e = ParseSum();
    if (!scanner_.IsAtEnd()) scanner_.FailAtNext("an operator, or the end");
    return e;
  }

 private:
  Expression ParseSum() {
    std::vector<Expression> terms;
    terms.push_back(scanner_.Take('-') ? -ParseProduct() : ParseProduct());
    while (true) {
      if (scanner_.Take('+')) {
        terms.push_back(ParseProduct());
      } else if (scanner_.Take('-')) {
        terms.push_back(-ParseProduct());
      } else {
        return Sum(terms);
      }
    }
  }

  Expression ParseProduct() {
    std::vector<Expression> factors = {ParseFactor()};
    while (true) {
      if (scanner_.Take('*')) {
        factors.push_back(ParseFactor());
      } else if (scanner_.Take('/')) {
        const Expression numerator = Product(factors);
        factors = {numerator / ParseFactor()};
      } else {
        return Product(factors);
      }
    }
  }

  Expression ParseFactor() {
    if (scanner_.Take('-')) return -ParsePower();
    return ParsePower();
  }

  Expression ParsePower() {
    const Expression base = ParseAtom();
    if (!scanner_.Take('^')) return base;
    const int exponent = scanner_.TakeExponent();
    if (scanner_.IsNext('^')) {
      scanner_.Fail(scanner_.at(), "a power of a power", "parentheses around the first one");
    }
    return Power(base, exponent);
  }

  Expression ParseAtom() {
    const char next = scanner_.Next();
    if (IsDigit(next) || next == '.') return pool_.Constant(scanner_.TakeNumber());
    if (IsLetter(next)) return ParseName();
    if (next == '#') return shared_[scanner_.TakeSharedPlace(shared_.size())];
    const std::size_t opening = scanner_.at();
    if (!scanner_.Take('(')) scanner_.FailAtNext(kOperandAllowed);
    Descend(opening);
    const Expression e = ParseSum();
    Ascend(opening);
    return e;
  }

  void Descend(std::size_t at) {
    if (++depth_ > kDeepestNesting) {
      scanner_.Fail(at, "the expression is nested too deeply",
                    fmt::format("{} levels", kDeepestNesting));
    }
  }

  void Ascend(std::size_t opening) {
    if (!scanner_.Take(')')) {
      scanner_.FailAtNext(
          fmt::format("an operator, or ')' for the '(' in {}", scanner_.PlaceText(opening)));
    }
    --depth_;
  }

  Expression ParseName() {
    const std::size_t begin = scanner_.at();
    const std::string_view name = scanner_.TakeWord();
    if (scanner_.IsNext('(')) return ParseCall(begin, name);
    if (const auto variable = pool_.Find(name)) return pool_.Variable(*variable);
    FailUnknown(begin, name, VariableNames(), "variable");
  }

  Expression ParseCall(std::size_t begin, std::string_view name) {
    const Operator* const function = FindFunction(name);
    if (function == nullptr) FailUnknown(begin, name, FunctionNames(), "function");
    const std::vector<Expression> arguments = ParseArguments();
    const std::size_t expected = function->rule().operand_count;
    if (arguments.size() != expected) {
      scanner_.Fail(begin, fmt::format("{} is given {} arguments", name, arguments.size()),
                    fmt::format("exactly {}", expected));
    }
    return Apply(*function, arguments);
  }

  std::vector<Expression> ParseArguments() {
    const std::size_t opening = scanner_.at();
    scanner_.Take('(');
    Descend(opening);
    std::vector<Expression> arguments = {ParseSum()};
    while (scanner_.Take(',')) arguments.push_back(ParseSum());
    Ascend(opening);
    return arguments;
  }

  // Returns null if no function has this name.
  const Operator* FindFunction(std::string_view name) const {
    for (const std::span<const Operator> functions : {Functions(), pool_.further_operators()}) {
      const auto found = std::ranges::find(functions, name, &NameOf);
      if (found != functions.end()) return &*found;
    }
    return nullptr;
  }

  static std::span<const Operator> Functions() { return kFunctions; }
  static std::string_view NameOf(const Operator& function) { return function.rule().name; }

  std::vector<std::string> VariableNames() const {
    std::vector<std::string> names;
    for (int i = 0; i < pool_.variable_count(); ++i) names.push_back(pool_.name(VariableId(i)));
    return names;
  }

  std::vector<std::string> FunctionNames() const {
    std::vector<std::string> names;
    for (const Operator& function : Functions()) names.emplace_back(NameOf(function));
    for (const Operator& function : pool_.further_operators()) names.emplace_back(NameOf(function));
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
    scanner_.Fail(at, what,
                  is_short ? fmt::format("{}", fmt::join(known, ", ")) : "a declared variable");
  }

  TextScanner scanner_;
  ExpressionPool& pool_;
  std::span<const Expression> shared_;
  int depth_ = 0;
};

}  // namespace

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
