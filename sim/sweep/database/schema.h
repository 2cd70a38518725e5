#pragma once

#include <string>

#include "planner/domain/units/units.h"
#include "sim/sweep/database/database.h"

namespace assay::sweep {

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
