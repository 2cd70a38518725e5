#pragma once

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "sim/execution/trace/trace.h"
#include "tests/oracle/json_schema.h"

namespace assay::execution {

inline nlohmann::json TraceSchemaFile() {
  std::ifstream file(ASSAY_SOURCE_DIR "/sim/execution/trace/trace.schema.json");
  return nlohmann::json::parse(file);
}

inline std::vector<nlohmann::json> Lines(const Trace& trace) {
  std::stringstream text;
  WriteTrace(trace, text);
  std::vector<nlohmann::json> lines;
  for (std::string line; std::getline(text, line);) lines.push_back(nlohmann::json::parse(line));
  return lines;
}

// Returns the breaches of the schema by the trace's lines. Empty means valid.
inline std::vector<std::string> SchemaErrors(const Trace& trace) {
  const oracle::JsonSchema schema(TraceSchemaFile());
  std::vector<std::string> errors;
  for (const nlohmann::json& line : Lines(trace)) {
    for (const std::string& error : schema.Errors(line)) errors.push_back(error + line.dump());
  }
  return errors;
}

}  // namespace assay::execution
