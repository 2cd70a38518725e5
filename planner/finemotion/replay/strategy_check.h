#pragma once

#include <string>
#include <vector>

#include "planner/finemotion/contacts/mating.h"

namespace assay::finemotion {

// What in a strategy does not hold up, found out by doing it anew: from the parts and the strategy
// with its certificate alone. The flaws name motion and
// contact. Found are
//
// - a tip, or a seat, that is not the mating's, and contacts that the parts have not;
// - a start that is not surely reached, motions that are not certain, and an end from which the way
//   in is not free: with the errors, and with as many times the errors as it is said to absorb;
// - contacts that are said to be elsewhere, to press otherwise or to be wider open than they are
//   where their motion leads, and motions that end before their contact surely comes;
// - contacts that happen with smaller errors than is said, or of which nothing is said;
// - motions that go otherwise in exact geometry with one of the errors that the search replays with
//   (exact_replay.h: without tolerances), as many times as great as the strategy is said to absorb.
//
// Where a motion is not certain, nothing is told of those after it. Errors are taken a thousandth
// smaller than they are, so that rounded numbers make no flaw. Requires a strategy of which
// plan::FlawsOfForm finds nothing.
std::vector<std::string> FlawsOfStrategy(const MatingGeometry& geometry,
                                         const plan::Strategy& strategy);

}  // namespace assay::finemotion
