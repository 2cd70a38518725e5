#pragma once

#include <string>

#include "planner/domain/units/units.h"
#include "sim/sweep/database/database.h"

namespace assay::sweep {

// What happens to a claim that a table has already. A claim about several preconditions of one name
// has in each trial the limits of the one that came nearest to failing. The table has the widest
// limits of all trials, whatever their order. NULL stands for an infinite limit.
inline constexpr char kWidenClaim[] =
    "ON CONFLICT DO UPDATE SET low = min(low, excluded.low), high = max(high, excluded.high)";

// Makes the tables of a new database, and marks it as one of this program and of this version of
// the format.
void MakeTables(Database& database);

// Throws InputError unless the database is an undamaged one of this program and of this version of
// the format, with all tables and with contents that obey the rules: the types of the columns, the
// keys of other tables, and rules for single tables.
void RequireSchema(const Database& database);

// Returns the dimension that the column `unit` of a table names. Throws InputError if it names
// none.
domain::Dimension DimensionNamed(const std::string& unit);

}  // namespace assay::sweep
