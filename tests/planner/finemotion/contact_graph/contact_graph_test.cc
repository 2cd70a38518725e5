#include "planner/finemotion/contact_graph/contact_graph.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <functional>
#include <set>

#include "bench/workloads/pegs.h"
#include "planner/finemotion/contacts/contact_finder.h"
#include "planner/geometry/pose.h"
#include "tests/planner/finemotion/feasible_contacts.h"

namespace assay::finemotion::contact_graph_test {
namespace {

using oracle::FeasibleContacts;
using testing::Contains;
using testing::Each;
using testing::IsEmpty;
using testing::SizeIs;
using workloads::BoxShape;
using workloads::SquareHoleShape;

// --- Scenes.

constexpr double kHalf = 0.01;          // half of the width of the peg
constexpr double kClearance = 0.25e-3;  // metres on each side
constexpr double kReach = 0.005;

ContactGraphOptions Options() { return {.reach = kReach, .radius = 0.0245}; }

// Returns the contacts of a square peg of 20 mm by 20 mm by 40 mm. Its lower end is `depth` deep in
// a square hole, and the peg is displaced by `aside` from the middle (metres).
ContactSpace PegInHole(double depth, double aside = 0) {
  return {PrimitiveContacts(BoxShape({-kHalf, -kHalf, -0.02}, {kHalf, kHalf, 0.02}),
                            SquareHoleShape(kHalf + kClearance, 0.04, 0.06),
                            geometry::Translation(aside, 0, 0.02 - depth), 0.003)};
}

// Returns a floor and two walls that meet in the origin.
Polyhedron CornerShape() {
  Polyhedron shape;
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3 u = Vector3::Unit((axis + 1) % 3);
    const Vector3 v = Vector3::Unit((axis + 2) % 3);
    shape.faces.push_back({Vector3::Unit(axis), 0, {{Vector3::Zero(), u, u + v, v}}});
  }
  return shape;
}

// Returns a box at this distance from floor and walls.
ContactSpace BoxInCorner(double distance) {
  return {PrimitiveContacts(
      BoxShape({-0.01, -0.015, -0.02}, {0.01, 0.015, 0.02}), CornerShape(),
      geometry::Translation(0.01 + distance, 0.015 + distance, 0.02 + distance), 0.003)};
}

ContactSpace Only(const ContactSpace& space,
                  const std::function<bool(const PrimitiveContact&)>& wanted) {
  ContactSpace only;
  std::ranges::copy_if(space.contacts, std::back_inserter(only.contacts), wanted);
  return only;
}

const PrimitiveContact& At(const ContactSpace& space, int contact) {
  return space.contacts[static_cast<std::size_t>(contact)];
}
const ContactState& At(const ContactGraph& graph, int state) {
  return graph.states[static_cast<std::size_t>(state)];
}

// Returns the contacts with these names. Contacts that another one of their surface represents are
// left out.
std::vector<int> Named(const ContactSpace& space, const std::vector<std::string>& names) {
  std::vector<int> contacts;
  for (int i = 0; i < std::ssize(space.contacts); ++i) {
    if (std::ranges::count(names, Name(At(space, i))) == 0) continue;
    const auto one_surface = [&](int other) {
      return (At(space, i).row - At(space, other).row).norm() < 1e-9;
    };
    if (std::ranges::none_of(contacts, one_surface)) contacts.push_back(i);
  }
  return contacts;
}

std::set<std::vector<int>> Sets(const ContactGraph& graph) {
  std::set<std::vector<int>> sets;
  for (const ContactState& state : graph.states) sets.insert(state.contacts);
  return sets;
}

int Rank(const ContactSpace& space, const std::vector<int>& contacts) {
  Eigen::MatrixXd rows(std::ssize(contacts), kPoseDimensions);
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    rows.row(i) = At(space, contacts[static_cast<std::size_t>(i)]).row;
  }
  if (rows.rows() == 0) return 0;
  rows.rightCols<3>() /= Options().radius;
  Eigen::FullPivLU<Eigen::MatrixXd> lu(rows);
  lu.setThreshold(1e-7);
  return static_cast<int>(lu.rank());
}

// --- All states, compared with linear programs.

void ExpectAllFeasibleSets(const ContactSpace& space, const ContactGraphOptions& options) {
  // The linear programs consider a box that contains the reach of the graph.
  FeasibleContacts feasible(space.contacts, options.reach, options.radius);
  EXPECT_EQ(Sets(MakeContactGraph(space, options)), feasible.All());
  // No decision depends on rounding.
  EXPECT_GT(feasible.least_margin(), 1e-6) << feasible.programs() << " programs";
}

TEST(ContactGraphTest, HasAllFeasibleSetsOfABoxInACorner) {
  ExpectAllFeasibleSets(BoxInCorner(0), Options());
  EXPECT_THAT(MakeContactGraph(BoxInCorner(0), Options()).states, SizeIs(testing::Gt(100)));
}

TEST(ContactGraphTest, HasAllFeasibleSetsOfABoxNearACorner) {
  ExpectAllFeasibleSets(BoxInCorner(0.5e-3), Options());
}

TEST(ContactGraphTest, HasAllFeasibleSetsOfAPegBetweenTwoWalls) {
  const ContactSpace space = Only(PegInHole(0.01), [](const PrimitiveContact& contact) {
    return std::abs(contact.normal.x()) > 0.5;
  });
  ASSERT_THAT(space.contacts, SizeIs(8));
  ExpectAllFeasibleSets(space, Options());
}

// At the corner between two walls of an octagonal hole, a corner of the peg touches both walls at
// their ends.
TEST(ContactGraphTest, HasAllFeasibleSetsOfAnOctagonalPegBetweenTwoWallsOfItsHole) {
  const ContactSpace space =
      Only({PrimitiveContacts(OutsideOf({workloads::PrismPiece({8, kHalf, 0.04})}),
                              OutsideOf(workloads::AroundHole({8, kHalf + kClearance, 0.03}, 0.04)),
                              geometry::Translation(0, 0, -0.01), 0.003)},
           [](const PrimitiveContact& contact) {
             return contact.normal.head<2>().dot(Eigen::Vector2d(-1, -0.4)) > 0.9;
           });
  ASSERT_THAT(space.contacts, SizeIs(8));
  ExpectAllFeasibleSets(space, Options());
  // The last state is flat on both walls.
  const ContactGraph graph = MakeContactGraph(space, Options());
  EXPECT_EQ(graph.states.back().dimension, 1);
  EXPECT_THAT(graph.states.back().contacts, SizeIs(8));
}

// The contacts are those of vertices and edges with one side of the hole, its top and its rim.
// Where the limits of one contact end, others begin, and free space is not convex.
TEST(ContactGraphTest, HasAllFeasibleSetsOfAPegAtOneSideOfTheRim) {
  const ContactSpace peg = PegInHole(0, kClearance);  // an edge of the peg is on an edge of the rim
  const ContactSpace space = Only(peg, [](const PrimitiveContact& contact) {
    const bool on_side =
        contact.kind == ContactKind::kEdgeEdge ? contact.stationary == 0 : contact.stationary <= 1;
    return on_side && contact.at.x() > 0;
  });
  ASSERT_THAT(space.contacts, SizeIs(testing::Ge(8)));
  ExpectAllFeasibleSets(space, Options());
}

TEST(ContactGraphTest, HasAllFeasibleSetsOfAPegOnTopOfTheRim) {
  const ContactSpace space = Only(PegInHole(0), [](const PrimitiveContact& contact) {
    return contact.normal.z() > 0.5 && (contact.at.x() > 0 || contact.at.y() > 0);
  });
  ExpectAllFeasibleSets(space, Options());
}

// --- Laws.

void ExpectTargetPointsAreGood(const ContactSpace& space, const ContactState& state) {
  for (const LocalPose& x : state.target_points) {
    EXPECT_FALSE(space.Overlaps(x));
    EXPECT_LE(x.head<3>().norm() + Options().radius * x.tail<3>().norm(), kReach + 1e-9);
    for (const int contact : state.contacts) {
      EXPECT_LT(std::abs(At(space, contact).Gap(x)), 1e-12);
      const auto one_surface = [&](const PrimitiveContact& other) {
        return (At(space, contact).row - other.row).norm() < 1e-9;
      };
      EXPECT_TRUE(std::ranges::any_of(space.contacts, [&](const PrimitiveContact& other) {
        return one_surface(other) && std::ranges::all_of(other.limits, [&](const HalfSpace& limit) {
                 return limit.Excess(x) < 1e-9;
               });
      }));
    }
  }
}

void ExpectLinksAreGood(const ContactGraph& graph, int index) {
  const ContactState& state = At(graph, index);
  for (const int parent : state.parents) {
    EXPECT_EQ(At(graph, parent).dimension, state.dimension + 1);
    EXPECT_TRUE(std::ranges::includes(state.contacts, At(graph, parent).contacts));
    EXPECT_THAT(At(graph, parent).sons, Contains(index));
  }
  for (const int son : state.sons) EXPECT_THAT(At(graph, son).parents, Contains(index));
  EXPECT_TRUE(std::ranges::is_sorted(state.parents));
  EXPECT_TRUE(std::ranges::is_sorted(state.sons));
}

std::vector<ContactSpace> Spaces() {
  return {PegInHole(0), PegInHole(0.01), BoxInCorner(0), BoxInCorner(0.5e-3)};
}

TEST(ContactGraphTest, StatesAreWhatTheHeaderSays) {
  for (const ContactSpace& space : Spaces()) {
    const ContactGraph graph = MakeContactGraph(space, Options());
    for (int i = 0; i < std::ssize(graph.states); ++i) {
      SCOPED_TRACE(testing::PrintToString(At(graph, i).contacts));
      EXPECT_EQ(At(graph, i).dimension, kPoseDimensions - Rank(space, At(graph, i).contacts));
      EXPECT_TRUE(std::ranges::is_sorted(At(graph, i).contacts));
      EXPECT_THAT(At(graph, i).target_points,
                  SizeIs(testing::AllOf(testing::Ge(1), testing::Le(12))));
      ExpectTargetPointsAreGood(space, At(graph, i));
      ExpectLinksAreGood(graph, i);
    }
    const auto key = [](const ContactState& state) {
      return std::pair(-state.dimension, state.contacts);
    };
    EXPECT_TRUE(std::ranges::is_sorted(graph.states, {}, key));
    EXPECT_THAT(At(graph, 0).contacts, IsEmpty());
    EXPECT_EQ(At(graph, 0).dimension, kPoseDimensions);
  }
}

TEST(ContactGraphTest, IsTheSameForASeed) {
  const ContactSpace space = PegInHole(0);
  const ContactGraph graph = MakeContactGraph(space, Options());
  const ContactGraph again = MakeContactGraph(space, Options());
  ASSERT_EQ(graph.states.size(), again.states.size());
  for (std::size_t i = 0; i < graph.states.size(); ++i) {
    EXPECT_EQ(graph.states[i].contacts, again.states[i].contacts);
    EXPECT_EQ(graph.states[i].target_points, again.states[i].target_points);
    EXPECT_EQ(graph.states[i].sons, again.states[i].sons);
  }
}

TEST(ContactGraphTest, HasTheSameStatesForAnySeed) {
  const ContactSpace space = PegInHole(0.01);
  ContactGraphOptions options = Options();
  const std::set<std::vector<int>> sets = Sets(MakeContactGraph(space, options));
  for (options.seed = 2; options.seed < 6; ++options.seed) {
    EXPECT_EQ(Sets(MakeContactGraph(space, options)), sets) << "seed " << options.seed;
  }
}

// --- States that a peg is known to pass through.

TEST(ContactGraphTest, PegAtTheRimStandsOnACornerAnEdgeOrFlat) {
  const ContactSpace space = PegInHole(0);
  const ContactGraph graph = MakeContactGraph(space, Options());
  const auto dimension = [&](const std::vector<std::string>& names) {
    const int state = graph.Find(Named(space, names));
    return state < 0 ? -1 : At(graph, state).dimension;
  };
  EXPECT_EQ(dimension({}), 6);
  EXPECT_EQ(dimension({"vertex 0 on face 0"}), 5);
  EXPECT_EQ(dimension({"vertex 0 on face 3"}), 5);
  EXPECT_EQ(dimension({"edge 0 on edge 0"}), 5);
  // The peg is shifted toward -x. It has two corners on the top, or all contacts between bottom and
  // top.
  EXPECT_EQ(dimension({"vertex 0 on face 0", "vertex 2 on face 0"}), 4);
  EXPECT_EQ(dimension({"vertex 0 on face 0", "vertex 2 on face 0", "edge 0 on edge 2",
                       "edge 5 on edge 2"}),
            3);
  // The peg is along two neighbouring walls. Its lower end is at the rim, so that nothing keeps it
  // from tilting yet.
  EXPECT_EQ(dimension({"vertex 0 on face 3", "vertex 2 on face 3", "vertex 0 on face 4",
                       "vertex 1 on face 4"}),
            3);
}

TEST(ContactGraphTest, PegHalfInTheHoleSlidesAlongTwoWalls) {
  const ContactSpace space = PegInHole(0.01);
  const ContactGraph graph = MakeContactGraph(space, Options());
  const int crevice = graph.Find(Named(
      space, {"vertex 0 on face 3", "vertex 2 on face 3", "edge 2 on edge 2", "edge 6 on edge 2",
              "vertex 0 on face 4", "vertex 1 on face 4", "edge 2 on edge 3", "edge 4 on edge 3"}));
  ASSERT_GE(crevice, 0);
  EXPECT_EQ(At(graph, crevice).dimension, 1);
  const std::vector<int> distances = graph.DistancesTo({crevice});
  EXPECT_EQ(distances[0], 5);  // one contact is made at a time
  EXPECT_EQ(distances[static_cast<std::size_t>(crevice)], 0);
  for (const int parent : At(graph, crevice).parents) {
    EXPECT_EQ(distances[static_cast<std::size_t>(parent)], 1);
  }
  EXPECT_THAT(distances, Each(testing::Ge(0)));
}

TEST(ContactGraphTest, BoxComesToRestInTheCorner) {
  const ContactSpace space = BoxInCorner(0);
  const ContactGraph graph = MakeContactGraph(space, Options());
  const ContactState& rest = graph.states.back();
  EXPECT_EQ(rest.dimension, 0);
  EXPECT_THAT(rest.contacts, SizeIs(12));
  ASSERT_THAT(rest.target_points, SizeIs(1));
  EXPECT_LT(rest.target_points[0].norm(), 1e-12);
}

// Regions of the top on which one corner can stand count as one contact.
TEST(ContactGraphTest, ContactsOfOneSurfaceAreToldByTheFirst) {
  const ContactSpace space = PegInHole(0);
  const ContactGraph graph = MakeContactGraph(space, Options());
  ASSERT_EQ(Name(At(space, 0)), Name(At(space, 1)));
  EXPECT_GE(graph.Find({0}), 0);
  EXPECT_EQ(graph.Find({1}), -1);
  for (const ContactState& state : graph.states) {
    EXPECT_THAT(state.contacts, testing::Not(Contains(1)));
  }
}

TEST(ContactGraphTest, FreeSpaceAloneIsAGraph) {
  const ContactGraph graph = MakeContactGraph({}, Options());
  ASSERT_THAT(graph.states, SizeIs(1));
  EXPECT_THAT(At(graph, 0).target_points, SizeIs(12));
  EXPECT_THAT(graph.DistancesTo({0}), testing::ElementsAre(0));
  EXPECT_EQ(graph.Find({}), 0);
}

// --- Overlap.

LocalPose Moved(double x, double y, double z) {
  LocalPose pose = LocalPose::Zero();
  pose.head<3>() << x, y, z;
  return pose;
}

TEST(ContactSpaceTest, APegIsFreeInTheHoleAndOnItsWallsAndOverlapsPastThem) {
  for (const ContactSpace& space : {PegInHole(0), PegInHole(0.01)}) {
    const double wall = kClearance;
    EXPECT_FALSE(space.Overlaps(Moved(0, 0, -0.001)));
    EXPECT_FALSE(space.Overlaps(Moved(wall, 0, -0.001)));
    EXPECT_FALSE(space.Overlaps(Moved(-wall, wall, -0.001)));
    EXPECT_TRUE(space.Overlaps(Moved(wall + 1e-6, 0, -0.001)));
    EXPECT_TRUE(space.Overlaps(Moved(-wall - 1e-6, wall, -0.001)));
  }
}

TEST(ContactSpaceTest, APegOverlapsBelowTheTopBesideTheHole) {
  const ContactSpace space = PegInHole(0);
  EXPECT_FALSE(space.Overlaps(Moved(0.001, 0, 0)));
  EXPECT_FALSE(space.Overlaps(Moved(0.001, 0, 1e-6)));
  EXPECT_TRUE(space.Overlaps(Moved(0.001, 0, -1e-6)));
}

}  // namespace
}  // namespace assay::finemotion::contact_graph_test
