#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "planner/base/random.h"
#include "planner/network/constraint_network/network.h"

namespace assay::workloads {

// A network as a list of nodes and arcs, which are posted in order.
struct NetworkWorkload {
  std::vector<network::LabelSet> nodes;
  std::vector<network::Arc> arcs;

  network::Network Build() const;  // adds the arcs without consistency checks
};

// The results of posting arc by arc, as a planner does: an answer after each arc, and an arc that
// leaves no labeling is taken back.
struct Posts {
  std::vector<Outcome> outcomes;  // outcome of each arc
  network::Counters counters;
};
Posts PostArcByArc(const NetworkWorkload& workload);

// Random networks with exact numbers of arcs and of forbidden pairs in each arc (Model B: Smith and
// Dyer 1996).
struct ModelB {
  int nodes = 0;
  int labels = 0;     // labels of each node
  int arcs = 0;       // arcs between different pairs of nodes
  int forbidden = 0;  // forbidden pairs of each arc
};
NetworkWorkload RandomNetwork(const ModelB& model, RandomStream& random);

// Random networks whose hard instances are known to lie at the threshold, where half of the
// networks have a labeling (Model RB: Xu and Li 2000). They have nodes^0.8 labels, arcs are drawn
// with repetition, and a quarter of the pairs of each arc is forbidden. Arcs between the same nodes
// become one.
struct ModelRb {
  int nodes = 0;
  // With kForced, the network has a labeling.
  enum class Labeling { kAsDrawn, kForced } labeling = Labeling::kAsDrawn;
};
NetworkWorkload RandomRbNetwork(const ModelRb& model, RandomStream& random);

// Random trees: each node but the first has one arc to an earlier node.
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

// The networks of assembly plans. Part p has poses 0 .. steps, and between two poses the grasp that
// takes it from one to the other. A grasp must be reachable at both poses (random relations with
// the given fraction of pairs). Poses of two parts in one step must not interfere (a sparse set of
// forbidden pairs). The last grasp of a part must reach its mating with the last pose of the part
// before. Arcs come step by step, as a planner would post them.
struct PlanModel {
  int parts = 0;
  int steps = 0;
  int poses = 6;
  int grasps = 24;
  double reachable = 0.3;      // fraction of the pairs of a grasp and a pose that are reachable
  double interference = 0.05;  // fraction of the pairs of poses that interfere
};
NetworkWorkload RandomPlanNetwork(const PlanModel& model, RandomStream& random);

// The networks of PlanModel with other threats: the pairs of poses and grasps for which parts are
// in each other's way are drawn at random.
struct ThreatenedPlanModel {
  int parts = 0;
  int steps = 0;
  int poses = 24;
  int grasps = 48;
  double reachable = 0.19;  // fraction of the pairs of a grasp and a pose that are reachable
  int threats = 0;          // number of arcs between poses or grasps of different parts
  double harmless = 0.65;   // fraction of the pairs in each of these arcs that are allowed
};
NetworkWorkload RandomThreatenedPlan(const ThreatenedPlanModel& model, RandomStream& random);

// Returns a plan of 3 to 10 parts. The greater the index modulo 5, the more of its poses interfere,
// and the more often arcs that are posted one by one are refused.
NetworkWorkload CrowdedPlan(int index, std::uint64_t seed);

// Plans of many parts. A threatened plan has as many threats as leave a labeling that is easily
// found, so no arc is refused. In a crowded plan, the greater the index (0 .. 2), the more poses
// interfere. With index 0 few arcs or none are refused, but it takes long to prove that.
struct PlanSize {
  int parts = 0;
  int steps = 0;
};
inline constexpr PlanSize kLargePlans[] = {{.parts = 16, .steps = 4}, {.parts = 20, .steps = 5}};
NetworkWorkload LargeThreatenedPlan(PlanSize size, int index, std::uint64_t seed);
NetworkWorkload LargeCrowdedPlan(PlanSize size, int index, std::uint64_t seed);

enum class NetworkFamily { kModelB, kModelRb, kPlan, kTree, kGrid };
inline constexpr NetworkFamily kNetworkFamilies[] = {NetworkFamily::kModelB,
                                                     NetworkFamily::kModelRb, NetworkFamily::kPlan,
                                                     NetworkFamily::kTree, NetworkFamily::kGrid};
inline constexpr int kNetworksOfFamily = 30;
std::string_view Name(NetworkFamily family);
// Sizes grow with the index.
NetworkWorkload NetworkOfFamily(NetworkFamily family, int index, std::uint64_t seed);

// Reads the format of `assay label`.
NetworkWorkload LoadNetworkWorkload(const std::filesystem::path& file);

// A network for benchmarks, read or drawn when it is needed.
struct MeasuredNetwork {
  std::string name;
  std::function<NetworkWorkload()> make;
  bool is_plan = false;       // whether its arcs come as a planner posts them
  bool is_countable = false;  // whether it has no more labelings than a peer can list
};

// Returns the networks of `folder` (bench/workloads/networks) by name, then 30 of each family,
// drawn from the seed. With kTiny, it returns two small files and the first network of each family.
enum class Extent { kWhole, kTiny };
std::vector<MeasuredNetwork> MeasuredNetworks(const std::filesystem::path& folder,
                                              std::uint64_t seed, Extent extent);

}  // namespace assay::workloads
