#include "planner/contingent/world_sets/decision_diagram.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "planner/base/random.h"

namespace assay::contingent::decision_diagram_test {
namespace {

using ::testing::ElementsAreArray;

constexpr int kVariables = 5;
constexpr unsigned kWorlds = 1U << kVariables;

bool ValueIn(unsigned world, int variable) { return (world >> variable & 1U) != 0; }

// A diagram together with its meaning in naive form: the set of worlds, one by one.
struct Both {
  Diagram diagram;
  std::set<unsigned> worlds;
};

bool Contains(const DecisionDiagrams& diagrams, Diagram f, unsigned world) {
  while (!diagrams.IsConstant(f)) {
    f = ValueIn(world, diagrams.variable(f)) ? diagrams.high(f) : diagrams.low(f);
  }
  return f == kAllSets;
}

std::set<unsigned> WorldsOf(const DecisionDiagrams& diagrams, Diagram f) {
  std::set<unsigned> worlds;
  for (unsigned world = 0; world < kWorlds; ++world) {
    if (Contains(diagrams, f, world)) worlds.insert(world);
  }
  return worlds;
}

// Makes a random set by operations in a random order.
Both RandomSet(DecisionDiagrams& diagrams, RandomStream& random, int depth = 4) {
  if (depth == 0) {
    const int variable = random.Index(kVariables);
    const bool value = random.Index(2) == 0;
    Both literal{diagrams.Literal({variable, value}), {}};
    for (unsigned world = 0; world < kWorlds; ++world) {
      if (ValueIn(world, variable) == value) literal.worlds.insert(world);
    }
    return literal;
  }
  const Both f = RandomSet(diagrams, random, depth - 1);
  const Both g = RandomSet(diagrams, random, depth - 1);
  const bool is_and = random.Index(2) == 0;
  Both both{is_and ? diagrams.And(f.diagram, g.diagram) : diagrams.Or(f.diagram, g.diagram), {}};
  for (unsigned world = 0; world < kWorlds; ++world) {
    const int holding = static_cast<int>(f.worlds.count(world) + g.worlds.count(world));
    if (holding >= (is_and ? 2 : 1)) both.worlds.insert(world);
  }
  return both;
}

class Laws : public testing::Test {
 protected:
  template <class Function>
  void ForRandomSets(const Function& function) {
    for (int seed = 0; seed < 300; ++seed) {
      SCOPED_TRACE(seed);
      RandomStream random(seed, "diagrams");
      const Both f = RandomSet(diagrams_, random);
      const Both g = RandomSet(diagrams_, random);
      function(f, g, random);
    }
  }

  DecisionDiagrams diagrams_;
};

TEST_F(Laws, MeanWhatTheyWereMadeOf) {
  ForRandomSets([&](const Both& f, const Both& g, RandomStream&) {
    EXPECT_EQ(WorldsOf(diagrams_, f.diagram), f.worlds);
    // Diagrams are canonical: equal sets have equal diagrams.
    EXPECT_EQ(f.diagram == g.diagram, f.worlds == g.worlds);
    EXPECT_EQ(diagrams_.Not(diagrams_.Not(f.diagram)), f.diagram);
    EXPECT_EQ(WorldsOf(diagrams_, diagrams_.Not(f.diagram)).size(), kWorlds - f.worlds.size());
  });
}

TEST_F(Laws, ImpliesIsSubset) {
  ForRandomSets([&](const Both& f, const Both& g, RandomStream&) {
    const bool is_subset =
        std::includes(g.worlds.begin(), g.worlds.end(), f.worlds.begin(), f.worlds.end());
    EXPECT_EQ(diagrams_.Implies(f.diagram, g.diagram), is_subset);
    EXPECT_TRUE(diagrams_.Implies(diagrams_.And(f.diagram, g.diagram), f.diagram));
  });
}

TEST_F(Laws, RestrictAndQuantify) {
  ForRandomSets([&](const Both& f, const Both&, RandomStream& random) {
    const int variable = random.Index(kVariables);
    const unsigned bit = 1U << variable;
    for (unsigned world = 0; world < kWorlds; ++world) {
      const bool if_true = f.worlds.contains(world | bit);
      const bool if_false = f.worlds.contains(world & ~bit);
      const auto contains = [&](Diagram g) { return Contains(diagrams_, g, world); };
      EXPECT_EQ(contains(diagrams_.Cofactor(f.diagram, {variable, true})), if_true);
      EXPECT_EQ(contains(diagrams_.Cofactor(f.diagram, {variable, false})), if_false);
      EXPECT_EQ(contains(diagrams_.Exists(f.diagram, variable)), if_true || if_false);
      EXPECT_EQ(contains(diagrams_.ForAll(f.diagram, variable)), if_true && if_false);
    }
  });
}

TEST_F(Laws, ComposeReplacesAllAtOnce) {
  ForRandomSets([&](const Both& f, const Both& g, RandomStream&) {
    // Variables 0 and 1 are swapped, and 2 becomes g.
    const std::unordered_map<int, Diagram> of = {
        {0, diagrams_.Literal({1, true})}, {1, diagrams_.Literal({0, true})}, {2, g.diagram}};
    const Diagram composed = diagrams_.Compose(f.diagram, of);
    for (unsigned world = 0; world < kWorlds; ++world) {
      const unsigned replaced = (world & ~7U) | (world & 1U) << 1U | (world >> 1U & 1U) |
                                (g.worlds.contains(world) ? 4U : 0U);
      EXPECT_EQ(Contains(diagrams_, composed, world), f.worlds.contains(replaced));
    }
  });
}

TEST_F(Laws, EssentialLiteralsHoldInAllWorlds) {
  ForRandomSets([&](const Both& f, const Both&, RandomStream&) {
    if (f.worlds.empty()) return;
    std::vector<Assignment> expected;
    for (int variable = 0; variable < kVariables; ++variable) {
      for (const bool value : {false, true}) {
        const bool holds = std::all_of(f.worlds.begin(), f.worlds.end(), [&](unsigned world) {
          return ValueIn(world, variable) == value;
        });
        if (holds) expected.push_back({variable, value});
      }
    }
    EXPECT_THAT(diagrams_.Essential(f.diagram), ElementsAreArray(expected));
  });
}

TEST_F(Laws, SupportIsWhatTheSetDependsOn) {
  ForRandomSets([&](const Both& f, const Both&, RandomStream&) {
    std::vector<int> expected;
    for (int variable = 0; variable < kVariables; ++variable) {
      if (diagrams_.Cofactor(f.diagram, {variable, true}) !=
          diagrams_.Cofactor(f.diagram, {variable, false})) {
        expected.push_back(variable);
      }
    }
    EXPECT_THAT(diagrams_.Support(f.diagram), ElementsAreArray(expected));
  });
}

TEST_F(Laws, ExactlyOneAndAtLeastOne) {
  const std::vector<Assignment> literals = {{0, true}, {2, false}, {4, true}};
  const Diagram one = diagrams_.ExactlyOne(literals);
  const Diagram some = diagrams_.AtLeastOne(literals);
  for (unsigned world = 0; world < kWorlds; ++world) {
    int holding = 0;
    for (const Assignment& l : literals) holding += ValueIn(world, l.variable) == l.value ? 1 : 0;
    EXPECT_EQ(Contains(diagrams_, one, world), holding == 1);
    EXPECT_EQ(Contains(diagrams_, some, world), holding >= 1);
  }
}

}  // namespace
}  // namespace assay::contingent::decision_diagram_test
