#include "planner/algebra/expression/transform.h"

#include "planner/algebra/expression/simplify.h"

namespace assay::algebra {

namespace {

using Rotation = std::array<std::array<Expression, 3>, 3>;

SymbolicVector Column(const Rotation& r, std::size_t j) { return {r[0][j], r[1][j], r[2][j]}; }

Rotation Transposed(const Rotation& r) { return {Column(r, 0), Column(r, 1), Column(r, 2)}; }

SymbolicVector Rotated(const Rotation& r, const SymbolicVector& v) {
  return {Dot(r[0], v), Dot(r[1], v), Dot(r[2], v)};
}

}  // namespace

Transform Translation(const SymbolicVector& t) { return {.translation = t}; }

Transform RotationX(const Expression& angle) {
  const Expression c = Cos(angle);
  const Expression s = Sin(angle);
  return {.rotation = {{{1, 0, 0}, {0, c, -s}, {0, s, c}}}};
}

Transform RotationY(const Expression& angle) {
  const Expression c = Cos(angle);
  const Expression s = Sin(angle);
  return {.rotation = {{{c, 0, s}, {0, 1, 0}, {-s, 0, c}}}};
}

Transform RotationZ(const Expression& angle) {
  const Expression c = Cos(angle);
  const Expression s = Sin(angle);
  return {.rotation = {{{c, -s, 0}, {s, c, 0}, {0, 0, 1}}}};
}

Transform operator*(const Transform& a, const Transform& b) {
  Transform product = {.translation = a * b.translation};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      product.rotation[i][j] = Dot(a.rotation[i], Column(b.rotation, j));
    }
  }
  return product;
}

SymbolicVector operator*(const Transform& a, const SymbolicVector& point) {
  return Rotated(a.rotation, point) + a.translation;
}

Transform Inverse(const Transform& a) {
  const Rotation back = Transposed(a.rotation);
  return {.rotation = back, .translation = SymbolicVector{0, 0, 0} - Rotated(back, a.translation)};
}

SymbolicVector operator+(const SymbolicVector& a, const SymbolicVector& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

SymbolicVector operator-(const SymbolicVector& a, const SymbolicVector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

Expression Dot(const SymbolicVector& a, const SymbolicVector& b) {
  return Sum(std::array{a[0] * b[0], a[1] * b[1], a[2] * b[2]});
}

Transform Simplify(const Transform& a) {
  Transform simple = {.translation = Simplify(a.translation)};
  for (std::size_t i = 0; i < 3; ++i) simple.rotation[i] = Simplify(a.rotation[i]);
  return simple;
}

SymbolicVector Simplify(const SymbolicVector& a) {
  return {Simplify(a[0]), Simplify(a[1]), Simplify(a[2])};
}

}  // namespace assay::algebra
