#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "planner/algebra/expression/expression.h"
#include "planner/algebra/expression/text_scanner.h"
#include "planner/base/input_files/input_error.h"

namespace assay::algebra {

// Reads an expression over the pool's variables. The grammar is:
//   sum     = ["-"] product { ("+" | "-") product }
//   product = factor { ("*" | "/") factor }
//   factor  = ["-"] atom [ "^" integer ]                   -x^2 = -(x^2); integer from -100 to 100
//   atom    = number ["deg"] | name | "#" place | name "(" sum {"," sum} ")" | "(" sum ")"
// "N deg" is the double N * pi / 180, with each operation rounded to nearest. It is not an interval
// that encloses the exact angle. "#3" is the expression at place 3 of `shared`, counted from 0.
// `place` is where the text begins in its file. Throws InputError, with the place in the text, for
// unknown names (the nearest known name is given), for more than 200 levels of nesting, and for
// numbers that are not finite.
Expression Parse(std::string_view text, ExpressionPool& pool, const FilePlace& place,
                 Layout layout = Layout::kAsInFile, std::span<const Expression> shared = {});

// Reads the texts of SharedTexts::shared and returns their expressions in the same order.
std::vector<Expression> ParseShared(std::span<const std::string> shared, ExpressionPool& pool,
                                    const FilePlace& place);

}  // namespace assay::algebra
