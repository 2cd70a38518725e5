// The target reads a PDDL domain and one of its problems, with a line of equals signs between them.

#include "planner/contingent/pks_and_pddl/pddl_file.h"
#include "tests/fuzz/knowledge.h"
#include "tests/fuzz/reader_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace assay;
  const auto [domain, problem] = fuzz::TwoTexts(fuzz::TextOf(data, size));
  return fuzz::RefusesOrDoes([&] {
    const contingent::Domain read = contingent::ReadPddlDomain(domain, "domain.pddl");
    fuzz::GroundAndPlan(read, contingent::ReadPddlProblem(problem, "problem.pddl", read));
  });
}
