#include "bench/workloads/networks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "planner/base/check.h"
#include "planner/network/constraint_network/network_file.h"

namespace assay::workloads {
namespace {

using network::Label;
using network::LabelPair;
using network::LabelSet;
using network::NodeId;
using network::Relation;

// Returns `count` different members of 0 .. size - 1, in random order (Fisher and Yates).
std::vector<int> Draw(int count, int size, RandomStream& random) {
  ASSAY_CHECK(count <= size);
  std::vector<int> all(size);
  for (int i = 0; i < size; ++i) all[i] = i;
  for (int i = 0; i < count; ++i) std::swap(all[i], all[i + random.Index(size - i)]);
  all.resize(count);
  return all;
}

std::shared_ptr<const Relation> RandomRelation(int labels, int forbidden, RandomStream& random) {
  std::vector<LabelPair> pairs;
  for (int cell : Draw(forbidden, labels * labels, random)) {
    pairs.emplace_back(cell / labels, cell % labels);
  }
  return Relation::Forbidding(labels, labels, pairs);
}

std::shared_ptr<const Relation> RandomFraction(int rows, int columns, double fraction,
                                               RandomStream& random) {
  return Relation::Where(rows, columns, [&](Label, Label) { return random.Uniform() < fraction; });
}

// Adds the arcs of a plan network to nodes that are numbered part by part.
class PlanNetworkBuilder {
 public:
  PlanNetworkBuilder(const PlanModel& model, RandomStream& random)
      : model_(model), random_(random) {}

  NetworkWorkload Build() {
    for (int part = 0; part < model_.parts; ++part) AddNodes();
    for (int step = 0; step < model_.steps; ++step) {
      for (int part = 0; part < model_.parts; ++part) AddStep(part, step);
    }
    for (int part = 1; part < model_.parts; ++part) {
      AddReachable(Grasp(part, model_.steps - 1), Pose(part - 1, model_.steps));
    }
    return std::move(workload_);
  }

 private:
  NodeId Pose(int part, int step) const { return NodeId(part * (2 * model_.steps + 1) + 2 * step); }
  NodeId Grasp(int part, int step) const { return NodeId(Pose(part, step).index() + 1); }

  void AddNodes() {
    for (int step = 0; step < model_.steps; ++step) {
      workload_.nodes.push_back(LabelSet::All(model_.poses));
      workload_.nodes.push_back(LabelSet::All(model_.grasps));
    }
    workload_.nodes.push_back(LabelSet::All(model_.poses));
  }

  void AddStep(int part, int step) {
    AddReachable(Grasp(part, step), Pose(part, step));
    AddReachable(Grasp(part, step), Pose(part, step + 1));
    for (int other = 0; other < part; ++other) {
      workload_.arcs.push_back(
          {Pose(other, step + 1), Pose(part, step + 1),
           RandomFraction(model_.poses, model_.poses, 1 - model_.interference, random_)});
    }
  }

  void AddReachable(NodeId grasp, NodeId pose) {
    workload_.arcs.push_back(
        {grasp, pose, RandomFraction(model_.grasps, model_.poses, model_.reachable, random_)});
  }

  PlanModel model_;
  RandomStream& random_;
  NetworkWorkload workload_;
};

class ThreatenedPlanBuilder {
 public:
  ThreatenedPlanBuilder(const ThreatenedPlanModel& model, RandomStream& random)
      : model_(model), random_(random) {}

  NetworkWorkload Build() {
    for (int part = 0; part < model_.parts; ++part) AddPart();
    for (int threat = 0; threat < model_.threats; ++threat) AddThreat();
    return std::move(workload_);
  }

 private:
  // Poses have even indices, and grasps have odd ones.
  int NodesOfPart() const { return 2 * model_.steps + 1; }

  // Adds a part: its initial pose, its final pose, and the poses and grasps between.
  void AddPart() {
    const int first = static_cast<int>(workload_.nodes.size());
    for (int i = 0; i < NodesOfPart(); ++i) {
      workload_.nodes.push_back(LabelSet::All(i % 2 == 0 ? model_.poses : model_.grasps));
    }
    workload_.nodes[first] = LabelSet::Of(model_.poses, {random_.Index(model_.poses)});
    for (int i = 0; i + 1 < NodesOfPart(); ++i) AddArc(first + i, first + i + 1, model_.reachable);
  }

  void AddThreat() {
    const auto [earlier, later] = TwoParts();
    AddArc(earlier * NodesOfPart() + 1 + random_.Index(NodesOfPart() - 1),
           later * NodesOfPart() + 1 + random_.Index(NodesOfPart() - 1), model_.harmless);
  }

  std::pair<int, int> TwoParts() {
    const std::vector<int> parts = Draw(2, model_.parts, random_);
    return std::minmax(parts[0], parts[1]);
  }

  void AddArc(int a, int b, double fraction) {
    workload_.arcs.push_back(
        {NodeId(a), NodeId(b),
         RandomFraction(workload_.nodes[a].size(), workload_.nodes[b].size(), fraction, random_)});
  }

  ThreatenedPlanModel model_;
  RandomStream& random_;
  NetworkWorkload workload_;
};

// The forbidden pairs of Model RB's arcs, by the two nodes.
class RbNetworkBuilder {
 public:
  RbNetworkBuilder(const ModelRb& model, RandomStream& random)
      : model_(model),
        random_(random),
        labels_(static_cast<int>(std::lround(std::pow(model.nodes, kAlpha)))) {}

  NetworkWorkload Build() {
    for (int node = 0; node < model_.nodes; ++node) forced_.push_back(random_.Index(labels_));
    const double density = -kAlpha / std::log(1 - kForbidden);
    const auto arcs = std::lround(density * model_.nodes * std::log(model_.nodes));
    for (int arc = 0; arc < arcs; ++arc) DrawArc();
    NetworkWorkload workload;
    workload.nodes.assign(model_.nodes, LabelSet::All(labels_));
    for (const auto& [ends, pairs] : forbidden_) {
      workload.arcs.push_back(
          {NodeId(ends.first), NodeId(ends.second), Relation::Forbidding(labels_, labels_, pairs)});
    }
    return workload;
  }

 private:
  static constexpr double kAlpha = 0.8, kForbidden = 0.25;

  void DrawArc() {
    const std::vector<int> ends = Draw(2, model_.nodes, random_);
    const auto [a, b] = std::minmax(ends[0], ends[1]);
    std::vector<LabelPair>& pairs = forbidden_[{a, b}];
    const int cells = labels_ * labels_, kept = forced_[a] * labels_ + forced_[b];
    for (int cell : Draw(static_cast<int>(std::lround(kForbidden * cells)), cells, random_)) {
      if (model_.labeling == ModelRb::Labeling::kForced && cell == kept) continue;
      pairs.emplace_back(cell / labels_, cell % labels_);
    }
  }

  ModelRb model_;
  RandomStream& random_;
  int labels_;
  std::vector<Label> forced_;
  std::map<std::pair<int, int>, std::vector<LabelPair>> forbidden_;
};

}  // namespace

network::Network NetworkWorkload::Build() const {
  network::Network built;
  for (const LabelSet& labels : nodes) built.AddNode(labels);
  for (const network::Arc& arc : arcs) built.AddArc(arc.a, arc.b, arc.relation);
  return built;
}

Posts PostArcByArc(const NetworkWorkload& workload) {
  network::Network network;
  Posts posts;
  for (const LabelSet& labels : workload.nodes) network.AddNode(labels);
  for (const network::Arc& arc : workload.arcs) {
    posts.outcomes.push_back(network.Post(arc.a, arc.b, arc.relation));
  }
  posts.counters = network.counters();
  return posts;
}

NetworkWorkload RandomNetwork(const ModelB& model, RandomStream& random) {
  NetworkWorkload workload;
  workload.nodes.assign(model.nodes, LabelSet::All(model.labels));
  std::vector<std::pair<int, int>> ends;
  for (int b = 0; b < model.nodes; ++b) {
    for (int a = 0; a < b; ++a) ends.emplace_back(a, b);
  }
  for (int i : Draw(model.arcs, static_cast<int>(ends.size()), random)) {
    workload.arcs.push_back({NodeId(ends[i].first), NodeId(ends[i].second),
                             RandomRelation(model.labels, model.forbidden, random)});
  }
  return workload;
}

NetworkWorkload RandomTree(const TreeModel& model, RandomStream& random) {
  NetworkWorkload workload;
  workload.nodes.assign(model.nodes, LabelSet::All(model.labels));
  for (int node = 1; node < model.nodes; ++node) {
    workload.arcs.push_back({NodeId(random.Index(node)), NodeId(node),
                             RandomRelation(model.labels, model.forbidden, random)});
  }
  return workload;
}

NetworkWorkload RandomGrid(const GridModel& model, RandomStream& random) {
  NetworkWorkload workload;
  workload.nodes.assign(model.rows * model.columns, LabelSet::All(model.labels));
  const auto add = [&](int a, int b) {
    workload.arcs.push_back(
        {NodeId(a), NodeId(b), RandomRelation(model.labels, model.forbidden, random)});
  };
  for (int row = 0; row < model.rows; ++row) {
    for (int column = 0; column < model.columns; ++column) {
      const int node = row * model.columns + column;
      if (column > 0) add(node - 1, node);
      if (row > 0) add(node - model.columns, node);
    }
  }
  return workload;
}

NetworkWorkload RandomPlanNetwork(const PlanModel& model, RandomStream& random) {
  return PlanNetworkBuilder(model, random).Build();
}

NetworkWorkload RandomThreatenedPlan(const ThreatenedPlanModel& model, RandomStream& random) {
  return ThreatenedPlanBuilder(model, random).Build();
}

NetworkWorkload CrowdedPlan(int index, std::uint64_t seed) {
  RandomStream random(seed, fmt::format("crowded-{}", index));
  return RandomPlanNetwork(
      {.parts = 3 + index % 8, .steps = 3 + index % 2, .interference = 0.3 + 0.1 * (index % 5)},
      random);
}

NetworkWorkload LargeThreatenedPlan(PlanSize size, int index, std::uint64_t seed) {
  RandomStream random(seed, fmt::format("large-{}-{}", size.parts, index));
  return RandomThreatenedPlan(
      {.parts = size.parts, .steps = size.steps, .threats = 6 * size.parts * size.steps}, random);
}

NetworkWorkload LargeCrowdedPlan(PlanSize size, int index, std::uint64_t seed) {
  RandomStream random(seed, fmt::format("large-crowded-{}-{}", size.parts, index));
  return RandomPlanNetwork(
      {.parts = size.parts, .steps = size.steps, .interference = 0.15 + 0.05 * index}, random);
}

NetworkWorkload RandomRbNetwork(const ModelRb& model, RandomStream& random) {
  return RbNetworkBuilder(model, random).Build();
}

std::string_view Name(NetworkFamily family) {
  switch (family) {
    case NetworkFamily::kModelB:
      return "model-b";
    case NetworkFamily::kModelRb:
      return "model-rb";
    case NetworkFamily::kPlan:
      return "plan";
    case NetworkFamily::kTree:
      return "tree";
    case NetworkFamily::kGrid:
      return "grid";
  }
  return "";
}

// Models B and RB are near their thresholds, where one labeling is expected.
NetworkWorkload NetworkOfFamily(NetworkFamily family, int index, std::uint64_t seed) {
  RandomStream random(seed, fmt::format("{}-{}", Name(family), index));
  switch (family) {
    case NetworkFamily::kModelB: {
      const int nodes = 11 + index;
      return RandomNetwork({.nodes = nodes, .labels = 10, .arcs = nodes * 5, .forbidden = 37},
                           random);
    }
    case NetworkFamily::kModelRb:
      return RandomRbNetwork({.nodes = 12 + index / 2}, random);
    case NetworkFamily::kPlan: {
      const int parts = 2 + index / 5;
      return RandomThreatenedPlan({.parts = parts,
                                   .steps = 3,
                                   .threats = parts * (3 * parts - 5) + 2 * parts * (index % 5)},
                                  random);
    }
    case NetworkFamily::kTree:
      return RandomTree({.nodes = 10 * (index + 1), .labels = 10, .forbidden = 70}, random);
    case NetworkFamily::kGrid: {
      const int rows = 3 + index / 4;
      return RandomGrid({.rows = rows, .columns = rows + index % 4, .labels = 20, .forbidden = 280},
                        random);
    }
  }
  return {};
}

NetworkWorkload LoadNetworkWorkload(const std::filesystem::path& file) {
  const network::NamedNetwork named = network::LoadNetwork(file);
  NetworkWorkload workload;
  for (const std::vector<std::string>& labels : named.labels) {
    workload.nodes.push_back(LabelSet::All(static_cast<int>(labels.size())));
  }
  workload.arcs.assign(named.network.arcs().begin(), named.network.arcs().end());
  return workload;
}

namespace {

void AddFiles(std::vector<MeasuredNetwork>& networks, const std::filesystem::path& folder,
              Extent extent) {
  std::vector<std::filesystem::path> files(std::filesystem::directory_iterator(folder), {});
  std::ranges::sort(files);
  for (const std::filesystem::path& file : files) {
    const std::string name = file.stem();
    if (extent == Extent::kTiny && name != "plan-2x2" && name != "mb-n10-d10") continue;
    networks.push_back({.name = name,
                        .make = [=] { return LoadNetworkWorkload(file); },
                        .is_plan = name.starts_with("plan-"),
                        .is_countable = name != "easy-n200-d5" && name != "grid-n100-d20"});
  }
}

}  // namespace

std::vector<MeasuredNetwork> MeasuredNetworks(const std::filesystem::path& folder,
                                              std::uint64_t seed, Extent extent) {
  std::vector<MeasuredNetwork> networks;
  AddFiles(networks, folder, extent);
  for (const NetworkFamily family : kNetworkFamilies) {
    for (int index = 0; index < (extent == Extent::kTiny ? 1 : kNetworksOfFamily); ++index) {
      networks.push_back(
          {.name = fmt::format("{}-{:02}", Name(family), index),
           .make = [=] { return NetworkOfFamily(family, index, seed); },
           .is_plan = family == NetworkFamily::kPlan,
           .is_countable = family == NetworkFamily::kModelB || family == NetworkFamily::kModelRb});
    }
  }
  return networks;
}

}  // namespace assay::workloads
