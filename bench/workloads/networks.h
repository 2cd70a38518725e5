#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "planner/base/random.h"
#include "planner/network/network/network.h"

namespace assay::workloads {

// A network as a list of what is to be posted, in order.
struct NetworkWorkload {
  std::vector<network::LabelSet> nodes;
  std::vector<network::Arc> arcs;

  network::Network Build() const;  // without consistency checks
};

// A planner's use of a network: arc after arc, with an answer after each; what leaves no labeling
// is taken back.
struct Posts {
  std::vector<Outcome> outcomes;  // by arc
  network::Counters counters;
};
Posts PostArcByArc(const NetworkWorkload& workload);

// Random networks with exact numbers of arcs and of forbidden pairs in each (Model B: Smith and
// Dyer 1996).
struct ModelB {
  int nodes = 0;
  int labels = 0;     // of each node
  int arcs = 0;       // between different pairs of nodes
  int forbidden = 0;  // pairs of each arc
};
NetworkWorkload RandomNetwork(const ModelB& model, RandomStream& random);

// Random networks whose hard instances are known to lie at the threshold, where half of them have a
// labeling (Model RB: Xu and Li 2000): nodes^0.8 labels, arcs drawn with repetition, a quarter of
// the pairs of each forbidden. Arcs between the same nodes become one.
struct ModelRb {
  int nodes = 0;
  enum class Labeling { kAsDrawn, kForced } labeling = Labeling::kAsDrawn;  // kForced: has one
};
NetworkWorkload RandomRbNetwork(const ModelRb& model, RandomStream& random);

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

// The networks of assembly plans as above, but for the threats: where, for how many pairs of poses
// and grasps, parts are in each other's way is drawn at random.
struct ThreatenedPlanModel {
  int parts = 0;
  int steps = 0;
  int poses = 24;
  int grasps = 48;
  double reachable = 0.19;  // fraction of pairs of a grasp and a pose
  int threats = 0;          // arcs between poses or grasps of different parts
  double harmless = 0.65;   // fraction of pairs
};
NetworkWorkload RandomThreatenedPlan(const ThreatenedPlanModel& model, RandomStream& random);

// Plans of 3 to 10 parts, the more of whose poses interfere the higher the index modulo 5: arcs
// that come one by one are the more often refused.
NetworkWorkload CrowdedPlan(int index, std::uint64_t seed);

// Plans of many parts. Threatened: as many threats as leave a labeling that is easily found, so
// that no arc is refused. Crowded: poses interfere the more, the higher the index of 0 .. 2; with
// index 0 few arcs are refused or none, but it takes long to see that.
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
NetworkWorkload NetworkOfFamily(NetworkFamily family, int index, std::uint64_t seed);  // they grow

NetworkWorkload LoadNetworkWorkload(const std::filesystem::path& file);  // as `assay label` reads

// A network that benchmarks measure, read or drawn when it is needed.
struct MeasuredNetwork {
  std::string name;
  std::function<NetworkWorkload()> make;
  bool is_plan = false;       // its arcs come as a planner posts them
  bool is_countable = false;  // it has no more labelings than a peer can list
};

// Those of `folder` (bench/workloads/networks) by name, then 30 of each family, drawn from the
// seed; kTiny: two small files, and the first of each family.
enum class Extent { kWhole, kTiny };
std::vector<MeasuredNetwork> MeasuredNetworks(const std::filesystem::path& folder,
                                              std::uint64_t seed, Extent extent);

}  // namespace assay::workloads
