#include "planner/contingent/pks_and_pddl/pks_formula.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>

namespace assay::contingent {
namespace {

double ReadNumber(PksTokens& tokens) {
  const bool is_negative = tokens.TakeIf("-");
  if (tokens.Peek().kind != Token::Kind::kNumber) tokens.FailAtNext("a number");
  const Token token = tokens.Take();
  double number = 0;
  const char* const end = token.text.data() + token.text.size();
  const auto [stop, error] = std::from_chars(token.text.data(), end, number);
  if (error != std::errc() || stop != end || !std::isfinite(number)) {
    tokens.Fail(token.place, fmt::format("'{}' is no number", token.text), "a finite number");
  }
  return is_negative ? -number : number;
}

Interval ReadInterval(PksTokens& tokens) {
  if (!tokens.TakeIf("[")) {
    const double number = ReadNumber(tokens);
    return {number, number};
  }
  const Place place = tokens.Peek().place;
  Interval interval;
  interval.low = ReadNumber(tokens);
  tokens.Expect(",");
  interval.high = ReadNumber(tokens);
  tokens.Expect("]");
  if (interval.low > interval.high) {
    tokens.Fail(place, fmt::format("the interval [{}, {}] is empty", interval.low, interval.high),
                "a lower end that is not above the upper one");
  }
  return interval;
}

// sum = term [ ("+" | "-") term ]
Term ReadSum(PksTokens& tokens) {
  Term left = ReadTerm(tokens);
  if (!tokens.Peek().Is("+") && !tokens.Peek().Is("-")) return left;
  Term sum;
  sum.place = tokens.Peek().place;
  sum.kind = tokens.Take().text == "+" ? Term::Kind::kSum : Term::Kind::kDifference;
  sum.arguments.push_back(std::move(left));
  sum.arguments.push_back(ReadTerm(tokens));
  return sum;
}

std::optional<std::pair<Relation, bool>> RelationOf(const Token& token) {
  if (token.kind != Token::Kind::kSign) return std::nullopt;
  if (token.text == "=") return {{Relation::kEqual, true}};
  if (token.text == "!=") return {{Relation::kEqual, false}};
  if (token.text == "<") return {{Relation::kLess, true}};
  if (token.text == "<=") return {{Relation::kLessOrEqual, true}};
  if (token.text == ">") return {{Relation::kGreater, true}};
  if (token.text == ">=") return {{Relation::kGreaterOrEqual, true}};
  return std::nullopt;
}

Query ReadUnary(PksTokens& tokens);

Query ReadSequence(PksTokens& tokens, std::string_view sign, Query::Kind kind) {
  const PksTokens::Nesting nesting(tokens);
  const auto operand = [&] {
    return kind == Query::Kind::kOr ? ReadSequence(tokens, "&", Query::Kind::kAnd)
                                    : ReadUnary(tokens);
  };
  std::vector<Query> operands = tokens.List(sign, operand);
  if (operands.size() == 1) return std::move(operands.front());
  Query all;
  all.kind = kind;
  all.place = operands.front().place;
  all.operands = std::move(operands);
  return all;
}

Query ReadModal(PksTokens& tokens) {
  Query query;
  query.place = tokens.Peek().place;
  const std::string word = tokens.Peek().kind == Token::Kind::kName ? tokens.Peek().text : "";
  if (word == "forallK" || word == "existsK") {
    tokens.Take();
    query.kind = word == "forallK" ? Query::Kind::kForAll : Query::Kind::kExists;
    query.variables = tokens.Variables();
    query.operands.push_back(ReadUnary(tokens));
    return query;
  }
  if (word == "true") {
    tokens.Take();
    return query;
  }
  if (word != "K" && word != "Kw" && word != "Kv") {
    tokens.FailAtNext(
        "K(...), Kw(...), Kv(...), forallK, existsK, true, a negation or a parenthesis");
  }
  tokens.Take();
  tokens.Expect("(");
  if (word == "Kv") {
    query.kind = Query::Kind::kValueKnown;
    query.terms.push_back(ReadTerm(tokens));
    query.within = ReadWithin(tokens);
  } else {
    query.kind = word == "K" ? Query::Kind::kKnown : Query::Kind::kKnownWhether;
    query.literals = ReadConjunction(tokens);
  }
  tokens.Expect(")");
  return query;
}

Query ReadUnary(PksTokens& tokens) {
  const PksTokens::Nesting nesting(tokens);
  const Place place = tokens.Peek().place;
  if (tokens.TakeNegation()) {
    Query negation;
    negation.kind = Query::Kind::kNot;
    negation.place = place;
    negation.operands.push_back(ReadUnary(tokens));
    return negation;
  }
  if (tokens.TakeIf("(")) {
    Query inner = ReadQuery(tokens);
    tokens.Expect(")");
    return inner;
  }
  return ReadModal(tokens);
}

}  // namespace

Query ReadQuery(PksTokens& tokens) { return ReadSequence(tokens, "|", Query::Kind::kOr); }

std::vector<Literal> ReadConjunction(PksTokens& tokens) {
  return tokens.List("&", [&] { return ReadLiteral(tokens); });
}

Literal ReadLiteral(PksTokens& tokens) {
  const PksTokens::Nesting nesting(tokens);
  Literal literal;
  literal.place = tokens.Peek().place;
  if (tokens.TakeNegation()) {
    literal = ReadLiteral(tokens);
    literal.is_positive = !literal.is_positive;
    return literal;
  }
  if (tokens.TakeIf("(")) {
    literal = ReadLiteral(tokens);
    tokens.Expect(")");
    return literal;
  }
  const bool is_extern = tokens.Peek(1).Is("(") && tokens.TakeWordIf("extern");
  if (is_extern) tokens.Expect("(");
  Term left = ReadTerm(tokens);
  if (const auto relation = RelationOf(tokens.Peek()); relation && !is_extern) {
    tokens.Take();
    literal.relation = relation->first;
    literal.is_positive = relation->second;
    literal.arguments.push_back(std::move(left));
    literal.arguments.push_back(ReadSum(tokens));
    return literal;
  }
  if (left.kind != Term::Kind::kConstant && left.kind != Term::Kind::kFunction) {
    tokens.FailAtNext("'=', '!=', '<', '<=', '>' or '>='");
  }
  literal.relation = is_extern ? Relation::kExtern : Relation::kPredicate;
  literal.predicate = left.name;
  literal.arguments = std::move(left.arguments);
  if (is_extern) tokens.Expect(")");
  return literal;
}

Term ReadTerm(PksTokens& tokens) {
  const PksTokens::Nesting nesting(tokens);
  Term term;
  term.place = tokens.Peek().place;
  if (tokens.Peek().kind == Token::Kind::kVariable) {
    term.kind = Term::Kind::kVariable;
    term.name = tokens.Take().text;
    return term;
  }
  if (tokens.Peek().kind == Token::Kind::kNumber || tokens.Peek().Is("-") ||
      tokens.Peek().Is("[")) {
    term.kind = Term::Kind::kNumber;
    term.value = ReadInterval(tokens);
    return term;
  }
  term.name = tokens.ExpectName("a name, a ?variable, a number or an interval").text;
  if (tokens.TakeIf("(")) {
    term.kind = Term::Kind::kFunction;
    if (!tokens.Peek().Is(")")) {
      term.arguments = tokens.List(",", [&] { return ReadTerm(tokens); });
    }
    tokens.Expect(")");
  }
  return term;
}

std::optional<double> ReadWithin(PksTokens& tokens) {
  if (!tokens.TakeWordIf("within")) return std::nullopt;
  const Place place = tokens.Peek().place;
  const double within = ReadNumber(tokens);
  if (within < 0) tokens.Fail(place, fmt::format("an error of {}", within), "0 or more");
  return within;
}

}  // namespace assay::contingent
