#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "planner/algebra/expression/expression.h"
#include "planner/base/document/input_error.h"

namespace assay::algebra {

// "2 + 3*cos(tg)*dx^2 - min(x, sqrt(y))/4": numbers are written so that they read back as the same
// doubles, and Parse(Text(e)) == e in the same pool, if Parse accepts its nesting and exponents and
// its numbers are finite.
std::string Text(const Expression& e);

// Texts of expressions of one pool in which what they have in common stands once, as it does in the
// pool: what has the place i in `shared` is called #i in those after it, and in all expressions.
struct SharedTexts {
  std::vector<std::string> shared;
  std::vector<std::string> expressions;  // as many as were given
};
SharedTexts TextsOf(std::span<const Expression> expressions);

// Whether the text stands in its file character by character, on one line: then errors name the
// column. Else (escapes, a text folded from several lines) they name the place of the whole text
// and the character in it.
enum class Layout { kAsInFile, kOther };

// Reads an expression over the pool's variables:
//   sum     = ["-"] product { ("+" | "-") product }
//   product = factor { ("*" | "/") factor }
//   factor  = ["-"] atom [ "^" integer ]                   -x^2 = -(x^2); integer from -100 to 100
//   atom    = number ["deg"] | name | "#" place | name "(" sum {"," sum} ")" | "(" sum ")"
// "N deg" is one double, N * pi / 180 rounded to nearest at each operation: no interval that
// contains it. `place` is where the text begins; errors (InputError) name the place in it: unknown
// names with the nearest known one, more than 200 levels of nesting, numbers that are not finite.
// "#3" is the expression at place 3, from 0, of `shared`.
Expression Parse(std::string_view text, ExpressionPool& pool, const FilePlace& place,
                 Layout layout = Layout::kAsInFile, std::span<const Expression> shared = {});

// Reads SharedTexts::shared.
std::vector<Expression> ParseShared(std::span<const std::string> shared, ExpressionPool& pool,
                                    const FilePlace& place);

}  // namespace assay::algebra
