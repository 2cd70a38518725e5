#pragma once

#include <array>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

#include "sim/execution/trace/trace.h"

namespace assay::execution {

// A position, a normal and a force.
using ContactRow = std::array<double, 9>;
using RowsByPair = std::map<std::pair<std::string, std::string>, std::vector<ContactRow>>;

// Writes the field `contact_points` of the samples of a trace (trace.schema.json). The numbers are
// rounded, and a sample has only those pairs of bodies whose points differ from the sample before.
// Parts at rest therefore take no space.
class ContactPointWriter {
 public:
  // Returns the field of a sample that has contact points. Samples must come in their order.
  nlohmann::ordered_json FieldOf(const Sample& sample);

 private:
  RowsByPair last_;
};

// Reads what a ContactPointWriter has written, sample by sample.
class ContactPointReader {
 public:
  // Returns the points of the snapshot's contacts. Throws an exception of the JSON library or
  // std::invalid_argument if the field is wrong.
  std::vector<ContactPoint> PointsOf(const Snapshot& snapshot, const nlohmann::json& field);

 private:
  RowsByPair last_;
};

}  // namespace assay::execution
