#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "sim/check/trial_verdicts/ledger.h"

namespace assay::cli {

// Returns a text for people: a row for each channel of the noise, in millimetres and degrees, with
// "-" for missing values.
std::string Text(const std::vector<check::LedgerEntry>& ledger);

// Returns the ledger for programs, in SI units, with null for missing values.
nlohmann::ordered_json ToJson(const std::vector<check::LedgerEntry>& ledger);

}  // namespace assay::cli
