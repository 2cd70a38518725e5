#include "planner/network/constraint_network/support.h"

#include <bit>

#ifdef ASSAY_HAS_TARGETS
#include <immintrin.h>
#endif

namespace assay::network {

ASSAY_TARGET("default") Word Supported(const Word* supports, Word labels, Word others) {
  Word supported = 0;
  for (Word rest = labels; rest != 0; rest &= rest - 1) {
    const int label = std::countr_zero(rest);
    supported |= Word{(supports[label] & others) != 0} << label;
  }
  return supported;
}

#ifdef ASSAY_HAS_TARGETS
// Tests eight labels at once.
ASSAY_TARGET("avx512f,bmi2") Word Supported(const Word* supports, Word labels, Word others) {
  const __m512i wanted = _mm512_set1_epi64(static_cast<long long>(others));
  const auto of_eight = [&](int first) __attribute__((target("avx512f,bmi2"))) {
    const auto eight = static_cast<__mmask8>(labels >> first);
    const __m512i words = _mm512_maskz_loadu_epi64(eight, supports + first);
    return Word{_mm512_mask_test_epi64_mask(eight, words, wanted)} << first;
  };
  Word supported = of_eight(0) | of_eight(8);
  for (int first = 16; first < kWordBits && labels >> first != 0; first += 16) {
    supported |= of_eight(first) | of_eight(first + 8);
  }
  return supported;
}
#endif

}  // namespace assay::network
