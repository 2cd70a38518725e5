#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "planner/finemotion/graph/contact_chain.h"
#include "sim/check/contacts/contact_sequence.h"

namespace assay::cli {

// What `mate` tells of the contact graphs: for people a table with a row for each critical point
// and how many of the strategy's contact states the graphs have; for programs the fields "graph"
// and "graphs" of mate.schema.json.
std::string TextOf(const finemotion::ContactChain& chain, const finemotion::FineMotionPlan& plan);
nlohmann::ordered_json ToJson(const finemotion::ContactChain& chain,
                              const finemotion::FineMotionPlan& plan);

}  // namespace assay::cli
