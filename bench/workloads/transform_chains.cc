#include "bench/workloads/transform_chains.h"

#include <fmt/format.h>

#include <numbers>
#include <string_view>

#include "planner/algebra/expression/transform.h"

namespace assay::workloads {

using algebra::Expression;
using algebra::ExpressionPool;
using algebra::SymbolicVector;
using algebra::Transform;

namespace {

Expression DeclareError(std::string_view name, int link, double bound, ExpressionPool& pool) {
  return pool.Declare(fmt::format("{}{}", name, link), {-bound, bound});
}

Transform RotationAbout(int axis, const Expression& angle) {
  if (axis == 0) return algebra::RotationZ(angle);
  return axis == 1 ? algebra::RotationX(angle) : algebra::RotationY(angle);
}

SymbolicVector RandomOffset(bool is_planar, RandomStream& random) {
  SymbolicVector vector;
  for (Expression& entry : vector) entry = random.Uniform(-3, 3);
  if (is_planar) vector[2] = 0;
  return vector;
}

// Returns a random pose about one axis, followed by an error in the frame of this pose: a turn and
// a displacement.
Transform PlanarLink(int link, const ErrorBounds& errors, RandomStream& random,
                     ExpressionPool& pool) {
  const Expression angle = DeclareError("t", link, errors.angle, pool);
  const Expression x = DeclareError("x", link, errors.displacement, pool);
  const Expression y = DeclareError("y", link, errors.displacement, pool);
  const double heading = random.Uniform(-std::numbers::pi, std::numbers::pi);
  return Translation(RandomOffset(true, random)) * algebra::RotationZ(heading) *
         algebra::Translation({x, y, 0}) * algebra::RotationZ(angle);
}

Transform SpatialLink(int link, const ErrorBounds& errors, RandomStream& random,
                      ExpressionPool& pool) {
  const Expression angle = DeclareError("t", link, errors.angle, pool);
  const Expression x = DeclareError("x", link, errors.displacement, pool);
  const Expression y = DeclareError("y", link, errors.displacement, pool);
  const Expression z = DeclareError("z", link, errors.displacement, pool);
  const double heading = random.Uniform(-std::numbers::pi, std::numbers::pi);
  return Translation(RandomOffset(false, random)) * RotationAbout((link + 1) % 3, heading) *
         algebra::Translation({x, y, z}) * RotationAbout(link % 3, angle);
}

}  // namespace

Expression PlanarChain(int links, const ErrorBounds& errors, RandomStream& random,
                       ExpressionPool& pool) {
  Transform chain;
  for (int link = 0; link < links; ++link) {
    chain = Simplify(chain * PlanarLink(link, errors, random, pool));
  }
  return (chain * RandomOffset(true, random))[1];
}

Expression SpatialChain(int links, const ErrorBounds& errors, RandomStream& random,
                        ExpressionPool& pool) {
  Transform chain;
  for (int link = 0; link < links; ++link) {
    chain = Simplify(chain * SpatialLink(link, errors, random, pool));
  }
  return (chain * RandomOffset(false, random))[2];
}

Expression CancellingChain(int links, const ErrorBounds& errors, RandomStream& random,
                           ExpressionPool& pool) {
  Transform chain;
  for (int link = 0; link < links; ++link) {
    chain = chain * PlanarLink(link, errors, random, pool);
  }
  const Expression extra = DeclareError("extra", 0, errors.displacement, pool);
  const SymbolicVector point = RandomOffset(true, random) + SymbolicVector{extra, 0, 0};
  return (Inverse(chain) * (chain * point))[0];
}

Expression SparPrecondition(ExpressionPool& pool) {
  constexpr double kDegree = std::numbers::pi / 180;
  const Expression tg = pool.Declare("tg", {-0.001 * kDegree, 0.001 * kDegree});
  const Expression to = pool.Declare("to", {-5.5 * kDegree, 5.5 * kDegree});
  const Expression dx = pool.Declare("dx", {-0.11, 0.11});
  const Expression dy = pool.Declare("dy", {-0.11, 0.11});
  const Expression dxg = pool.Declare("dxg", {-0.001, 0.001});
  const Expression dyg = pool.Declare("dyg", {-0.001, 0.001});
  return 2 + Cos(tg) * (3 * Cos(to) - Sin(to) - 1.5 + dx - dyg) +
         Sin(tg) * (1 + dxg - 3 * Sin(to) - Cos(to) - dy);
}

}  // namespace assay::workloads
