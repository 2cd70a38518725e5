#include "planner/contingent/search/hopeless_world.h"

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "planner/contingent/grounding/ground_query.h"
#include "planner/contingent/knowledge/number_marks.h"
#include "planner/contingent/plan_tree/plan_tree.h"
#include "planner/contingent/world_sets/initial_worlds.h"
#include "planner/contingent/world_sets/world_progression.h"

namespace assay::contingent {
namespace {

constexpr std::int64_t kMostInitialWorlds = 1000;
constexpr std::size_t kMostStates = 20'000;   // in all searches together
constexpr std::size_t kMostOpenWorlds = 256;  // which an action may lead to

// The search from single worlds, in each of which everything is known.
class WorldSearch {
 public:
  WorldSearch(const GroundTask& task, const NumberMarks& marks, Budget& budget)
      : task_(task), budget_(budget), progression_(task, marks, false, kMostOpenWorlds) {
    for (std::size_t i = 0; i < task.formulas.size(); ++i) sensed_.insert(FormulaId(i));
    for (std::size_t i = 0; i < task.functions.size(); ++i) values_sensed_[FunctionId(i)] = 0;
  }

  // Decides either way what a world leaves open. Returns nothing if there are too many worlds then.
  std::optional<Worlds> Decided(Worlds worlds) {
    for (std::size_t atom = 0; atom < task_.atoms.size(); ++atom) {
      progression_.SplitBy(AtomId(atom), worlds);
      if (worlds.size() > kMostOpenWorlds) return std::nullopt;
    }
    return worlds;
  }

  // Returns whether a sequence of actions reaches the goal from the world, or nothing if it cannot
  // tell.
  std::optional<bool> ReachesGoal(const World& initial) {
    std::set<World> met;
    Worlds open;
    History start = KnownWorld(initial);
    progression_.Update(start);
    if (!Add(std::move(start.worlds), met, open)) return std::nullopt;
    while (!open.empty()) {
      const History here = KnownWorld(open.back());
      open.pop_back();
      if (progression_.Ask(task_.goal, here) != Answer::kNo) return true;
      for (const GroundAction& action : task_.actions) {
        if (progression_.Ask(action.precondition, here) == Answer::kNo) continue;
        History next = here;
        progression_.Apply(action.effects, next);
        progression_.Update(next);
        if (!Add(std::move(next.worlds), met, open)) return std::nullopt;
      }
    }
    return false;
  }

 private:
  // Returns the history in which everything has been sensed.
  History KnownWorld(const World& world) const {
    return {.worlds = {world}, .sensed = sensed_, .values_sensed = values_sensed_};
  }

  // Adds worlds that were not met before. Returns false if there are too many worlds.
  bool Add(Worlds worlds, std::set<World>& met, Worlds& open) {
    std::optional<Worlds> decided = Decided(std::move(worlds));
    if (!decided) return false;
    const bool is_doubtful =
        progression_.HasMadeTooMany() || progression_.CouldNotTell() || progression_.IsRestless();
    if (is_doubtful) return false;
    for (World& world : *decided) {
      if (!met.insert(world).second) continue;
      if (++states_ > kMostStates || !budget_.Spend()) return false;
      open.push_back(std::move(world));
    }
    return true;
  }

  const GroundTask& task_;
  Budget& budget_;
  std::set<FormulaId> sensed_;
  std::map<FunctionId, double> values_sensed_;
  WorldProgression progression_;
  std::size_t states_ = 0;
};

}  // namespace

bool HasHopelessWorld(const GroundTask& task, Budget& budget) {
  if (!IsMonotone(task) || TellsSomething(task) || !task.function_of_slot.empty()) return false;
  const PlanTree only_goal = {.nodes = {PlanNode()}, .root = NodeId(0)};
  const NumberMarks marks(task, only_goal);
  WorldSearch search(task, marks, budget);
  const Worlds drawn = EnumerateWorlds(task, marks, kMostInitialWorlds, 1).worlds;
  for (const World& open : std::set<World>(drawn.begin(), drawn.end())) {
    const std::optional<Worlds> initial = search.Decided({open});
    if (!initial) return false;
    for (const World& world : *initial) {
      const std::optional<bool> reaches = search.ReachesGoal(world);
      if (!reaches) return false;
      if (!*reaches) return true;
    }
  }
  return false;
}

}  // namespace assay::contingent
