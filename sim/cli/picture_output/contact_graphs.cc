#include "sim/cli/picture_output/contact_graphs.h"

#include <algorithm>

#include "sim/check/contact_sequences/contact_sequence.h"
#include "sim/report/fine_motion/contact_graph_picture.h"

namespace assay::cli {
namespace {

// Returns the plan's motions at a critical point.
report::MotionRange MotionsAt(const finemotion::FineMotionPlan& plan, std::size_t critical_point) {
  const auto at = [&](const auto& of) {
    return static_cast<std::size_t>(of(plan.motions, static_cast<int>(critical_point), {},
                                       &finemotion::CertainMotion::critical_point) -
                                    plan.motions.begin());
  };
  return {at(std::ranges::lower_bound), at(std::ranges::upper_bound)};
}

}  // namespace

std::vector<report::Element> ContactGraphs(const finemotion::ContactChain& chain,
                                           const finemotion::FineMotionPlan& plan) {
  const check::PlannedContacts planned = check::PlannedContactsOf(plan);
  std::vector<report::Element> graphs;
  for (std::size_t i = 0; i < chain.points.size(); ++i)
    graphs.push_back(report::ContactGraphPicture(chain.points[i], planned, MotionsAt(plan, i)));
  return graphs;
}

}  // namespace assay::cli
