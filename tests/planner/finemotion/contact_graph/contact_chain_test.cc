#include "planner/finemotion/contact_graph/contact_chain.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "bench/workloads/pegs.h"
#include "planner/geometry/pose.h"
#include "tests/planner/domain/scenario.h"
#include "tests/planner/finemotion/feasible_contacts.h"

namespace assay::finemotion::contact_chain_test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;
using workloads::BoxPiece;
using workloads::BoxShape;

const ContactState& At(const LocalTopology& point, int state) {
  return point.graph.states[static_cast<std::size_t>(state)];
}

// --- A box that slides along a floor and a wall, over both of them from x = 0 on, until another
// wall stops it.

constexpr double kHalf = 0.01;  // half of the width
constexpr double kPlay = 0.25e-3;
constexpr double kWay = 0.05;

Polyhedron CornerShape() {
  return OutsideOf({BoxPiece({0, -0.02, -0.02}, {0.1, 0.06, 0}),
                    BoxPiece({0, -0.02, -0.02}, {0.1, 0, 0.06}),
                    BoxPiece({kWay, -0.02, -0.02}, {0.1, 0.06, 0.06})});
}

MatingGeometry BoxIntoCorner(double length) {
  MatingGeometry geometry;
  geometry.passage.moving = BoxShape({-length, -kHalf, -kHalf}, {0, kHalf, kHalf});
  geometry.passage.stationary = CornerShape();
  geometry.passage.mating = Vector3::UnitX();
  for (const double travel : {0.0, kWay}) {
    const Pose X = geometry::Translation(travel, kHalf + kPlay, kHalf + kPlay);
    geometry.critical_points.push_back(
        {.travel = travel, .X_StationaryMoving = X, .before = {}, .after = {}});
  }
  geometry.passage.X_StationaryEntry = geometry.critical_points.front().X_StationaryMoving;
  geometry.X_FixedSeat = geometry.critical_points.back().X_StationaryMoving;
  return geometry;
}

std::vector<std::string> KindsOf(const std::vector<ContactKey>& contacts) {
  std::vector<std::string> kinds;
  for (const ContactKey& key : contacts)
    kinds.emplace_back(key.kind == ContactKind::kEdgeEdge ? "edges" : "vertex and face");
  return kinds;
}

// The box is flat on the floor and on the wall. On the floor it touches with the two front corners
// and the two edges that cross the end of the floor, and on the wall it does the same.
TEST(ContactChain, ABoxSlidesIntoACornerAlongOneCrevice) {
  const ContactChain chain = ContactChainOf(BoxIntoCorner(0.08));
  ASSERT_THAT(chain.points, SizeIs(2));
  ASSERT_THAT(chain.shared, ElementsAre(SizeIs(1)));
  const SharedState crevice = chain.shared[0][0];
  const auto contacts = chain.points[0].ContactsOf(crevice.earlier);
  EXPECT_EQ(contacts, chain.points[1].ContactsOf(crevice.later));
  EXPECT_THAT(KindsOf(contacts),
              testing::UnorderedElementsAre("vertex and face", "vertex and face", "vertex and face",
                                            "vertex and face", "edges", "edges", "edges", "edges"));
  EXPECT_EQ(At(chain.points[0], crevice.earlier).dimension, 1);
  EXPECT_EQ(At(chain.points[1], crevice.later).dimension, 1);
}

// Five contacts lead from free space into the crevice. At the end of the crevice, the wall is one
// more contact.
TEST(ContactChain, ABoxComesIntoACornerByAContactAtATime) {
  const ContactChain chain = ContactChainOf(BoxIntoCorner(0.08));
  EXPECT_THAT(chain.points[0].initial, ElementsAre(0));
  EXPECT_THAT(chain.points[1].goals, SizeIs(1));
  EXPECT_EQ(chain.points[0].LeastTransitions(), 5);
  EXPECT_EQ(chain.points[1].LeastTransitions(), 1);
}

// When the box is all in, other corners touch than before.
TEST(ContactChain, ABoxThatIsAllInHasLeftTheCreviceThatItCameBy) {
  const ContactChain chain = ContactChainOf(BoxIntoCorner(0.03));
  EXPECT_THAT(chain.shared, ElementsAre(IsEmpty()));
  EXPECT_THAT(chain.points[0].goals, IsEmpty());
  EXPECT_THAT(chain.points[1].initial, IsEmpty());
  for (const ContactState& state : chain.points[0].graph.states) EXPECT_EQ(state.to_goal, -1);
  EXPECT_FALSE(chain.points[0].LeastTransitions().has_value());
  EXPECT_FALSE(chain.points[1].LeastTransitions().has_value());
}

std::set<std::vector<int>> SetsOf(const ContactGraph& graph) {
  std::set<std::vector<int>> sets;
  for (const ContactState& state : graph.states) sets.insert(state.contacts);
  return sets;
}

// Linear programs give all sets of the last critical point and, for the first one, those with the
// floor. Some sets are so narrow that few rays reach them.
TEST(ContactChain, GraphsHaveAllFeasibleSets) {
  for (const LocalTopology& point : ContactChainOf(BoxIntoCorner(0.08)).points) {
    std::vector<PrimitiveContact> contacts = point.space.contacts;
    if (contacts.size() > 12) {
      std::erase_if(contacts, [](const PrimitiveContact& contact) {
        return std::abs(contact.normal.y()) > 0.5 || contact.at.z() > 0;
      });
    }
    ASSERT_LE(contacts.size(), 12u);
    ContactGraphOptions options{.target_points = 200};
    for (const PrimitiveContact& contact : contacts)
      options.radius = std::max(options.radius, contact.at.norm());
    const auto feasible = oracle::FeasibleContacts(contacts, options.reach, options.radius).All();
    EXPECT_EQ(SetsOf(MakeContactGraph({contacts}, options)), feasible);
    options.target_points = 12;
    EXPECT_THAT(SetsOf(MakeContactGraph({contacts}, options)), testing::IsSubsetOf(feasible));
  }
}

// --- Matings of parts.

struct Parts {
  explicit Parts(const std::string& scenario) {
    const domain::Problem problem = domain::LoadScenario(scenario);
    geometry = GeometryOf(problem, problem.matings.back());
    chain = ContactChainOf(geometry);
  }

  MatingGeometry geometry;
  ContactChain chain;
};

// Returns the parts of a scenario, which are made once for all tests.
const Parts& PartsOf(const std::string& scenario) {
  static std::map<std::string, Parts> made;
  return made.try_emplace(scenario, scenario).first->second;
}

class PartsChain : public testing::TestWithParam<const char*> {
 protected:
  const MatingGeometry& geometry_ = PartsOf(GetParam()).geometry;
  const ContactChain& chain_ = PartsOf(GetParam()).chain;
};

TEST_P(PartsChain, LeadsFromFreeSpaceToTheSeat) {
  ASSERT_EQ(chain_.points.size(), geometry_.critical_points.size());
  ASSERT_EQ(chain_.shared.size(), chain_.points.size() - 1);
  EXPECT_THAT(chain_.points.front().initial, ElementsAre(0));
  const LocalTopology& last = chain_.points.back();
  EXPECT_FALSE(last.goals.empty());
  for (const int goal : last.goals) {
    EXPECT_EQ(At(last, goal).dimension, 0);
    // The goal is as far in as the seat and is not tilted.
    const LocalPose& x = At(last, goal).target_points.front();
    EXPECT_NEAR(x.head<3>().dot(geometry_.passage.mating), 0, 1e-9);
    EXPECT_LT(x.tail<3>().cross(geometry_.passage.mating).norm(), 1e-7);
  }
  for (const LocalTopology& point : chain_.points)
    EXPECT_TRUE(point.LeastTransitions().has_value());
  EXPECT_EQ(chain_.points.front().LeastTransitions(), 5);  // from free space into one dimension
  EXPECT_EQ(last.LeastTransitions(), 1);                   // the plate lands
}

TEST_P(PartsChain, NeighboursShareOneDimensionalStatesOfTheSameFeatures) {
  for (std::size_t i = 0; i < chain_.shared.size(); ++i) {
    const LocalTopology& earlier = chain_.points[i];
    const LocalTopology& later = chain_.points[i + 1];
    std::vector<int> goals;
    std::vector<int> initial;
    for (const SharedState& state : chain_.shared[i]) {
      goals.push_back(state.earlier);
      initial.push_back(state.later);
      EXPECT_EQ(earlier.ContactsOf(state.earlier), later.ContactsOf(state.later));
      EXPECT_EQ(At(earlier, state.earlier).dimension, 1);
      EXPECT_EQ(At(later, state.later).dimension, 1);
    }
    EXPECT_FALSE(goals.empty());
    EXPECT_EQ(earlier.goals, goals);
    EXPECT_EQ(later.initial, initial);
  }
}

// The distance of a state from a goal is one more than the least distance of its neighbours.
TEST_P(PartsChain, DistancesAreThoseOfAPlainRelaxation) {
  for (const LocalTopology& point : chain_.points) {
    const auto& states = point.graph.states;
    std::vector<int> distances(states.size(), -1);
    for (const int goal : point.goals) distances[static_cast<std::size_t>(goal)] = 0;
    for (bool changed = true; changed;) {
      changed = false;
      for (std::size_t i = 0; i < states.size(); ++i) {
        for (const int son : states[i].sons) {
          int& a = distances[i];
          int& b = distances[static_cast<std::size_t>(son)];
          if (a >= 0 && (b < 0 || b > a + 1)) changed = (b = a + 1) > 0;
          if (b >= 0 && (a < 0 || a > b + 1)) changed = (a = b + 1) > 0;
        }
      }
    }
    std::vector<int> told;
    for (const ContactState& state : states) told.push_back(state.to_goal);
    EXPECT_EQ(told, distances);
  }
}

INSTANTIATE_TEST_SUITE_P(Scenarios, PartsChain,
                         testing::Values("mate-square", "mate-stepped", "mate-t-slot"),
                         [](const auto& test) {
                           std::string name = test.param;
                           std::ranges::replace(name, '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace assay::finemotion::contact_chain_test
