#include "planner/plan/certificates/error_kind.h"

#include <array>

namespace assay::plan {

std::span<const ErrorKind* const> KnownErrors() {
  using namespace error;
  static constexpr auto kKinds = std::to_array<const ErrorKind*>(
      {&kX, &kY, &kZ, &kTheta, &kSlip, &kRise, &kTwist, &kGive, &kJam, &kSkew, &kTip, &kSettle,
       &kYield, &kPlay, &kTurn, &kDrag, &kThetaDrag, &kRest, &kThetaRest});
  return kKinds;
}

const ErrorKind* ErrorKindOf(std::string_view variable) {
  const ErrorKind* longest = nullptr;
  for (const ErrorKind* kind : KnownErrors()) {
    const bool fits = variable.size() > kind->stem.size() && variable.starts_with(kind->stem) &&
                      variable[kind->stem.size()] == '_';
    if (fits && (longest == nullptr || kind->stem.size() > longest->stem.size())) longest = kind;
  }
  return longest;
}

}  // namespace assay::plan
