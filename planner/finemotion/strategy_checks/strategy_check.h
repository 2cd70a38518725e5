#pragma once

#include <string>
#include <vector>

#include "planner/finemotion/strategy_search/mating.h"

namespace assay::finemotion {

// Returns the flaws of a strategy, found by replaying it from the parts and the strategy with its
// certificate alone. Each flaw names its motion and contact. The check finds:
//
// - a tip or a seat that is not the mating's, and contacts that the parts do not have;
// - a start that is not surely reached, motions that are not certain, and an end from which the way
//   in is not free, with the errors of the certificate and with the multiple of these errors that
//   the strategy claims to absorb;
// - contacts that, at the end of their motion, are at another place, press in another direction or
//   are less open than claimed, and motions that may end before their contact is made;
// - contacts that happen with smaller errors than claimed, or that the strategy does not mention;
// - motions that deviate in exact geometry with one of the errors that the search replays with
//   (exact_replay.h: without tolerances), multiplied by what the strategy claims to absorb.
//
// After a motion that is not certain, later motions are not checked. Errors are reduced by a
// thousandth, so that rounded numbers are no flaws. plan::FlawsOfForm must find nothing in the
// strategy.
std::vector<std::string> FlawsOfStrategy(const MatingGeometry& geometry,
                                         const plan::Strategy& strategy);

}  // namespace assay::finemotion
