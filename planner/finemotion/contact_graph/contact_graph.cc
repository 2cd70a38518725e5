#include "planner/finemotion/contact_graph/contact_graph.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <queue>
#include <unordered_map>
#include <utility>

#include "planner/base/random.h"
#include "planner/finemotion/contact_graph/c_surfaces.h"
#include "planner/finemotion/contact_graph/cone_form.h"
#include "planner/finemotion/contact_graph/contact_facet.h"
#include "planner/finemotion/contact_graph/contact_rays.h"
#include "planner/finemotion/contact_graph/surface_set.h"

namespace assay::finemotion {

namespace {

using Index = std::size_t;

constexpr int kScales = 8;  // start points are drawn within reach, reach / 2, reach / 4, ...
constexpr int kDrawsForATargetPoint = 32;  // greatest number of draws for one target point
// For each target point, states of at least kExploredFrom dimensions are explored from kExplored
// points. Such states are large, have many neighbours, and all other states are found from them.
constexpr int kExplored = 4;
// The least dimension of states that are explored from kExplored points.
constexpr int kExploredFrom = 4;

ContactState StateOf(const ContactFacet& facet, const CSurfaces& surfaces,
                     const ContactGraphOptions& options) {
  ContactState state;
  state.dimension = facet.dimension();
  for (const int k : facet.surfaces) state.contacts.push_back(surfaces.FirstContact(k));
  for (const ScaledPose& x : facet.points) {
    if (std::cmp_equal(state.target_points.size(), options.target_points)) break;
    state.target_points.emplace_back(x);
    state.target_points.back().tail<3>() /= options.radius;
  }
  return state;
}

// Links parents and sons. The first contact of a parent is a contact of its son, so only states
// with such a first contact are compared.
void Link(const std::vector<const ContactFacet*>& facets, const CSurfaces& surfaces,
          ContactGraph& graph) {
  const auto dimensions = static_cast<Index>(kPoseDimensions) + 2;
  const auto firsts = static_cast<Index>(surfaces.size()) + 1;
  std::vector<std::vector<std::vector<int>>> states(dimensions,
                                                    std::vector<std::vector<int>>(firsts));
  for (Index i = 0; i < facets.size(); ++i) {
    const ContactFacet& facet = *facets[i];
    const std::vector<std::vector<int>>& above = states[static_cast<Index>(facet.dimension()) + 1];
    const auto link = [&](const std::vector<int>& parents) {
      for (const int parent : parents) {
        if (!IsSubset(facets[static_cast<Index>(parent)]->set, facet.set)) continue;
        graph.states[i].parents.push_back(parent);
        graph.states[static_cast<Index>(parent)].sons.push_back(static_cast<int>(i));
      }
    };
    link(above.back());  // links to free space
    for (const int k : facet.surfaces) link(above[static_cast<Index>(k)]);
    const Index first = facet.surfaces.empty() ? firsts - 1 : static_cast<Index>(facet.surfaces[0]);
    states[static_cast<Index>(facet.dimension())][first].push_back(static_cast<int>(i));
  }
  for (ContactState& state : graph.states) std::ranges::sort(state.parents);
}

// Returns the graph of the facets that have points, and of free space, which is the first facet.
ContactGraph GraphOf(const std::deque<ContactFacet>& all, const CSurfaces& surfaces,
                     const ContactGraphOptions& options) {
  std::vector<const ContactFacet*> facets;
  for (const ContactFacet& facet : all) {
    if (facets.empty() || !facet.points.empty()) facets.push_back(&facet);
  }
  std::ranges::sort(facets, [](const ContactFacet* a, const ContactFacet* b) {
    if (a->dimension() != b->dimension()) return a->dimension() > b->dimension();
    return a->surfaces < b->surfaces;
  });
  ContactGraph graph;
  for (const ContactFacet* facet : facets) {
    graph.states.push_back(StateOf(*facet, surfaces, options));
  }
  Link(facets, surfaces, graph);
  return graph;
}

// Finds the facets of one dimension after the other. Rays along the facets of one dimension lead to
// the facets of the next dimension.
class GraphBuilder {
 public:
  GraphBuilder(const ContactSpace& space, const ContactGraphOptions& options)
      : options_(options),
        surfaces_(space.contacts, options.radius),
        rays_(surfaces_),
        random_(options.seed, "contact graph"),
        nothing_(static_cast<Index>(surfaces_.size()) / 64 + 1, 0),
        touched_(nothing_) {}

  ContactGraph Build() {
    facets_.push_back(FacetOf(surfaces_, nothing_));
    indices_[nothing_] = 0;
    StartInFreeSpace();
    for (int k = 0; k < surfaces_.size(); ++k) {
      for (const CSurfaces::Patch& patch : surfaces_.Patches(k)) StartOn(k, patch);
    }
    while (ExploreAll()) {
    }
    return GraphOf(facets_, surfaces_, options_);
  }

 private:
  // --- Start points. A part in a tight hole is free at the scale of its clearance only.

  int Draws() const { return options_.target_points * kDrawsForATargetPoint; }
  double Scale(int draw) const { return std::ldexp(options_.reach, -(draw % kScales)); }

  void StartInFreeSpace() {
    for (int draw = 0; draw < Draws() && HasRoom(facets_[0]); ++draw) {
      ScaledPose x;
      for (double& coordinate : x) coordinate = Scale(draw) * random_.Uniform(-1, 1);
      if (Look(x) && touched_ == nothing_) facets_[0].points.push_back(x);
    }
  }

  // Starts from random points of a primitive contact's cone form (Dakin and Popplestone, equation
  // 2).
  void StartOn(int surface, const CSurfaces::Patch& patch) {
    const std::vector<HalfSpace> limits = surfaces_.Limits(patch);
    const ConeForm form =
        ConeFormOf(surfaces_.Row(surface).transpose(),
                   Eigen::VectorXd::Constant(1, -surfaces_.Offset(surface)), limits);
    int found = 0;
    for (int draw = 0; draw < Draws() && found < Room(kPoseDimensions - 1); ++draw) {
      const ScaledPose x = RandomPoint(form, limits, Scale(draw));
      if (!Look(x) || !Contains(touched_, surface)) continue;
      ContactFacet& facet = FacetTouched();
      if (facet.dimension() != kPoseDimensions - 1) continue;
      ++found;
      AddPoint(facet, x);
    }
  }

  // Returns a random point of the contact. The cone's characteristic point, where all limits end,
  // may be far away. The returned point is therefore about as far inside each limit as the critical
  // point is, up to `scale`.
  ScaledPose RandomPoint(const ConeForm& form, const std::vector<HalfSpace>& limits, double scale) {
    ScaledPose x = form.characteristic_point;
    for (Eigen::Index i = 0; i < form.rays.cols(); ++i) {
      const HalfSpace& limit = limits[static_cast<Index>(form.limits[static_cast<Index>(i)])];
      const double inside = std::abs(limit.b + scale * random_.Uniform(-1, 1));
      x -= inside / limit.a.dot(form.rays.col(i)) * form.rays.col(i);
    }
    for (Eigen::Index i = 0; i < form.tangents.cols(); ++i) {
      x += scale * random_.Uniform(-1, 1) * form.tangents.col(i);
    }
    return x;
  }

  // --- Poses.

  bool IsInReach(const ScaledPose& x) const {
    return x.head<3>().norm() + x.tail<3>().norm() <= options_.reach;
  }

  // Stores the surfaces that are touched at x in touched_. Returns false if x is out of reach or
  // the parts overlap there.
  bool Look(const ScaledPose& x) {
    if (!IsInReach(x)) return false;
    surfaces_.GapsAt(x, gaps_there_);
    std::ranges::fill(touched_, 0);
    for (int k = 0; k < surfaces_.size(); ++k) {
      if (gaps_there_[k] > kTouch || !surfaces_.Covers(k, x)) continue;
      if (gaps_there_[k] < -kTouch) return false;
      Insert(touched_, k);
    }
    return true;
  }

  int Room(int dimension) const {
    if (dimension == 0) return 1;
    return (dimension < kExploredFrom ? 1 : kExplored) * options_.target_points;
  }
  bool HasRoom(const ContactFacet& facet) const {
    return std::cmp_less(facet.points.size(), Room(facet.dimension()));
  }

  ContactFacet& FacetTouched() {
    const auto [entry, added] = indices_.try_emplace(touched_, facets_.size());
    if (added) facets_.push_back(FacetOf(surfaces_, touched_));
    return facets_[entry->second];
  }

  // --- Neighbours.

  // Explores from free space down to 0-dimensional states, because most states that are found have
  // fewer dimensions. Returns false if there was nothing new.
  bool ExploreAll() {
    bool explored = false;
    for (int dimension = kPoseDimensions; dimension >= 0; --dimension) {
      for (Index i = 0; i < facets_.size(); ++i) {
        ContactFacet& facet = facets_[i];
        if (facet.dimension() != dimension) continue;
        for (; facet.explored < facet.points.size(); ++facet.explored) {
          explored = true;
          Explore(facet, facet.points[facet.explored]);
        }
      }
    }
    return explored;
  }

  void Explore(const ContactFacet& facet, const ScaledPose& x) {
    BreakContacts(facet, x);
    if (facet.dimension() == 0) return;
    rays_.StartAt(x);
    for (Eigen::Index i = 0; i < facet.tangents.cols(); ++i) {
      CastRay(facet, x, facet.tangents.col(i));
      CastRay(facet, x, -facet.tangents.col(i));
    }
    if (facet.dimension() == 1) return;
    for (int k = 0; k < surfaces_.size(); ++k) {
      if (rays_.Gap(k) > kTouch) CastRayToward(k, facet, x);
    }
    for (int i = 0; i < options_.random_rays; ++i) CastRay(facet, x, RandomTangent(facet));
  }

  // Opens each of the independent contacts while the other independent ones stay closed. Contacts
  // that depend on these may stay closed, open with them, or prevent the opening.
  void BreakContacts(const ContactFacet& facet, const ScaledPose& x) {
    for (Index i = 0; i < facet.independent.size(); ++i) {
      const double gap = Scale(random_.Index(kScales));
      const ScaledPose there = x - gap * facet.corrections.col(static_cast<Eigen::Index>(i));
      if (!Look(there) || !IsSubset(touched_, facet.set)) continue;
      ContactFacet& parent = FacetTouched();
      if (parent.dimension() == facet.dimension() + 1) AddPoint(parent, there);
    }
  }

  // --- Rays.

  // Casts a ray in the direction that closes the surface's gap soonest.
  void CastRayToward(int surface, const ContactFacet& facet, const ScaledPose& x) {
    const ScaledPose g = -(facet.tangents * (facet.tangents.transpose() * surfaces_.Row(surface)));
    if (g.norm() > kDependentRow) CastRay(facet, x, g.normalized());
  }

  ScaledPose RandomTangent(const ContactFacet& facet) {
    ScaledPose g = ScaledPose::Zero();
    for (Eigen::Index i = 0; i < facet.tangents.cols(); ++i) {
      g += random_.Uniform(-1, 1) * facet.tangents.col(i);
    }
    return g.normalized();
  }

  // Casts a ray along g from a point x of the facet, at which rays_ must start.
  void CastRay(const ContactFacet& facet, const ScaledPose& x, const ScaledPose& g) {
    const RayEnd end = rays_.Cast(facet, g);
    if (end.length == kNever) return;
    if (!end.hit) {
      LookPast(facet, x + end.length * g, g);
      return;
    }
    const ScaledPose there = x + end.length * g;
    if (!Look(there) || !IsSubset(facet.set, touched_)) return;
    const auto known = indices_.find(touched_);
    if (known != indices_.end()) {
      ContactFacet& next = facets_[known->second];
      if (next.dimension() == facet.dimension() - 1) AddPoint(next, there);
    } else if (TouchesOneMore(facet)) {
      AddPoint(FacetTouched(), there);
    }
  }

  // Examines the place just past the end of a ray. Where one contact takes over from another there
  // may be a state of the same dimension. This state is no neighbour, but the search can go on from
  // it.
  void LookPast(const ContactFacet& facet, const ScaledPose& end, const ScaledPose& g) {
    const double step = std::ldexp(options_.reach, -kScales / 2 - random_.Index(kScales));
    const ScaledPose there = end + step * g;
    if (!Look(there) || touched_ == facet.set) return;
    ContactFacet& next = FacetTouched();
    if (next.dimension() == facet.dimension()) AddPoint(next, there);
  }

  // Adds a point to the facet, unless a limit keeps the part from motions that the facet's
  // equations allow. For example, two contacts that block each other's rotations form no state of
  // their rank there.
  void AddPoint(ContactFacet& facet, const ScaledPose& x) {
    const auto is_inside = [&](int k) { return surfaces_.IsInside(k, x, facet.tangents); };
    if (!HasRoom(facet) || !std::ranges::all_of(facet.surfaces, is_inside)) return;
    facet.points.push_back(Onto(surfaces_, facet, x));
  }

  // Returns whether the additional surfaces in touched_ amount to one independent contact.
  bool TouchesOneMore(const ContactFacet& facet) const {
    Eigen::VectorXd first;
    for (int k = 0; k < surfaces_.size(); ++k) {
      if (!Contains(touched_, k) || Contains(facet.set, k)) continue;
      const Eigen::VectorXd slope = facet.tangents.transpose() * surfaces_.Row(k);
      if (slope.norm() <= kDependentRow) continue;
      if (first.size() == 0) first = slope.normalized();
      if ((slope - slope.dot(first) * first).norm() > kDependentRow) return false;
    }
    return first.size() > 0;
  }

  ContactGraphOptions options_;
  CSurfaces surfaces_;
  ContactRays rays_;
  RandomStream random_;
  SurfaceSet nothing_;
  std::deque<ContactFacet> facets_;  // in the order in which they were found; references stay valid
  std::unordered_map<SurfaceSet, Index, HashOfSet> indices_;

  // Work space, so that the loops over rays allocate nothing.
  SurfaceSet touched_;  // surfaces touched at the pose examined last
  Eigen::VectorXd gaps_there_;
};

}  // namespace

bool ContactSpace::Overlaps(const LocalPose& x, double depth) const {
  const CSurfaces surfaces(contacts, 1);
  Eigen::VectorXd gaps;
  surfaces.GapsAt(x, gaps);
  for (int k = 0; k < surfaces.size(); ++k) {
    if (gaps[k] < -depth && surfaces.Covers(k, x)) return true;
  }
  return false;
}

std::vector<int> ContactGraph::DistancesTo(const std::vector<int>& goals) const {
  std::vector<int> distances(states.size(), -1);
  std::queue<int> reached;
  const auto reach = [&](int state, int distance) {
    int& known = distances[static_cast<Index>(state)];
    if (known >= 0) return;
    known = distance;
    reached.push(state);
  };
  for (const int goal : goals) reach(goal, 0);
  for (; !reached.empty(); reached.pop()) {
    const auto i = static_cast<Index>(reached.front());
    for (const int parent : states[i].parents) reach(parent, distances[i] + 1);
    for (const int son : states[i].sons) reach(son, distances[i] + 1);
  }
  return distances;
}

void ContactGraph::MeasureTo(const std::vector<int>& goals) {
  const std::vector<int> distances = DistancesTo(goals);
  for (Index i = 0; i < states.size(); ++i) states[i].to_goal = distances[i];
}

int ContactGraph::Find(const std::vector<int>& contacts) const {
  const auto found = std::ranges::find(states, contacts, &ContactState::contacts);
  return found == states.end() ? -1 : static_cast<int>(found - states.begin());
}

ContactGraph MakeContactGraph(const ContactSpace& space, const ContactGraphOptions& options) {
  return GraphBuilder(space, options).Build();
}

}  // namespace assay::finemotion
