// The target reads a PKS domain and one of its problems, with a line of equals signs between them.

#include "planner/contingent/pks_and_pddl/pks_file.h"
#include "tests/fuzz/knowledge.h"
#include "tests/fuzz/reader_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace assay;
  const auto [domain, problem] = fuzz::TwoTexts(fuzz::TextOf(data, size));
  return fuzz::RefusesOrDoes([&] {
    const contingent::Domain read = contingent::ReadPksDomain(domain, "domain.pks");
    fuzz::GroundAndPlan(read, contingent::ReadPksProblem(problem, "problem.pks"));
  });
}
