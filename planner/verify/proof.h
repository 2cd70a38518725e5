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
  Interval range;
  std::optional<double> worst;  // its value at the worst corner
  double cost = 0;              // by how much the bound would improve, were its value known
};

// A variable's range, before and after it is narrowed enough.
struct NarrowedVariable {
  std::string name;
  Interval range;
  Interval enough;
};

// What can be computed from a certified precondition and the variables of its certificate.
struct Proof {
  const plan::CertifiedPrecondition& claim;
  double nominal = 0;                           // value in the middle of all ranges
  std::optional<double> at_worst = {};          // value at the worst corner, if one is stated
  std::vector<std::string> terms = {};          // of the expression, those that vary most first
  std::vector<VariableInProof> variables = {};  // those that cost anything, by cost
  std::optional<NarrowedVariable> remedy = {};  // the mildest that proves it alone; none if proved

  // Whether the worst corner shows that the precondition is false.
  bool IsRefuted() const;
};

// The expressions of one certificate, read back.
class CertificateProofs {
 public:
  // `file`: where the plan comes from. Throws InputError as CertificateAlgebra does.
  CertificateProofs(const plan::PlannedStep& step, const std::string& file);

  Proof Of(const plan::CertifiedPrecondition& claim) const;
  // Its expression as a sum, in full.
  std::string ExpressionText(const plan::CertifiedPrecondition& claim) const;

 private:
  CertificateAlgebra algebra_;
};

}  // namespace assay::verify
