#pragma once

#include "planner/algebra/expression/expression.h"
#include "planner/base/random.h"

namespace assay::workloads {

// How far the errors of a chain of transforms can go, on both sides.
struct ErrorBounds {
  double angle = 0.096;  // radians: 5.5 degrees
  double displacement = 0.11;
};
inline constexpr ErrorBounds kWideErrors = {.angle = 0.5236, .displacement = 0.5};     // 30 degrees
inline constexpr ErrorBounds kArmErrors = {.angle = 0.001745, .displacement = 0.001};  // 0.1 degree

// Expressions as uncertain poses make them: one coordinate of a point that is carried through a
// product of `links` random transforms, each with errors of its own, which are declared in the
// pool. The pool must hold no other chain.

// Of Trans(x + dx, y + dy) RotZ(angle + error).
algebra::Expression PlanarChain(int links, const ErrorBounds& errors, RandomStream& random,
                                algebra::ExpressionPool& pool);

// Of Trans(x + dx, y + dy, z + dz) Rot(angle + error), about the axes z, x, y, z, ... in turn.
algebra::Expression SpatialChain(int links, const ErrorBounds& errors, RandomStream& random,
                                 algebra::ExpressionPool& pool);

// Of T^-1 T, where T is a planar chain: the errors cancel, whatever they are, up to one more
// displacement, so that the true range is 2 * errors.displacement wide.
algebra::Expression CancellingChain(int links, const ErrorBounds& errors, RandomStream& random,
                                    algebra::ExpressionPool& pool);

// y(P1^-1 C1) of Spar's worked example, in inches and radians ("Satisfying Uncertainty-Reduction
// Goals"; the angles' bounds are degrees), whose least value is 3.279336.
algebra::Expression SparPrecondition(algebra::ExpressionPool& pool);

}  // namespace assay::workloads
