#include "sim/cli/mating_output/contact_chain_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "sim/cli/plan_output/table.h"

namespace assay::cli {
namespace {

using Json = nlohmann::ordered_json;
using check::ContactSet;
using finemotion::ContactChain;
using finemotion::FineMotionPlan;
using finemotion::kPoseDimensions;
using finemotion::LocalTopology;

std::array<int, kPoseDimensions + 1> StatesByDimension(const LocalTopology& point) {
  std::array<int, kPoseDimensions + 1> count = {};
  for (const auto& state : point.graph.states) ++count[static_cast<std::size_t>(state.dimension)];
  return count;
}

// A strategy's part at one critical point.
struct Passing {
  int motions = 0;
  int transitions = 0;  // number of contacts that it makes or breaks
  std::set<ContactSet> states = {};
};

Passing PassingOf(const FineMotionPlan& plan, std::size_t critical_point) {
  const check::PlannedContacts planned = check::PlannedContactsOf(plan);
  Passing passing;
  for (std::size_t i = 0; i < planned.motions.size(); ++i) {
    if (std::cmp_not_equal(plan.motions[i].critical_point, critical_point)) continue;
    const check::PlannedContacts::Motion& motion = planned.motions[i];
    ++passing.motions;
    passing.transitions += static_cast<int>(std::ssize(motion.before) - std::ssize(motion.kept) +
                                            std::ssize(motion.after) - std::ssize(motion.kept));
    passing.states.insert({motion.before, motion.kept, motion.after});
  }
  return passing;
}

int StatesInGraph(const Passing& passing, const LocalTopology& point) {
  std::set<ContactSet> in_graph;
  for (int i = 0; i < std::ssize(point.graph.states); ++i) in_graph.insert(point.ContactsOf(i));
  return static_cast<int>(std::ranges::count_if(
      passing.states, [&](const ContactSet& state) { return in_graph.contains(state); }));
}

std::string InitialText(const LocalTopology& point) {
  const auto& initial = point.initial;
  if (initial.empty()) return "none";
  return initial == std::vector<int>{0} ? "free space" : fmt::format("{} shared", initial.size());
}

std::string GoalText(const LocalTopology& point, bool is_last) {
  if (point.goals.empty()) return "none";
  return fmt::format("{} {}", point.goals.size(), is_last ? "seated" : "shared");
}

Json SizeOf(const finemotion::ContactGraph& graph) {
  std::size_t arcs = 0;
  for (const auto& state : graph.states) arcs += state.sons.size();
  return {{"states", graph.states.size()}, {"arcs", arcs}};
}

Json WaysThrough(const LocalTopology& point) {
  const auto least = point.LeastTransitions();
  return {{"dimensions", StatesByDimension(point)},
          {"initial", point.initial.size()},
          {"goals", point.goals.size()},
          {"transitions", least ? Json(*least) : Json()}};
}

Json PassingJson(const Passing& passing, const LocalTopology& point) {
  return {{"motions", passing.motions},
          {"transitions", passing.transitions},
          {"states", passing.states.size()},
          {"in_graph", StatesInGraph(passing, point)}};
}

std::string CountText(const std::optional<int>& count) {
  return count ? fmt::format("{}", *count) : "no way";
}

}  // namespace

std::string TextOf(const ContactChain& chain, const FineMotionPlan& plan) {
  std::vector<Table::Column> columns = {{"critical point"}, {"states", Align::kRight}};
  for (int dimension = kPoseDimensions - 1; dimension >= 0; --dimension)
    columns.push_back({fmt::format("{}-D", dimension), Align::kRight});
  for (const char* name : {"from", "to"}) columns.push_back({name});
  for (const char* name : {"fewest transitions", "of strategy"})
    columns.push_back({name, Align::kRight});
  Table table(columns);
  int planned = 0;
  int in_graph = 0;
  for (std::size_t i = 0; i < chain.points.size(); ++i) {
    const LocalTopology& point = chain.points[i];
    const Passing passing = PassingOf(plan, i);
    planned += static_cast<int>(std::ssize(passing.states));
    in_graph += StatesInGraph(passing, point);
    std::vector<std::string> row = {fmt::format("{}", i + 1),
                                    fmt::format("{}", point.graph.states.size())};
    const auto counts = StatesByDimension(point);
    for (std::size_t dimension = kPoseDimensions; dimension-- > 0;)
      row.push_back(fmt::format("{}", counts[dimension]));
    row.push_back(InitialText(point));
    row.push_back(GoalText(point, i + 1 == chain.points.size()));
    row.push_back(CountText(point.LeastTransitions()));
    row.push_back(passing.motions > 0 ? fmt::format("{}", passing.transitions) : "-");
    table.Add(row);
  }
  const std::string has =
      planned == 0
          ? ""
          : fmt::format("the strategy has {} contact states; the graphs have {} of these\n",
                        planned, in_graph);
  return "contact graphs\n" + table.Text() + has;
}

Json ToJson(const ContactChain& chain, const FineMotionPlan& plan) {
  Json graphs = Json::array();
  for (std::size_t i = 0; i < chain.points.size(); ++i) {
    const LocalTopology& point = chain.points[i];
    Json graph = SizeOf(point.graph);
    graph.update(WaysThrough(point));
    if (const Passing passing = PassingOf(plan, i); passing.motions > 0)
      graph["strategy"] = PassingJson(passing, point);
    graphs.push_back(std::move(graph));
  }
  return {{"graph", SizeOf(chain.points.front().graph)}, {"graphs", std::move(graphs)}};
}

}  // namespace assay::cli
