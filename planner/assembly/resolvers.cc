#include "planner/assembly/resolvers.h"

#include <algorithm>

#include "planner/assembly/fine_motion_resolver.h"
#include "planner/base/check.h"
#include "planner/constraint_posting/resolvers/sensing_resolver.h"
#include "planner/constraint_posting/resolvers/squeezing_resolver.h"

namespace assay::assembly {
namespace {

std::shared_ptr<constraint_posting::Resolver> ResolverOf(domain::ResolverKind kind,
                                                         uncertainty::Propagation propagation) {
  switch (kind) {
    case domain::ResolverKind::kSensing:
      return std::make_shared<constraint_posting::SensingResolver>();
    case domain::ResolverKind::kSqueezing:
      return std::make_shared<constraint_posting::SqueezingResolver>();
    case domain::ResolverKind::kFineMotion:
      return std::make_shared<FineMotionResolver>(propagation);
  }
  ASSAY_CHECK(false, "a resolver that the switch does not know");
  return nullptr;
}

}  // namespace

std::vector<std::shared_ptr<constraint_posting::Resolver>> Resolvers(
    const std::vector<domain::ResolverKind>& kinds, uncertainty::Propagation propagation) {
  std::vector<domain::ResolverKind> in_order = kinds;
  std::ranges::sort(in_order);
  std::vector<std::shared_ptr<constraint_posting::Resolver>> resolvers;
  for (const domain::ResolverKind kind : in_order) {
    resolvers.push_back(ResolverOf(kind, propagation));
  }
  return resolvers;
}

}  // namespace assay::assembly
