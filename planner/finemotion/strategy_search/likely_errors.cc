#include "planner/finemotion/strategy_search/likely_errors.h"

#include <map>
#include <tuple>

#include "planner/finemotion/strategy_checks/exact_replay.h"

namespace assay::finemotion {
namespace {

constexpr int kDrawn = 500;        // number of drawn errors
constexpr double kEnlarged = 2;    // factor of the error box from which they are drawn
constexpr int kFewestOfState = 3;  // least number of errors for the mean of an error state

struct ErrorSum {
  PoseChange sum = PoseChange::Zero();
  int count = 0;
};
// A contact or a loss: the index of the motion, the name of the contact, and whether the contact is
// lost.
using ErrorState = std::tuple<std::size_t, std::string, bool>;

std::map<ErrorState, ErrorSum> ErrorStatesOf(const ExactReplay& replay,
                                             const PoseChange& half_widths, std::uint64_t seed) {
  RandomStream random(seed, "errors that lead to error states");
  std::map<ErrorState, ErrorSum> states;
  for (int i = 0; i < kDrawn; ++i) {
    PoseChange shares;
    for (double& share : shares) share = kEnlarged * random.Uniform(-1, 1);
    const auto deviation = DeviationOf(replay, half_widths.cwiseProduct(shares), random);
    if (!deviation) continue;
    const Unwanted& unwanted = deviation->unwanted;
    ErrorSum& state = states[{deviation->motion, Name(unwanted.contact), unwanted.is_loss}];
    state.sum += deviation->error;
    ++state.count;
  }
  return states;
}

}  // namespace

void TellLikelyErrors(const MatingGeometry& geometry, const FineMotionPlan& plan,
                      const FineMotionErrors& errors, const StrategyOptions& options,
                      plan::Strategy& strategy) {
  const ExactReplay replay{.passage = geometry.passage,
                           .X_StationaryStart = plan.X_StationaryStart,
                           .motions = plan.motions,
                           .radius = options.radius,
                           .velocity_error = errors.velocity};
  const auto states = ErrorStatesOf(replay, errors.pose, options.seed);
  for (std::size_t i = 0; i < strategy.motions.size(); ++i) {
    for (plan::UnwantedContact& unwanted : strategy.motions[i].unwanted) {
      const std::string& name = strategy.contacts[static_cast<std::size_t>(unwanted.contact)].name;
      const auto state = states.find({i, name, unwanted.is_loss});
      if (state == states.end() || state->second.count < kFewestOfState) continue;
      const PoseChange mean = state->second.sum / state->second.count;
      unwanted.likely = {mean.head<3>(), mean.tail<3>()};
    }
  }
}

}  // namespace assay::finemotion
