#include "planner/domain/actions/actions.h"

namespace assay::domain {

const ActionKind kSense{.name = "sense",
                        .summary = "measures the pose of a part that lies free",
                        .arguments = {Argument::kPart, Argument::kSensor, Argument::kPosition},
                        .short_arguments = {Argument::kPart, Argument::kSensor},
                        .needs = {Need::kSensor, Need::kAtPlace, Need::kFree}};

}  // namespace assay::domain
