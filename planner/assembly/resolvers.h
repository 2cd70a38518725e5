#pragma once

#include <memory>
#include <vector>

#include "planner/constraint_posting/resolvers/resolver.h"
#include "planner/domain/problem/problem.h"
#include "planner/uncertainty/error_sets/uncertain_pose.h"

namespace assay::assembly {

// Makes the resolvers that a whole assembly uses, of several planners: those of these kinds, in the
// order sensing, squeezing, fine motion.
std::vector<std::shared_ptr<constraint_posting::Resolver>> Resolvers(
    const std::vector<domain::ResolverKind>& kinds, uncertainty::Propagation propagation);

}  // namespace assay::assembly
