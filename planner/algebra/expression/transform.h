#pragma once

#include <array>

#include "planner/algebra/expression/expression.h"

namespace assay::algebra {

using SymbolicVector = std::array<Expression, 3>;

// A rigid transform with symbolic entries. It holds the upper three rows of the papers' 4x4
// matrices.
struct Transform {
  std::array<std::array<Expression, 3>, 3> rotation = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};  // rows
  SymbolicVector translation = {0, 0, 0};
};

Transform Translation(const SymbolicVector& t);
Transform RotationX(const Expression& angle);
Transform RotationY(const Expression& angle);
Transform RotationZ(const Expression& angle);

Transform operator*(const Transform& a, const Transform& b);
SymbolicVector operator*(const Transform& a, const SymbolicVector& point);
// Returns the symbolic transform (R^t, -R^t t) for a = (R, t). It is the inverse only if R is a
// rotation.
Transform Inverse(const Transform& a);

SymbolicVector operator+(const SymbolicVector& a, const SymbolicVector& b);
SymbolicVector operator-(const SymbolicVector& a, const SymbolicVector& b);
Expression Dot(const SymbolicVector& a, const SymbolicVector& b);

// Return the symbolic transform or vector with each entry simplified.
Transform Simplify(const Transform& a);
SymbolicVector Simplify(const SymbolicVector& a);

}  // namespace assay::algebra
