#include "planner/domain/actions/actions.h"

namespace assay::domain {

const ActionKinds& StandardActions() {
  static const ActionKinds kinds = {&kPickup, &kPutdown, &kAssemble, &kSense, &kSqueeze};
  return kinds;
}

}  // namespace assay::domain
