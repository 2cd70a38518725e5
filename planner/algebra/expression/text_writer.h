#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "planner/algebra/expression/expression.h"
#include "planner/algebra/operators/operator_rule.h"

namespace assay::algebra {

// The places of the sub-expressions that are written once, by Expression::index.
using SharedPlaces = std::unordered_map<int, std::size_t>;

// Writes an expression by recursion down to a fixed depth. Deeper pieces wait in an explicit stack,
// so that no expression overflows the call stack.
class TextWriter {
 public:
  explicit TextWriter(const SharedPlaces& shared) : shared_(shared) {}

  std::string Write(const Expression& e);

  // These functions are for the rules of operators. They append a text, or an expression that
  // stands at the given place.
  void Put(std::string_view text);
  void Put(const Expression& e, TextPlace place);

  bool IsShared(const Expression& e) const { return shared_.contains(e.index()); }

  // Returns true if the text of e begins with a minus sign. Parse applies that sign to the whole
  // product. The sign folds into the product's number only if the product is small enough to be
  // flattened.
  static bool IsNegated(const Expression& e);

 private:
  struct Piece {
    std::string text;  // if empty, `expression` is written instead
    Expression expression = {};
    TextPlace place = TextPlace::kWhole;
  };

  void FlushPieces();
  void Expand(const Expression& e, TextPlace place);
  void ExpandOperation(const Expression& e, TextPlace place);
  void ExpandFunction(const Expression& e);

  const SharedPlaces& shared_;
  std::string text_;
  int nesting_ = 0;
  std::vector<Piece> stack_;   // the piece to write next is last
  std::vector<Piece> pieces_;  // the waiting pieces of one expansion, in order
};

}  // namespace assay::algebra
