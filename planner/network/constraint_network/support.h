#pragma once

#include "planner/network/constraint_network/label_set.h"

// If the compiler supports several targets, the loader chooses the best one for the processor.
#if defined(__x86_64__) && defined(__GNUC__)
#define ASSAY_TARGET(name) __attribute__((target(name)))
#define ASSAY_HAS_TARGETS
#else
#define ASSAY_TARGET(name)
#endif

namespace assay::network {

// Returns the labels of `labels` that have a support in `others`. Each of the two sets fits into
// one 64-bit word. `supports` has one such word for each label.
ASSAY_TARGET("default") Word Supported(const Word* supports, Word labels, Word others);
#ifdef ASSAY_HAS_TARGETS
ASSAY_TARGET("avx512f,bmi2") Word Supported(const Word* supports, Word labels, Word others);
#endif

}  // namespace assay::network
