#include "planner/constraint_posting/uncertainty_phase/subject.h"

namespace assay::constraint_posting {
namespace {

using domain::PartId;

struct PartsHandled {
  const domain::Problem& problem;

  std::vector<PartId> operator()(const plan::Assemble& assemble) const {
    const domain::Mating& mating = problem.mating(assemble.mating);
    return {mating.held, mating.fixed};
  }
  std::vector<PartId> operator()(const auto& action) const { return {action.part}; }
};

}  // namespace

std::vector<PartId> HandledParts(const domain::Problem& problem, const plan::Action& action) {
  return std::visit(PartsHandled{problem}, action);
}

Subject SubjectOf(const domain::Problem& problem, const plan::Action& action) {
  return {action.index(), HandledParts(problem, action)};
}

}  // namespace assay::constraint_posting
