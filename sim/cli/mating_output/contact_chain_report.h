#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "planner/finemotion/contact_graph/contact_chain.h"
#include "sim/check/contact_sequences/contact_sequence.h"

namespace assay::cli {

// TextOf and ToJson report the contact graphs for `assay mate`. The text is a table for people,
// with a row for each critical point and the number of the strategy's contact states that the
// graphs have. The JSON has the fields "graph" and "graphs" of mate.schema.json.
std::string TextOf(const finemotion::ContactChain& chain, const finemotion::FineMotionPlan& plan);
nlohmann::ordered_json ToJson(const finemotion::ContactChain& chain,
                              const finemotion::FineMotionPlan& plan);

}  // namespace assay::cli
