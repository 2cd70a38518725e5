#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "planner/base/budget.h"
#include "planner/base/document/document.h"
#include "planner/network/network/counters.h"
#include "planner/network/network/network.h"

namespace assay::network {

// A network whose nodes and labels have names.
struct NamedNetwork {
  Network network;                               // not yet checked for consistency
  std::vector<std::string> nodes;                // by node index
  std::vector<std::vector<std::string>> labels;  // by node index, then by label
};

// Reads a network, in JSON or YAML:
//   {"nodes": {"v": ["a", "b"], "w": 3},
//    "arcs": [{"between": ["v", "w"], "pairs": [["a", 0], ["b", 2]]}]}
// A node has a list of labels, or a count n for the labels 0 .. n - 1. An arc has the allowed
// `pairs` or the `forbidden` ones, first node first. A pair may name a label that its node does not
// have if all labels of the node are numbers and this is one, too: the list is then a choice among
// more labels, and the pair says nothing. Throws InputError with the place of anything else that
// is wrong: an unknown node or label, a name or label given twice, more labels than kMaxLabels.
NamedNetwork ReadNetwork(const Document& document);
NamedNetwork LoadNetwork(const std::filesystem::path& file);

enum class LabelRequest { kFirst, kAll, kCount };

using NamedLabeling = std::vector<std::pair<std::string, std::string>>;  // node and label

// The answer of `assay label`.
struct LabelReport {
  Outcome outcome = Outcome::kNone;
  std::vector<NamedLabeling> labelings;  // at most one for kFirst; none for kCount
  std::optional<std::uint64_t> count;    // for kAll and kCount; kManyLabelings: as many or more
  Counters counters;
};

LabelReport LabelNetwork(const NamedNetwork& named, LabelRequest request, Budget& budget);
NamedLabeling NameLabels(const NamedNetwork& named, const Labeling& labeling);

}  // namespace assay::network
