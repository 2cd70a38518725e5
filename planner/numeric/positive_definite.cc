#include "planner/numeric/positive_definite.h"

#include <algorithm>
#include <cmath>

namespace assay::numeric {

void SymmetricMatrix::CopyTo(SymmetricMatrix& part, std::span<const int> numbers) const {
  const int n = static_cast<int>(numbers.size());
  part.Reset(n);
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j <= i; ++j) part(i, j) = (*this)(numbers[i], numbers[j]);
  }
}

bool FactorPositiveDefinite(SymmetricMatrix& m) {
  const int n = m.size();
  for (int j = 0; j < n; ++j) {
    for (int k = 0; k < j; ++k) m(j, j) -= m(j, k) * m(j, k);
    if (!(m(j, j) > 0)) return false;
    m(j, j) = std::sqrt(m(j, j));
    for (int i = j + 1; i < n; ++i) {
      for (int k = 0; k < j; ++k) m(i, j) -= m(i, k) * m(j, k);
      m(i, j) /= m(j, j);
    }
  }
  return true;
}

void SolveFactored(const SymmetricMatrix& factor, std::span<double> b) {
  const int n = factor.size();
  for (int i = 0; i < n; ++i) {
    for (int k = 0; k < i; ++k) b[i] -= factor(i, k) * b[k];
    b[i] /= factor(i, i);
  }
  for (int i = n - 1; i >= 0; --i) {
    for (int k = i + 1; k < n; ++k) b[i] -= factor(k, i) * b[k];
    b[i] /= factor(i, i);
  }
}

bool IsSurelyPositiveDefinite(SymmetricMatrix centre, const SymmetricMatrix& deviation) {
  const int n = centre.size();
  double trace = 0;
  for (int i = 0; i < n; ++i) trace += std::abs(centre(i, i));
  // Four times the greatest effect of n + 2 roundings.
  const double rounding = 4 * (n + 2) * 0x1p-53 * trace + 1e-290;
  for (int i = 0; i < n; ++i) {
    double sum = rounding;
    for (int j = 0; j < n; ++j) sum += deviation(std::max(i, j), std::min(i, j));
    centre(i, i) -= sum * (1 + 1e-12);
  }
  return FactorPositiveDefinite(centre);
}

}  // namespace assay::numeric
