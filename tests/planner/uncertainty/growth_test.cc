#include <gtest/gtest.h>

#include <cmath>

#include "bench/pick_and_place.h"
#include "planner/algebra/bounds/bounds.h"
#include "planner/algebra/expression/nodes.h"
#include "planner/uncertainty/preconditions/certify.h"
#include "tests/oracle/certified_expressions.h"

// The work of bounding all preconditions of a plan of n pick-and-place actions on one part grows
// polynomially in n. The paper says that it grows exponentially. The test counts operations and
// does not measure time.
namespace assay::uncertainty::growth_test {
namespace {

constexpr int kMost = 50;
constexpr double kLean = 0.5235987755982988;  // 30 deg

// The test stops at this number of characters, so that it ends even if growth is exponential.
constexpr std::int64_t kTooMuchText = 20'000'000;

// The work up to and including the nth pick and place.
struct Work {
  std::int64_t preconditions = 0;
  std::int64_t variables = 0;    // sum over the certificates
  std::int64_t terms = 0;        // operations and operands in the written preconditions
  std::int64_t evaluations = 0;  // evaluations that bounding the preconditions takes
  std::int64_t text = 0;
};

void Count(const plan::Certificate& certificate, Work& work) {
  for (const std::string& text : certificate.shared) work.text += std::ssize(text);
  for (const auto& claim : certificate.preconditions) work.text += std::ssize(claim.expression);
  if (work.text > kTooMuchText) return;
  algebra::ExpressionPool pool;
  const std::vector<Expression> expressions = oracle::CertifiedExpressions(certificate, pool);
  work.variables += pool.variable_count();
  const algebra::ConstraintSet box = algebra::DeclaredBox(pool);
  for (std::size_t k = 0; k < expressions.size(); ++k) {
    const plan::CertifiedPrecondition& claim = certificate.preconditions[k];
    const Expression& e = expressions[k];
    const algebra::BoundRequest request = {.limit = claim.limit};
    const auto bound = claim.relation == plan::Relation::kLess
                           ? algebra::BoundAbove(e, box, request)
                           : algebra::BoundBelow(e, box, request);
    ++work.preconditions;
    work.terms += std::ssize(algebra::NodesOf(e));
    work.evaluations += bound.evaluations;
  }
}

// Returns the works, where works[n - 1] belongs to n. The list ends at kMost or where the text
// becomes too long.
std::vector<Work> WorkOf(double lean) {
  const auto plan = bench::MakePickAndPlace(kMost, lean);
  UncertainWorld world(plan.problem, Propagation::kSound);
  std::vector<Work> works;
  Work work;
  for (std::size_t i = 0; i < plan.actions.size(); ++i) {
    Count(CertifyStep(world, plan.actions[i], {}).certificate, work);
    if (work.text > kTooMuchText) break;
    if (i % 2 == 1) works.push_back(work);
  }
  return works;
}

class Growth : public ::testing::TestWithParam<double> {};

TEST_P(Growth, IsPolynomial) {
  const std::vector<Work> works = WorkOf(GetParam());
  ASSERT_EQ(works.size(), kMost) << "more than " << kTooMuchText << " characters of preconditions";
  const Work& at_10 = works[9];
  const Work& at_50 = works[49];
  const auto exponent = [](std::int64_t few, std::int64_t many) {
    return std::log(static_cast<double>(many) / static_cast<double>(few)) / std::log(5.0);
  };
  // Each action has the same number of preconditions, until the sets are so large that more
  // vertices may come near a neighbour.
  EXPECT_LT(exponent(at_10.preconditions, at_50.preconditions), 2);
  EXPECT_LT(exponent(at_10.variables, at_50.variables), 3);
  EXPECT_LT(exponent(at_10.terms, at_50.terms), 3);
  EXPECT_LT(exponent(at_10.evaluations, at_50.evaluations), 3);
}

INSTANTIATE_TEST_SUITE_P(Tools, Growth, ::testing::Values(0.0, kLean));

}  // namespace
}  // namespace assay::uncertainty::growth_test
