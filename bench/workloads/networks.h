#pragma once

#include <vector>

#include "planner/base/random.h"
#include "planner/network/network.h"

namespace assay::workloads {

// A network as a list of what is to be posted, in order.
struct NetworkWorkload {
  std::vector<network::LabelSet> nodes;
  std::vector<network::Arc> arcs;

  network::Network Build() const;  // without consistency checks
};

// Random networks with exact numbers of arcs and of forbidden pairs in each (Model B: Smith and
// Dyer 1996).
struct ModelB {
  int nodes = 0;
  int labels = 0;     // of each node
  int arcs = 0;       // between different pairs of nodes
  int forbidden = 0;  // pairs of each arc
};
NetworkWorkload RandomNetwork(const ModelB& model, RandomStream& random);

// Each node but the first has one arc to an earlier node.
struct TreeModel {
  int nodes = 0;
  int labels = 0;
  int forbidden = 0;
};
NetworkWorkload RandomTree(const TreeModel& model, RandomStream& random);

// Nodes on a grid with arcs to the neighbours in the row and in the column.
struct GridModel {
  int rows = 0;
  int columns = 0;
  int labels = 0;
  int forbidden = 0;
};
NetworkWorkload RandomGrid(const GridModel& model, RandomStream& random);

// The networks of assembly plans: part p has poses 0 .. steps and between two poses the grasp that
// takes it from one to the other. A grasp must be reachable at both (arcs as random relations
// with the given fraction of pairs), poses of two parts in one step must not interfere (a sparse
// set of forbidden pairs), and the last grasp of a part must reach its mating with the last pose
// of the part before. Arcs come step by step, as a planner would post them.
struct PlanModel {
  int parts = 0;
  int steps = 0;
  int poses = 6;
  int grasps = 24;
  double reachable = 0.3;      // fraction of pairs of a grasp and a pose
  double interference = 0.05;  // fraction of pairs of poses
};
NetworkWorkload RandomPlanNetwork(const PlanModel& model, RandomStream& random);

}  // namespace assay::workloads
