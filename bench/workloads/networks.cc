#include "bench/workloads/networks.h"

#include <utility>

#include "planner/base/check.h"

namespace assay::workloads {
namespace {

using network::Label;
using network::LabelPair;
using network::LabelSet;
using network::NodeId;
using network::Relation;

// `count` different members of 0 .. size - 1, in random order (Fisher and Yates).
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

}  // namespace

network::Network NetworkWorkload::Build() const {
  network::Network built;
  for (const LabelSet& labels : nodes) built.AddNode(labels);
  for (const network::Arc& arc : arcs) built.AddArc(arc.a, arc.b, arc.relation);
  return built;
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

}  // namespace assay::workloads
