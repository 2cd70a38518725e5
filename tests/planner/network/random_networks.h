#pragma once

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include "bench/workloads/networks.h"
#include "planner/base/random.h"
#include "tests/oracle/naive_labeling.h"

namespace assay::network {

using workloads::NetworkWorkload;

inline LabelSet RandomLabels(int size, double fraction, RandomStream& random) {
  LabelSet labels = LabelSet::None(size);
  for (Label label = 0; label < size; ++label) {
    if (random.Uniform() < fraction) labels.insert(label);
  }
  return labels;
}

inline std::shared_ptr<const Relation> RandomRelation(int rows, int columns, double fraction,
                                                      RandomStream& random) {
  return Relation::Where(rows, columns, [&](Label, Label) { return random.Uniform() < fraction; });
}

// Returns a network with nodes of different sizes and restricted label sets. Arcs may join a node
// to itself, or two nodes several times.
inline NetworkWorkload RandomMixedNetwork(RandomStream& random) {
  NetworkWorkload workload;
  const int nodes = 1 + random.Index(6), arcs = random.Index(10);
  const double allowed = random.Uniform(0.3, 0.95);
  for (int node = 0; node < nodes; ++node) {
    workload.nodes.push_back(RandomLabels(1 + random.Index(5), 0.85, random));
  }
  for (int i = 0; i < arcs; ++i) {
    const int a = random.Index(nodes), b = random.Index(nodes);
    workload.arcs.push_back(
        {NodeId(a), NodeId(b),
         RandomRelation(workload.nodes[a].size(), workload.nodes[b].size(), allowed, random)});
  }
  return workload;
}

// Returns one of several kinds of small networks. About half of them have a labeling.
inline NetworkWorkload RandomSmallNetwork(RandomStream& random) {
  switch (random.Index(5)) {
    case 0:
      return workloads::RandomNetwork(
          {.nodes = 6, .labels = 4, .arcs = 9, .forbidden = 4 + random.Index(6)}, random);
    case 1:
      return workloads::RandomTree({.nodes = 7, .labels = 4, .forbidden = 6 + random.Index(8)},
                                   random);
    case 2:
      return workloads::RandomGrid(
          {.rows = 2, .columns = 4, .labels = 3, .forbidden = 2 + random.Index(4)}, random);
    case 3:
      return workloads::RandomPlanNetwork({.parts = 2,
                                           .steps = 1,
                                           .poses = 3,
                                           .grasps = 5,
                                           .reachable = random.Uniform(0.2, 0.8),
                                           .interference = 0.3},
                                          random);
    default:
      return RandomMixedNetwork(random);
  }
}

// Returns a network whose label sets may take several machine words, but have few labels.
inline NetworkWorkload RandomWideNetwork(RandomStream& random) {
  NetworkWorkload workload;
  const int nodes = 3;
  for (int node = 0; node < nodes; ++node) {
    workload.nodes.push_back(RandomLabels(1 + random.Index(200), 0.2, random));
  }
  for (int i = 0; i < 4; ++i) {
    const int a = random.Index(nodes), b = random.Index(nodes);
    const double allowed = random.Uniform(0.01, 0.2);
    workload.arcs.push_back(
        {NodeId(a), NodeId(b),
         RandomRelation(workload.nodes[a].size(), workload.nodes[b].size(), allowed, random)});
  }
  return workload;
}

}  // namespace assay::network
