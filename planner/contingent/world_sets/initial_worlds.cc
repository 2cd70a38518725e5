#include "planner/contingent/world_sets/initial_worlds.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

#include "planner/base/random.h"

namespace assay::contingent {
namespace {

using Choice = std::vector<Truth>;  // truth values of the atoms of a group

// A group of atoms whose truth values depend on each other: because of a relation, or because the
// atoms give the value of the same function. It lists every possible choice of these truth values.
struct Group {
  std::vector<int> atoms;
  std::vector<Choice> choices;
};

class Enumerator {
 public:
  Enumerator(const GroundTask& task, const NumberMarks& marks, std::int64_t limit)
      : task_(task), marks_(marks), limit_(limit) {
    relations_of_.resize(task.atoms.size());
    known_.assign(task.atoms.size(), Truth::kEither);
    for (const GroundLiteral& l : task.initial.known) {
      known_[l.atom.index()] = l.is_positive ? Truth::kTrue : Truth::kFalse;
    }
    MakeGroups();
    for (Group& group : groups_) Choose(group);
  }

  InitialWorlds Run(std::uint64_t seed) {
    InitialWorlds result;
    double count = 1;
    for (const Group& group : groups_) count *= static_cast<double>(group.choices.size());
    result.were_drawn = !is_complete_ || count > static_cast<double>(limit_);
    RandomStream random(seed, "worlds");
    const auto worlds = static_cast<std::int64_t>(std::min(count, static_cast<double>(limit_)));
    for (std::int64_t w = 0; w < worlds; ++w) {
      World world{.atoms = known_, .numbers = {}};
      std::int64_t rest = w;
      for (const Group& group : groups_) {
        const auto size = static_cast<std::int64_t>(group.choices.size());
        Put(group, result.were_drawn ? random.Index(static_cast<int>(size)) : rest % size, world);
        rest /= size;
      }
      result.worlds.push_back(std::move(world));
    }
    AddNumbers(result, random);
    return result;
  }

 private:
  void MakeGroups() {
    std::vector<int> group_of(task_.atoms.size());
    std::iota(group_of.begin(), group_of.end(), 0);
    const auto find = [&](int atom) {
      while (group_of[atom] != atom) atom = group_of[atom] = group_of[group_of[atom]];
      return atom;
    };
    std::map<FunctionId, int> value_of;
    for (const InitialRelation& relation : task_.initial.relations) {
      for (const GroundLiteral& l : relation.literals) {
        const int atom = l.atom.index();
        group_of[find(atom)] = find(relation.literals.front().atom.index());
        const FunctionId function = task_.function_of_atom[atom];
        if (function.IsNone()) continue;
        group_of[find(atom)] = find(value_of.try_emplace(function, atom).first->second);
      }
    }
    std::map<int, Group> by_root;
    std::set<int> named;
    for (const InitialRelation& relation : task_.initial.relations) {
      Group& group = by_root[find(relation.literals.front().atom.index())];
      for (const GroundLiteral& l : relation.literals) {
        relations_of_[l.atom.index()].push_back(&relation);
        if (named.insert(l.atom.index()).second) group.atoms.push_back(l.atom.index());
      }
    }
    for (auto& [root, group] : by_root) groups_.push_back(std::move(group));
  }

  void Choose(Group& group) {
    std::vector<Truth> world = known_;
    ChooseFrom(group, 0, world);
  }

  void ChooseFrom(Group& group, std::size_t next, std::vector<Truth>& world) {
    if (static_cast<std::int64_t>(group.choices.size()) > 4 * limit_) {
      is_complete_ = false;
      return;
    }
    if (next == group.atoms.size()) {
      Choice choice;
      for (const int atom : group.atoms) choice.push_back(world[atom]);
      group.choices.push_back(std::move(choice));
      return;
    }
    const int atom = group.atoms[next];
    for (const Truth truth : {Truth::kTrue, Truth::kFalse}) {
      if (known_[atom] != Truth::kEither && known_[atom] != truth) continue;
      world[atom] = truth;
      if (CanHold(atom, world)) ChooseFrom(group, next + 1, world);
    }
    world[atom] = known_[atom];
  }

  // Returns true if the truth values so far violate no relation of the atom and give no function
  // two values.
  bool CanHold(int atom, const std::vector<Truth>& world) const {
    const FunctionId function = task_.function_of_atom[atom];
    if (!function.IsNone() && world[atom] == Truth::kTrue) {
      for (const AtomId value : task_.functions[function.index()].values) {
        if (value.index() != atom && world[value.index()] == Truth::kTrue) return false;
      }
    }
    const std::vector<const InitialRelation*>& relations = relations_of_[atom];
    return std::all_of(relations.begin(), relations.end(),
                       [&](const InitialRelation* r) { return CanHold(*r, world); });
  }

  static bool CanHold(const InitialRelation& relation, const std::vector<Truth>& world) {
    int holding = 0;
    int open = 0;
    for (const GroundLiteral& l : relation.literals) {
      const Truth truth = world[l.atom.index()];
      if (truth == Truth::kEither) ++open;
      if (truth == (l.is_positive ? Truth::kTrue : Truth::kFalse)) ++holding;
    }
    return holding + open >= 1 && (relation.is_inclusive || holding <= 1);
  }

  void Put(const Group& group, std::int64_t choice, World& world) const {
    for (std::size_t i = 0; i < group.atoms.size(); ++i) {
      const int atom = group.atoms[i];
      world.atoms[atom] = group.choices[choice][i];
      const FunctionId function = task_.function_of_atom[atom];
      if (function.IsNone() || world.atoms[atom] != Truth::kTrue) continue;
      for (const AtomId value : task_.functions[function.index()].values) {
        if (value.index() != atom) world.atoms[value.index()] = Truth::kFalse;
      }
    }
  }

  void AddNumbers(InitialWorlds& result, RandomStream& random) const {
    for (std::size_t slot = 0; slot < task_.initial.ranges.size(); ++slot) {
      const std::vector<Number> values =
          marks_.In(task_.initial.ranges[slot], static_cast<int>(slot));
      const auto count = static_cast<int>(values.size());
      if (static_cast<std::int64_t>(result.worlds.size()) * count > limit_) {
        result.were_drawn = true;
        for (World& world : result.worlds) world.numbers.push_back(values[random.Index(count)]);
        continue;
      }
      std::vector<World> more;
      for (const Number& value : values) {
        for (const World& world : result.worlds) {
          more.push_back(world);
          more.back().numbers.push_back(value);
        }
      }
      result.worlds = std::move(more);
    }
  }

  const GroundTask& task_;
  const NumberMarks& marks_;
  std::int64_t limit_;
  std::vector<Truth> known_;
  std::vector<std::vector<const InitialRelation*>> relations_of_;  // indexed by atom
  std::vector<Group> groups_;
  bool is_complete_ = true;
};

}  // namespace

InitialWorlds EnumerateWorlds(const GroundTask& task, const NumberMarks& marks, std::int64_t limit,
                              std::uint64_t seed) {
  return Enumerator(task, marks, limit).Run(seed);
}

}  // namespace assay::contingent
