#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "planner/finemotion/contacts/primitive_contact.h"

namespace assay::finemotion {

// The pose of the moving part near a critical point, without model errors: (d, w).
using LocalPose = Eigen::Matrix<double, kPoseDimensions, 1>;

// What the moving part can touch near a critical point.
struct ContactSpace {
  std::vector<PrimitiveContact> contacts;

  // The part would overlap: behind a C-surface by more than `depth` metres, inside its limits (see
  // c_surfaces.h). For a pose now and then: each call looks at all contacts anew.
  bool Overlaps(const LocalPose& x, double depth = 1e-9) const;
};

// A set of primitive contacts that touch together: a facet of contact space. It holds exactly what
// is touched at its target points, so also each contact whose gap is 0 wherever those of the others
// are, if it can be touched there (a face flat on another: all its corners). Contacts on one
// C-surface (a face in several regions) are told by the first of them.
struct ContactState {
  std::vector<int> contacts;  // ascending indices into the space's
  int dimension = kPoseDimensions;
  std::vector<LocalPose> target_points;  // where all of them touch and nothing overlaps
  std::vector<int> parents;              // states with one contact less, one dimension more
  std::vector<int> sons;                 // with one contact more
  int to_goal = -1;  // least number of transitions to a goal; -1: none known, or not to be reached
};

// The topology of local contact space (Dakin and Popplestone, section 3, figures 4 and 8).
// State 0 is free space.
struct ContactGraph {
  std::vector<ContactState> states;  // by falling dimension, then by contacts

  // Least numbers of transitions to a goal, over parents and sons; -1: cannot be reached.
  std::vector<int> DistancesTo(const std::vector<int>& goals) const;
  void MeasureTo(const std::vector<int>& goals);     // stores them with the states
  int Find(const std::vector<int>& contacts) const;  // -1: there is no such state
};

struct ContactGraphOptions {
  int target_points = 12;  // of a state, at most; the paper's number
  int random_rays = 8;     // from a point, besides those along a basis and toward each contact
  // How far poses are from the critical point, at most: metres of any point of the moving part.
  double reach = 0.005;
  // Distance from the origin of its farthest point, metres: what a rotation of 1 comes to.
  double radius = 0.05;
  std::uint64_t seed = 1;
};

// Starts from random poses in free space and from random points of each primitive contact's cone
// form, as far as nothing overlaps there, and casts rays along tangents: what is touched first is a
// neighbour, and the place where it is touched one of its target points. Rays end at the limits of
// what the state itself touches, at the reach, and where linear patches do not match and the part
// would get behind a surface past its limits. Beyond the paper: rays toward every contact, contacts
// that are broken, and places just past where a contact ends, to find states that random rays miss.
// Several independent contacts at once are no neighbour. States narrower than what rays happen to
// come through can be missed: more target points find more.
ContactGraph MakeContactGraph(const ContactSpace& space, const ContactGraphOptions& options = {});

}  // namespace assay::finemotion
