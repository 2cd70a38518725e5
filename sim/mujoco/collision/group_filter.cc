#include "sim/mujoco/collision/group_filter.h"

#include <mujoco/mujoco.h>

#include <mutex>

#include "planner/base/check.h"

namespace assay::mujoco {
namespace {

thread_local std::span<const int> present_groups;

int LeavesOut(const mjModel* m, mjData*, int geom1, int geom2) {
  if (!BitsMatch(*m, geom1, geom2)) return 1;
  if (present_groups.empty()) return 0;
  const auto group = [&](int geom) {
    return present_groups[static_cast<std::size_t>(m->geom_bodyid[geom])];
  };
  return group(geom1) == group(geom2) ? 1 : 0;
}

}  // namespace

bool BitsMatch(const mjModel& m, int geom1, int geom2) {
  return (m.geom_contype[geom1] & m.geom_conaffinity[geom2]) != 0 ||
         (m.geom_contype[geom2] & m.geom_conaffinity[geom1]) != 0;
}

// The engine has one filter for all models of the process.
GroupFilter::GroupFilter(std::span<const int> groups) {
  static std::once_flag once;
  std::call_once(once, [] { mjcb_contactfilter = LeavesOut; });
  ASSAY_CHECK(present_groups.empty(), "filters are not nested");
  present_groups = groups;
}

GroupFilter::~GroupFilter() { present_groups = {}; }

}  // namespace assay::mujoco
