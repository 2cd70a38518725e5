#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner/plan/data/plan.h"
#include "planner/verify/certificate_algebra.h"

namespace assay::verify {

// One variable in the proof of a precondition.
struct VariableInProof {
  std::string name;
  domain::Dimension dimension;
  Interval range;
  std::optional<double> worst;  // value at the worst corner
  double cost = 0;              // improvement of the bound if the value were known
};

// A variable's range, before and after it is narrowed enough for a proof.
struct NarrowedVariable {
  std::string name;
  domain::Dimension dimension;
  Interval range;
  Interval enough;
};

// The facts that can be computed from a certified precondition and the variables of its
// certificate.
struct Proof {
  const plan::CertifiedPrecondition& claim;
  // True if the expression is a number: the planner computed it for all errors together. It then
  // has no value for single errors, and nothing is known about the effect of one variable.
  bool is_number = false;
  double nominal = 0;                   // value in the middle of all ranges
  std::optional<double> at_worst = {};  // value at the worst corner, if one is stated
  std::vector<std::string> terms = {};  // terms of the expression; those that vary most come first
  std::vector<VariableInProof> variables = {};  // variables with a cost, by cost
  // The mildest narrowing of one variable that proves the precondition; missing if it is proved.
  std::optional<NarrowedVariable> remedy = {};

  // Returns whether the worst corner shows that the precondition is false.
  bool IsRefuted() const;
};

// The expressions of one certificate, parsed from their texts.
class CertificateProofs {
 public:
  // `file` is the plan's path. Throws InputError as CertificateAlgebra does.
  CertificateProofs(const plan::PlannedStep& step, const std::string& file);

  Proof Of(const plan::CertifiedPrecondition& claim) const;
  // Returns the precondition's expression as a sum, in full.
  std::string ExpressionText(const plan::CertifiedPrecondition& claim) const;
  // Returns whether the precondition's expression is a number (Proof::is_number).
  bool IsNumber(const plan::CertifiedPrecondition& claim) const;

 private:
  CertificateAlgebra algebra_;
};

}  // namespace assay::verify
