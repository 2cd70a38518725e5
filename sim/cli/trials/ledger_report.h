#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "sim/check/trial/ledger.h"

namespace assay::cli {

// A row for each channel, in millimetres and degrees; "-" where there is nothing to tell.
std::string Text(const std::vector<check::LedgerEntry>& ledger);

// The same for programs, in SI; null where there is nothing to tell.
nlohmann::ordered_json ToJson(const std::vector<check::LedgerEntry>& ledger);

}  // namespace assay::cli
