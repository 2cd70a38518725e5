#include "planner/algebra/expression/text_writer.h"

#include <fmt/format.h>

#include <iterator>
#include <utility>

namespace assay::algebra {

namespace {

constexpr int kDeepestRecursion = 200;

bool TakesParentheses(const Expression& e, TextPlace place) {
  const bool is_negated = TextWriter::IsNegated(e) && place >= TextPlace::kNumerator;
  return is_negated || place >= e.op().rule().parenthesized_from;
}

}  // namespace

bool TextWriter::IsNegated(const Expression& e) {
  if (e.IsConstant()) return e.constant() < 0;
  return e.op() == Operator::kProduct && e.operands().size() <= Expression::kMostFlattened &&
         e.operands()[0].IsConstant() && e.operands()[0].constant() < 0;
}

std::string TextWriter::Write(const Expression& e) {
  Put(e, TextPlace::kWhole);
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

void TextWriter::Put(std::string_view text) {
  if (pieces_.empty()) {
    text_ += text;
  } else {
    pieces_.push_back({.text = std::string(text)});
  }
}

void TextWriter::Put(const Expression& e, TextPlace place) {
  if (const auto shared = shared_.find(e.index()); shared != shared_.end()) {
    Put(fmt::format("#{}", shared->second));
  } else if (pieces_.empty() && nesting_ < kDeepestRecursion) {
    ++nesting_;
    Expand(e, place);
    --nesting_;
  } else {
    pieces_.push_back({.text = {}, .expression = e, .place = place});
  }
}

// Moves the pieces onto the stack, so that the first of them is written next.
void TextWriter::FlushPieces() {
  std::move(pieces_.rbegin(), pieces_.rend(), std::back_inserter(stack_));
  pieces_.clear();
}

void TextWriter::Expand(const Expression& e, TextPlace place) {
  if (TakesParentheses(e, place)) {
    Put("(");
    Put(e, TextPlace::kWhole);
    Put(")");
  } else if (place != TextPlace::kNegatedTerm && IsNegated(e)) {
    Put("-");
    Put(e, TextPlace::kNegatedTerm);
  } else {
    ExpandOperation(e, place);
  }
}

void TextWriter::ExpandOperation(const Expression& e, TextPlace place) {
  if (e.IsConstant()) {
    Put(fmt::format("{}", place == TextPlace::kNegatedTerm ? -e.constant() : e.constant()));
  } else if (e.op() == Operator::kVariable) {
    Put(e.pool()->name(e.variable()));
  } else if (const auto write = e.op().rule().write; write != nullptr) {
    write(*this, e, place);
  } else {
    ExpandFunction(e);
  }
}

void TextWriter::ExpandFunction(const Expression& e) {
  Put(e.op().rule().name);
  Put("(");
  Put(e.operands()[0], TextPlace::kWhole);
  for (const Expression& argument : e.operands().subspan(1)) {
    Put(", ");
    Put(argument, TextPlace::kWhole);
  }
  Put(")");
}

}  // namespace assay::algebra
