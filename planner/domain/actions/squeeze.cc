#include "planner/domain/actions/actions.h"

namespace assay::domain {

const ActionKind kSqueeze{.name = "squeeze",
                          .summary = "closes the pads on a part and opens them again",
                          .arguments = {Argument::kPart, Argument::kGrasp, Argument::kPosition},
                          .short_arguments = {Argument::kPart, Argument::kGrasp},
                          .needs = {Need::kOpenHand, Need::kAtPlace, Need::kAlone}};

}  // namespace assay::domain
