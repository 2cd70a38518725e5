// The target reads expressions and computes their bounds with a small budget.

#include "planner/algebra/bounds/bound_file.h"
#include "planner/algebra/bounds/bounds.h"
#include "planner/base/check.h"
#include "tests/fuzz/reader_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace assay;
  return fuzz::RefusesOrDoes([&] {
    const algebra::BoundProblem problem =
        algebra::ReadBoundProblem(fuzz::TextOf(data, size), "bounds.yaml");
    for (const auto& question : problem.questions) {
      algebra::PreparedExpression prepared(question.expression);
      prepared.Both(problem.constraints, {.evaluations = 200});
    }
  });
}
