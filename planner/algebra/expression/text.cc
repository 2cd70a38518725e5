#include "planner/algebra/expression/text.h"

#include <map>
#include <ranges>

#include "planner/algebra/expression/text_writer.h"

namespace assay::algebra {

namespace {

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

std::string Text(const Expression& e) { return TextWriter({}).Write(e); }

SharedTexts TextsOf(std::span<const Expression> expressions) {
  SharedTexts texts;
  SharedPlaces places;
  for (const Expression& e : SharedBy(expressions)) {
    texts.shared.push_back(TextWriter(places).Write(e));
    places.emplace(e.index(), places.size());
  }
  for (const Expression& e : expressions) texts.expressions.push_back(TextWriter(places).Write(e));
  return texts;
}

}  // namespace assay::algebra
