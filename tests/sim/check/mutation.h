#pragma once

#include <string>
#include <vector>

#include "planner/uncertainty/preconditions/certify.h"
#include "tests/sim/check/certified.h"

namespace assay::check {

// A deliberate error in the theory. Certificates are made with it, and falsification is expected to
// reveal it.
enum class Lie {
  kHalvedSet,        // one component of a part's error set is halved after a step, and from then on
  kHalvedPromise,    // all components of a part's error set are halved after a look
  kErrorNotCarried,  // a right error set after a step is forgotten in the steps after it
  kForgottenError,   // one coordinate of a part's or the hand's error is taken to be 0
  // The rules of the paper. They neglect the lever arm of a turned part, and assume that the hand
  // has the same error at all poses.
  kAsPublished,
  kMovedLimit,  // the margin of a precondition is overstated by a third
};
std::string_view Name(Lie lie);

struct Mutation {
  Lie lie = Lie::kHalvedSet;
  plan::StepId step = plan::StepId::None();
  domain::PartId part = domain::PartId::None();   // None in kForgottenError means the hand
  int component = 0;                              // index in plan::ErrorComponents()
  std::optional<plan::Condition> condition = {};  // the condition whose limit is moved

  std::string Text(const Certified& certified) const;
};

// Returns every mutation of this plan that changes what one of its certificates says.
std::vector<Mutation> MutationsOf(const Certified& certified);

// Returns the plan with the certificates that the theory would give it if the theory contained this
// lie.
plan::Plan CertifiedWith(const Mutation& mutation, const Certified& certified);

}  // namespace assay::check
