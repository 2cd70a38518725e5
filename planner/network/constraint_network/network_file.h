#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "planner/base/budget.h"
#include "planner/base/input_files/document.h"
#include "planner/network/constraint_network/counters.h"
#include "planner/network/constraint_network/network.h"

namespace assay::network {

// A network whose nodes and labels have names.
struct NamedNetwork {
  Network network;                               // not yet checked for consistency
  std::vector<std::string> nodes;                // indexed by node index
  std::vector<std::vector<std::string>> labels;  // indexed by node index, then by label
};

// Reads a network in JSON or YAML, for example:
//   {"nodes": {"v": ["a", "b"], "w": 3},
//    "arcs": [{"between": ["v", "w"], "pairs": [["a", 0], ["b", 2]]}]}
// A node has a list of labels, or a count n for the labels 0 .. n - 1. An arc has the allowed
// `pairs` or the `forbidden` ones; each pair names the label of the first node first. If all labels
// of a node are numbers, a pair may name another number, too: the list of labels is then a
// selection, and the pair has no effect. Throws InputError, with its place, for any other error: an
// unknown node or label, a name or label given twice, more labels than kMaxLabels.
NamedNetwork ReadNetwork(const Document& document);
NamedNetwork LoadNetwork(const std::filesystem::path& file);

enum class LabelRequest { kFirst, kAll, kCount };

using NamedLabeling = std::vector<std::pair<std::string, std::string>>;  // node and label

// The answer of `assay label`.
struct LabelReport {
  Outcome outcome = Outcome::kNone;
  std::vector<NamedLabeling> labelings;  // at most one for kFirst; empty for kCount
  std::optional<std::uint64_t> count;    // only for kAll and kCount; may be kManyLabelings
  Counters counters;
};

LabelReport LabelNetwork(const NamedNetwork& named, LabelRequest request, Budget& budget);

}  // namespace assay::network
