#include "planner/finemotion/graph/contact_graph.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <queue>
#include <unordered_map>
#include <utility>

#include "planner/base/check.h"
#include "planner/base/random.h"
#include "planner/finemotion/graph/c_surfaces.h"
#include "planner/finemotion/graph/cone_form.h"
#include "planner/numeric/orthogonal_decomposition.h"

namespace assay::finemotion {

namespace {

using Index = std::size_t;
using Tangents = Eigen::Matrix<double, kPoseDimensions, Eigen::Dynamic>;

// A row depends on others if less than this remains of it across them.
constexpr double kDependentRow = 1e-7;
constexpr int kScales = 8;  // start points are drawn within reach, reach / 2, reach / 4, ...
constexpr int kDrawsForATargetPoint = 32;  // greatest number of draws for one target point
// For each target point, states of at least kExploredFrom dimensions are explored from kExplored
// points. Such states are large, have many neighbours, and all other states are found from them.
constexpr int kExplored = 4;
// The least dimension of states that are explored from kExplored points.
constexpr int kExploredFrom = 4;
constexpr double kNever = std::numeric_limits<double>::infinity();

// --- Sets of C-surfaces.

using SurfaceSet = std::vector<std::uint64_t>;  // one bit for each surface

void Insert(SurfaceSet& set, int surface) {
  set[static_cast<Index>(surface) / 64] |= std::uint64_t{1} << (surface % 64);
}

bool Contains(const SurfaceSet& set, int surface) {
  return (set[static_cast<Index>(surface) / 64] >> (surface % 64) & 1) != 0;
}

bool IsSubset(const SurfaceSet& part, const SurfaceSet& set) {
  for (Index i = 0; i < set.size(); ++i) {
    if ((part[i] & ~set[i]) != 0) return false;
  }
  return true;
}

struct HashOfSet {
  std::size_t operator()(const SurfaceSet& set) const {
    std::uint64_t hash = 0;
    for (const std::uint64_t word : set) {
      hash = (hash ^ word) * 0x9e3779b97f4a7c15ULL;
      hash ^= hash >> 29;
    }
    return hash;
  }
};

// --- Contact states during the search.

// The poses at which the gaps of a set of surfaces are all 0, whether the surfaces' limits hold
// there or not.
struct Facet {
  SurfaceSet set;
  std::vector<int> surfaces;     // the surfaces of the set, ascending
  std::vector<int> independent;  // independent ones among the surfaces, as many as the rank
  // Column i closes a gap of 1 of the independent surface i and leaves the gaps of the others.
  Tangents corrections;
  Tangents tangents;               // orthonormal columns
  std::vector<ScaledPose> points;  // poses on the facet, target points first
  Index explored = 0;              // number of points whose neighbours have been searched for

  int dimension() const { return static_cast<int>(tangents.cols()); }
};

Facet FacetOf(const CSurfaces& surfaces, const SurfaceSet& set) {
  Facet facet;
  facet.set = set;
  for (int k = 0; k < surfaces.size(); ++k) {
    if (Contains(set, k)) facet.surfaces.push_back(k);
  }
  if (facet.surfaces.empty()) {
    facet.tangents = Tangents::Identity(kPoseDimensions, kPoseDimensions);
    return facet;
  }
  Eigen::MatrixXd normals(kPoseDimensions, std::ssize(facet.surfaces));
  for (Index i = 0; i < facet.surfaces.size(); ++i) {
    normals.col(static_cast<Eigen::Index>(i)) = surfaces.Row(facet.surfaces[i]);
  }
  const numeric::IndependentColumns independent =
      numeric::IndependentColumnsOf(normals, kDependentRow);
  facet.tangents = independent.complement;
  for (const int column : independent.columns)
    facet.independent.push_back(facet.surfaces[static_cast<Index>(column)]);
  facet.corrections = -independent.dual;
  return facet;
}

// Returns x, moved so that the facet's gaps become 0. Rounding has left these gaps.
ScaledPose Onto(const CSurfaces& surfaces, const Facet& facet, const ScaledPose& x) {
  ScaledPose onto = x;
  for (Index i = 0; i < facet.independent.size(); ++i) {
    const int k = facet.independent[i];
    const double gap = surfaces.Row(k).dot(x) + surfaces.Offset(k);
    onto += gap * facet.corrections.col(static_cast<Eigen::Index>(i));
  }
  return onto;
}

// Finds the facets of one dimension after the other. Rays along the facets of one dimension lead to
// the facets of the next dimension.
class GraphBuilder {
 public:
  GraphBuilder(const ContactSpace& space, const ContactGraphOptions& options)
      : options_(options),
        surfaces_(space.contacts, options.radius),
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
    return Finish();
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
      Facet& facet = FacetTouched();
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
  bool HasRoom(const Facet& facet) const {
    return std::cmp_less(facet.points.size(), Room(facet.dimension()));
  }

  Facet& FacetTouched() {
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
        Facet& facet = facets_[i];
        if (facet.dimension() != dimension) continue;
        for (; facet.explored < facet.points.size(); ++facet.explored) {
          explored = true;
          Explore(facet, facet.points[facet.explored]);
        }
      }
    }
    return explored;
  }

  void Explore(const Facet& facet, const ScaledPose& x) {
    BreakContacts(facet, x);
    if (facet.dimension() == 0) return;
    surfaces_.GapsAt(x, gaps_);
    surfaces_.ExcessesAt(x, excesses_);
    for (Eigen::Index i = 0; i < facet.tangents.cols(); ++i) {
      CastRay(facet, x, facet.tangents.col(i));
      CastRay(facet, x, -facet.tangents.col(i));
    }
    if (facet.dimension() == 1) return;
    for (int k = 0; k < surfaces_.size(); ++k) {
      if (gaps_[k] > kTouch) CastRayToward(k, facet, x);
    }
    for (int i = 0; i < options_.random_rays; ++i) CastRay(facet, x, RandomTangent(facet));
  }

  // Opens each of the independent contacts while the other independent ones stay closed. Contacts
  // that depend on these may stay closed, open with them, or prevent the opening.
  void BreakContacts(const Facet& facet, const ScaledPose& x) {
    for (Index i = 0; i < facet.independent.size(); ++i) {
      const double gap = Scale(random_.Index(kScales));
      const ScaledPose there = x - gap * facet.corrections.col(static_cast<Eigen::Index>(i));
      if (!Look(there) || !IsSubset(touched_, facet.set)) continue;
      Facet& parent = FacetTouched();
      if (parent.dimension() == facet.dimension() + 1) AddPoint(parent, there);
    }
  }

  // --- Rays.

  // Casts a ray in the direction that closes the surface's gap soonest.
  void CastRayToward(int surface, const Facet& facet, const ScaledPose& x) {
    const ScaledPose g = -(facet.tangents * (facet.tangents.transpose() * surfaces_.Row(surface)));
    if (g.norm() > kDependentRow) CastRay(facet, x, g.normalized());
  }

  ScaledPose RandomTangent(const Facet& facet) {
    ScaledPose g = ScaledPose::Zero();
    for (Eigen::Index i = 0; i < facet.tangents.cols(); ++i) {
      g += random_.Uniform(-1, 1) * facet.tangents.col(i);
    }
    return g.normalized();
  }

  // Casts a ray along g from a point x of the facet. gaps_ and excesses_ must hold the values at x.
  void CastRay(const Facet& facet, const ScaledPose& x, const ScaledPose& g) {
    surfaces_.RatesAlong(g, rates_);
    const RayEnd end = EndOf(facet, g);
    if (end.length == kNever) return;
    if (!end.hit) {
      LookPast(facet, x + end.length * g, g);
      return;
    }
    const ScaledPose there = x + end.length * g;
    if (!Look(there) || !IsSubset(facet.set, touched_)) return;
    const auto known = indices_.find(touched_);
    if (known != indices_.end()) {
      Facet& next = facets_[known->second];
      if (next.dimension() == facet.dimension() - 1) AddPoint(next, there);
    } else if (TouchesOneMore(facet)) {
      AddPoint(FacetTouched(), there);
    }
  }

  // Examines the place just past the end of a ray. Where one contact takes over from another there
  // may be a state of the same dimension. This state is no neighbour, but the search can go on from
  // it.
  void LookPast(const Facet& facet, const ScaledPose& end, const ScaledPose& g) {
    const double step = std::ldexp(options_.reach, -kScales / 2 - random_.Index(kScales));
    const ScaledPose there = end + step * g;
    if (!Look(there) || touched_ == facet.set) return;
    Facet& next = FacetTouched();
    if (next.dimension() == facet.dimension()) AddPoint(next, there);
  }

  // Adds a point to the facet, unless a limit keeps the part from motions that the facet's
  // equations allow. For example, two contacts that block each other's rotations form no state of
  // their rank there.
  void AddPoint(Facet& facet, const ScaledPose& x) {
    const auto is_inside = [&](int k) { return surfaces_.IsInside(k, x, facet.tangents); };
    if (!HasRoom(facet) || !std::ranges::all_of(facet.surfaces, is_inside)) return;
    facet.points.push_back(Onto(surfaces_, facet, x));
  }

  // Returns whether the additional surfaces in touched_ amount to one independent contact.
  bool TouchesOneMore(const Facet& facet) const {
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

  struct RayEnd {
    double length = kNever;
    bool hit = false;  // true if a contact is made
  };

  // Returns where a ray makes its first contact, leaves what the facet touches, or gets behind a
  // surface past the surface's limits. The third case occurs because linear patches do not quite
  // match where one contact takes over from another.
  RayEnd EndOf(const Facet& facet, const ScaledPose& g) const {
    RayEnd end;
    for (const int k : facet.surfaces) end.length = std::min(end.length, EndOnSurface(k, g));
    end.length += kTouch;  // at this distance a face may come to lie flat
    Index member = 0;
    for (int k = 0; k < surfaces_.size(); ++k) {
      if (member < facet.surfaces.size() && facet.surfaces[member] == k) {
        ++member;
      } else {
        Meet(k, g, end);
      }
    }
    return end;
  }

  // Returns where the ray leaves the surface. It may pass through several of the surface's patches,
  // one directly after the other.
  double EndOnSurface(int surface, const ScaledPose& g) const {
    const std::vector<CSurfaces::Patch>& patches = surfaces_.Patches(surface);
    double end = 0;
    for (Index i = 0; i < patches.size();) {
      const Stretch stretch = surfaces_.StretchOf(patches[i], excesses_, g);
      const bool goes_on = stretch.from <= end + kTouch && stretch.to > end + kTouch;
      if (goes_on) end = stretch.to;
      i = goes_on && patches.size() > 1 && end < kNever ? 0 : i + 1;
    }
    return end;
  }

  // Moves the ray's end forward to where the ray meets the surface or gets behind it, if that comes
  // first. A contact is also made from behind the surface if the ray reaches the surface's limits
  // just as the gap reaches 0. An example is the other half of an edge that comes to lie flat.
  void Meet(int surface, const ScaledPose& g, RayEnd& end) const {
    const double gap = gaps_[surface];
    const double rate = rates_[surface];
    // The gap is not positive between `from` and `to`.
    double from = 0;
    double to = kNever;
    if (gap > kTouch) {
      if (rate >= -kAlong) return;
      from = -gap / rate;
    } else if (rate > kAlong) {
      to = std::max(0.0, -gap / rate);
    }
    if (from >= end.length) return;
    for (const CSurfaces::Patch& patch : surfaces_.Patches(surface)) {
      const Stretch stretch = surfaces_.StretchOf(patch, excesses_, g);
      const double entry = std::max(from, stretch.from);
      const double exit = std::min(to, stretch.to);
      if (entry >= end.length || entry > exit + kTouch) continue;
      const bool touches = gap + entry * rate > -kTouch;
      const bool gets_behind = stretch.inside && entry + kTouch < exit;
      if (!touches && !gets_behind) continue;
      end = {entry, touches};
    }
  }

  // --- The graph.

  ContactGraph Finish() const {
    std::vector<Index> order;
    for (Index i = 0; i < facets_.size(); ++i) {
      if (i == 0 || !facets_[i].points.empty()) order.push_back(i);
    }
    std::ranges::sort(order, [&](Index a, Index b) {
      const Facet& first = facets_[a];
      const Facet& second = facets_[b];
      if (first.dimension() != second.dimension()) return first.dimension() > second.dimension();
      return first.surfaces < second.surfaces;
    });
    ContactGraph graph;
    for (const Index i : order) graph.states.push_back(StateOf(facets_[i]));
    Link(order, graph);
    return graph;
  }

  ContactState StateOf(const Facet& facet) const {
    ContactState state;
    state.dimension = facet.dimension();
    for (const int k : facet.surfaces) state.contacts.push_back(surfaces_.FirstContact(k));
    for (const ScaledPose& x : facet.points) {
      if (std::cmp_equal(state.target_points.size(), options_.target_points)) break;
      state.target_points.emplace_back(x);
      state.target_points.back().tail<3>() /= options_.radius;
    }
    return state;
  }

  // Links parents and sons. The first contact of a parent is a contact of its son, so only states
  // with such a first contact are compared.
  void Link(const std::vector<Index>& order, ContactGraph& graph) const {
    const auto dimensions = static_cast<Index>(kPoseDimensions) + 2;
    const auto firsts = static_cast<Index>(surfaces_.size()) + 1;
    std::vector<std::vector<std::vector<int>>> states(dimensions,
                                                      std::vector<std::vector<int>>(firsts));
    for (Index i = 0; i < order.size(); ++i) {
      const Facet& facet = facets_[order[i]];
      const std::vector<std::vector<int>>& above =
          states[static_cast<Index>(facet.dimension()) + 1];
      const auto link = [&](const std::vector<int>& parents) {
        for (const int parent : parents) {
          if (!IsSubset(facets_[order[static_cast<Index>(parent)]].set, facet.set)) continue;
          graph.states[i].parents.push_back(parent);
          graph.states[static_cast<Index>(parent)].sons.push_back(static_cast<int>(i));
        }
      };
      link(above.back());  // links to free space
      for (const int k : facet.surfaces) link(above[static_cast<Index>(k)]);
      const Index first =
          facet.surfaces.empty() ? firsts - 1 : static_cast<Index>(facet.surfaces[0]);
      states[static_cast<Index>(facet.dimension())][first].push_back(static_cast<int>(i));
    }
    for (ContactState& state : graph.states) std::ranges::sort(state.parents);
  }

  ContactGraphOptions options_;
  CSurfaces surfaces_;
  RandomStream random_;
  SurfaceSet nothing_;
  std::deque<Facet> facets_;  // in the order in which they were found; references stay valid
  std::unordered_map<SurfaceSet, Index, HashOfSet> indices_;

  // Work space, so that the loops over rays allocate nothing.
  Eigen::VectorXd gaps_;  // gaps at the point that rays are cast from
  std::vector<double> excesses_;
  Eigen::VectorXd rates_;  // rates of change of the gaps along the ray
  SurfaceSet touched_;     // surfaces touched at the pose examined last
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
