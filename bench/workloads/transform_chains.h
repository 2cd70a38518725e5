#pragma once

#include "planner/algebra/expression/expression.h"
#include "planner/base/random.h"

namespace assay::workloads {

// Bounds of the errors in a chain of transforms, on both sides of 0.
struct ErrorBounds {
  double angle = 0.096;  // radians: 5.5 degrees
  double displacement = 0.11;
};
inline constexpr ErrorBounds kWideErrors = {.angle = 0.5236, .displacement = 0.5};     // 30 degrees
inline constexpr ErrorBounds kArmErrors = {.angle = 0.001745, .displacement = 0.001};  // 0.1 degree

// The functions below return expressions of the form that uncertain poses have: one coordinate of a
// point that is carried through a product of `links` random transforms. Each transform has errors
// of its own, which are declared in the pool. The pool must hold no other chain.

// Returns a chain of transforms Trans(x + dx, y + dy) RotZ(angle + error).
algebra::Expression PlanarChain(int links, const ErrorBounds& errors, RandomStream& random,
                                algebra::ExpressionPool& pool);

// Returns a chain of transforms Trans(x + dx, y + dy, z + dz) Rot(angle + error), with the axes z,
// x, y, z, ... in turn.
algebra::Expression SpatialChain(int links, const ErrorBounds& errors, RandomStream& random,
                                 algebra::ExpressionPool& pool);

// Returns a chain T^-1 T, where T is a planar chain. The errors cancel up to one more displacement,
// so the true range is 2 * errors.displacement wide.
algebra::Expression CancellingChain(int links, const ErrorBounds& errors, RandomStream& random,
                                    algebra::ExpressionPool& pool);

// Returns y(P1^-1 C1) of Spar's worked example, in inches and radians ("Satisfying
// Uncertainty-Reduction Goals"; the bounds of the angles are in degrees). Its least value is
// 3.279336.
algebra::Expression SparPrecondition(algebra::ExpressionPool& pool);

}  // namespace assay::workloads
