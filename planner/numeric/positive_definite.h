#pragma once

#include <span>
#include <vector>

namespace assay::numeric {

// A dense symmetric matrix. Only its lower triangle is read.
class SymmetricMatrix {
 public:
  // Sets the size and makes all entries 0. The memory is reused.
  void Reset(int size) {
    size_ = size;
    entries_.assign(static_cast<std::size_t>(size) * size, 0);
  }
  int size() const { return size_; }
  // Copies the rows and columns with the given numbers, which must increase, to `part`.
  void CopyTo(SymmetricMatrix& part, std::span<const int> numbers) const;
  double& operator()(int i, int j) { return entries_[static_cast<std::size_t>(i) * size_ + j]; }
  double operator()(int i, int j) const {
    return entries_[static_cast<std::size_t>(i) * size_ + j];
  }

 private:
  int size_ = 0;
  std::vector<double> entries_;
};

// Computes Cholesky's factorization in place. Returns false if the matrix is not positive definite.
bool FactorPositiveDefinite(SymmetricMatrix& m);

// Solves m * x = b, where `factor` is the factored matrix m. The solution replaces b.
void SolveFactored(const SymmetricMatrix& factor, std::span<double> b);

// Returns true only if each symmetric matrix within `deviation` of `centre`, entry by entry, is
// positive definite. The test is rigorous. It subtracts the sum of each row's deviations from the
// diagonal entry of `centre`. In the order of definiteness, the resulting matrix is below every
// matrix in this range, because 2*d*x*y >= -|d|*(x^2 + y^2) for a deviation d. It is positive
// definite if Cholesky's factorization still succeeds after a bound of the rounding errors is
// subtracted (Rump 2006, "Verification of positive definiteness").
bool IsSurelyPositiveDefinite(SymmetricMatrix centre, const SymmetricMatrix& deviation);

}  // namespace assay::numeric
