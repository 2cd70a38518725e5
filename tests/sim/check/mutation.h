#pragma once

#include <string>
#include <vector>

#include "planner/uncertainty/preconditions/certify.h"
#include "tests/sim/check/certified.h"

namespace assay::check {

// A lie of the theory: certificates are made with it, and the harness is to find out.
enum class Lie {
  kHalvedSet,        // what is known of a part after a step, in one component, and from then on
  kHalvedPromise,    // likewise after a look, in all components
  kErrorNotCarried,  // what is known after a step is right, and forgotten in the steps after it
  kForgottenError,   // a part or the hand does not err in one coordinate
  kAsPublished,      // no lever arm of a turned part, one error of the hand at all poses
  kMovedLimit,       // a precondition is said to hold by a third more than it does
};
std::string_view Name(Lie lie);

struct Mutation {
  Lie lie = Lie::kHalvedSet;
  plan::StepId step = plan::StepId::None();
  domain::PartId part = domain::PartId::None();  // None in kForgottenError: the hand
  int component = 0;                             // of an ErrorSet: x, y, z, theta, tip, twist
  std::string condition = {};                    // whose limit is moved

  std::string Text(const Certified& certified) const;
};

// Every mutation that changes something that a certificate of the plan says.
std::vector<Mutation> MutationsOf(const Certified& certified);

// The plan as it would be certified by the theory with this lie in it.
plan::Plan CertifiedWith(const Mutation& mutation, const Certified& certified);

}  // namespace assay::check
