#include "sim/exec/execution.h"

namespace assay::exec {

Progress Run(const Look& look, std::span<const Command>, Execution& execution) {
  const Moment now = execution.Now();
  execution.trace().events.push_back(LookRecord{.time = now.time,
                                                .part = look.part,
                                                .sensor = look.sensor,
                                                .believed = now.parts[look.part.index()].believed});
  return std::nullopt;
}

}  // namespace assay::exec
