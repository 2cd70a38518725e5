#include "planner/network/constraint_network/network_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>

#include "planner/network/labeling/count.h"
#include "planner/network/labeling/search.h"

namespace assay::network {
namespace {

bool IsNumber(const std::string& text) {
  return !text.empty() &&
         std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

// A list of names that finds the place of a name. No name may be given twice.
class NameIndex {
 public:
  void Add(const Value& value) {
    const std::string name = value.Text();
    if (!indices_.emplace(name, std::ssize(names_)).second) {
      value.Fail(fmt::format("'{}' is given twice", name));
    }
    names_.push_back(name);
    numbers_only_ = numbers_only_ && IsNumber(name);
  }
  int Find(const std::string& name) const {
    const auto found = indices_.find(name);
    return found == indices_.end() ? -1 : static_cast<int>(found->second);
  }
  bool numbers_only() const { return numbers_only_; }
  const std::vector<std::string>& names() const { return names_; }

 private:
  std::vector<std::string> names_;
  std::unordered_map<std::string, std::ptrdiff_t> indices_;
  bool numbers_only_ = true;
};

// The labels of one node as the file gives them.
struct LabelNames {
  enum class Kind { kListed, kCounted } kind = Kind::kListed;
  NameIndex listed;
  int count = 0;
};

LabelNames ReadLabels(const Value& value) {
  if (value.IsScalar()) {
    return {
        .kind = LabelNames::Kind::kCounted, .listed = {}, .count = value.Integer(0, kMaxLabels)};
  }
  LabelNames labels;
  for (const Value& label : value.Items()) labels.listed.Add(label);
  labels.count = static_cast<int>(labels.listed.names().size());
  if (labels.count > kMaxLabels) {
    value.Fail(fmt::format("{} labels", labels.count), fmt::format("at most {}", kMaxLabels));
  }
  return labels;
}

std::vector<std::string> NamesOf(const LabelNames& labels) {
  if (labels.kind == LabelNames::Kind::kListed) return labels.listed.names();
  std::vector<std::string> names;
  for (int label = 0; label < labels.count; ++label) names.push_back(std::to_string(label));
  return names;
}

// Returns nothing for a number that is missing from the node's list of numbers.
std::optional<Label> ReadLabel(const Value& value, const LabelNames& labels) {
  if (labels.kind == LabelNames::Kind::kCounted) return value.Integer(0, labels.count - 1);
  const std::string name = value.Text();
  const int label = labels.listed.Find(name);
  if (label >= 0) return label;
  if (labels.listed.numbers_only() && IsNumber(name)) return std::nullopt;
  return value.OneOf(labels.listed.names());  // reports an error and suggests the nearest name
}

std::pair<Value, Value> ReadTwo(const Value& value, std::string_view what) {
  const std::vector<Value> items = value.Items();
  if (items.size() != 2) value.Fail(fmt::format("{} of {}", what, items.size()), "exactly two");
  return {items[0], items[1]};
}

std::vector<LabelPair> ReadPairs(const Value& value, const LabelNames& rows,
                                 const LabelNames& columns) {
  std::vector<LabelPair> pairs;
  for (const Value& item : value.Items()) {
    const auto [first, second] = ReadTwo(item, "a pair");
    const std::optional<Label> row = ReadLabel(first, rows);
    const std::optional<Label> column = ReadLabel(second, columns);
    if (row.has_value() && column.has_value()) pairs.emplace_back(*row, *column);
  }
  return pairs;
}

std::shared_ptr<const Relation> ReadRelation(const Value& arc, const LabelNames& rows,
                                             const LabelNames& columns) {
  const std::optional<Value> allowed = arc.Find("pairs"), forbidden = arc.Find("forbidden");
  if (allowed.has_value() == forbidden.has_value()) {
    arc.Fail("an arc with both kinds of pairs or none", "either 'pairs' or 'forbidden'");
  }
  return allowed.has_value()
             ? Relation::Allowing(rows.count, columns.count, ReadPairs(*allowed, rows, columns))
             : Relation::Forbidding(rows.count, columns.count,
                                    ReadPairs(*forbidden, rows, columns));
}

class NetworkReader {
 public:
  NamedNetwork Read(const Value& root) {
    root.AllowOnly({"format", "nodes", "arcs"});
    for (const auto& [name, labels] : root.At("nodes").Entries()) ReadNode(name, labels);
    if (const std::optional<Value> arcs = root.Find("arcs")) {
      for (const Value& arc : arcs->Items()) ReadArc(arc);
    }
    named_.nodes = names_.names();
    return std::move(named_);
  }

 private:
  void ReadNode(const Value& name, const Value& value) {
    names_.Add(name);
    labels_.push_back(ReadLabels(value));
    named_.labels.push_back(NamesOf(labels_.back()));
    named_.network.AddNode(LabelSet::All(labels_.back().count));
  }

  void ReadArc(const Value& arc) {
    arc.AllowOnly({"between", "pairs", "forbidden"});
    const auto [first, second] = ReadTwo(arc.At("between"), "an arc between a list");
    const int a = ReadNodeName(first), b = ReadNodeName(second);
    named_.network.AddArc(NodeId(a), NodeId(b), ReadRelation(arc, labels_[a], labels_[b]));
  }

  int ReadNodeName(const Value& value) const {
    const int node = names_.Find(value.Text());
    return node >= 0 ? node : value.OneOf(names_.names());
  }

  NameIndex names_;
  std::vector<LabelNames> labels_;
  NamedNetwork named_;
};

NamedLabeling NameLabels(const NamedNetwork& named, const Labeling& labeling) {
  NamedLabeling names;
  for (std::size_t node = 0; node < named.nodes.size(); ++node) {
    names.emplace_back(named.nodes[node], named.labels[node][labeling.labels[node]]);
  }
  return names;
}

}  // namespace

NamedNetwork ReadNetwork(const Document& document) { return NetworkReader().Read(document.root()); }

NamedNetwork LoadNetwork(const std::filesystem::path& file) {
  return ReadNetwork(Document::Load(file));
}

LabelReport LabelNetwork(const NamedNetwork& named, LabelRequest request, Budget& budget) {
  LabelReport report;
  switch (request) {
    case LabelRequest::kFirst: {
      const FirstLabeling first = First(named.network, {}, budget);
      report = {first.outcome, {}, {}, first.counters};
      if (first.outcome == Outcome::kFound) {
        report.labelings.push_back(NameLabels(named, first.labeling));
      }
      return report;
    }
    case LabelRequest::kAll: {
      const AllLabelings all = All(named.network, {}, budget);
      report = {all.outcome, {}, all.labelings.size(), all.counters};
      for (const Labeling& labeling : all.labelings) {
        report.labelings.push_back(NameLabels(named, labeling));
      }
      return report;
    }
    case LabelRequest::kCount: {
      const LabelingCount count = Count(named.network, budget);
      report = {count.outcome, {}, {}, count.counters};
      if (count.outcome != Outcome::kBudget) report.count = count.count;
      return report;
    }
  }
  return report;
}

}  // namespace assay::network
