#pragma once

#include <span>
#include <vector>

namespace assay::algebra {

// A symmetric matrix, dense; only its lower triangle is looked at.
class SymmetricMatrix {
 public:
  // All entries 0; takes the room of the one before.
  void Reset(int size) {
    size_ = size;
    entries_.assign(static_cast<std::size_t>(size) * size, 0);
  }
  int size() const { return size_; }
  // The rows and columns with these numbers, which increase.
  void CopyTo(SymmetricMatrix& part, std::span<const int> numbers) const;
  double& operator()(int i, int j) { return entries_[static_cast<std::size_t>(i) * size_ + j]; }
  double operator()(int i, int j) const {
    return entries_[static_cast<std::size_t>(i) * size_ + j];
  }

 private:
  int size_ = 0;
  std::vector<double> entries_;
};

// Cholesky's factorization, in place; false if the matrix is not positive definite.
bool FactorPositiveDefinite(SymmetricMatrix& m);

// Of a factored matrix: b becomes the solution of m * x = b.
void SolveFactored(const SymmetricMatrix& factor, std::span<double> b);

// Whether every symmetric matrix is positive definite whose entries differ from those of the
// centre by no more than those of the deviation. Rigorous: taking from each diagonal entry the sum
// of its row's deviations gives a matrix that is less than all of them (for a deviation d,
// 2*d*x*y >= -|d|*(x^2 + y^2)); it is positive definite if Cholesky's factorization of it, less
// what rounding can do, comes to an end (Rump 2006, "Verification of positive definiteness").
bool IsSurelyPositiveDefinite(SymmetricMatrix centre, const SymmetricMatrix& deviation);

}  // namespace assay::algebra
