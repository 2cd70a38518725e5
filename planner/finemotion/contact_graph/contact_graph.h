#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "planner/finemotion/contacts/primitive_contact.h"

namespace assay::finemotion {

// The pose (d, w) of the moving part near a critical point, without model errors.
using LocalPose = Eigen::Matrix<double, kPoseDimensions, 1>;

// The primitive contacts that the moving part can make near a critical point.
struct ContactSpace {
  std::vector<PrimitiveContact> contacts;

  // Returns whether the part would overlap: whether the pose is inside some C-surface's limits (see
  // c_surfaces.h) and more than `depth` metres behind the surface. Each call examines all contacts
  // anew, so it suits occasional calls.
  bool Overlaps(const LocalPose& x, double depth = 1e-9) const;
};

// A set of primitive contacts that touch together: a facet of contact space. It holds every contact
// that is touched at its target points. It includes contacts whose gap is 0 wherever the gaps of
// the other contacts are 0, if they can be touched there. For example, a face that lies flat
// touches with all its corners. Contacts on one C-surface (a face in several regions) are
// represented by the first of them.
struct ContactState {
  std::vector<int> contacts;  // ascending indices into the space's contacts
  int dimension = kPoseDimensions;
  std::vector<LocalPose> target_points;  // poses where all contacts touch and nothing overlaps
  std::vector<int> parents;  // indices of states with one contact less and one dimension more
  std::vector<int> sons;     // indices of states with one contact more
  // The least number of transitions to a goal, or -1 if it is not known or no goal can be reached.
  int to_goal = -1;
};

// The topology of local contact space (Dakin and Popplestone, section 3, figures 4 and 8). State 0
// is free space.
struct ContactGraph {
  std::vector<ContactState> states;  // ordered by falling dimension, then by contacts

  // Returns each state's least number of transitions to a goal, over parents and sons, or -1 if no
  // goal can be reached.
  std::vector<int> DistancesTo(const std::vector<int>& goals) const;
  void MeasureTo(const std::vector<int>& goals);  // stores DistancesTo(goals) in the states
  // Returns the index of the state, or -1 if there is none.
  int Find(const std::vector<int>& contacts) const;
};

struct ContactGraphOptions {
  int target_points = 12;  // greatest number for each state; the paper's number
  int random_rays = 8;     // rays from a point besides those along a basis and toward each contact
  // The greatest distance of a pose from the critical point, in metres. The distance is the
  // translation plus the rotation times `radius`, which bounds the motion of the part's points.
  double reach = 0.005;
  // Metres from the moving part's origin to its farthest point. It converts rotations to lengths.
  double radius = 0.05;
  std::uint64_t seed = 1;
};

// Builds the contact graph by casting rays. Rays start from random poses in free space and from
// random points of each primitive contact's cone form where nothing overlaps, and run along
// tangents. The first contact that a ray meets leads to a neighbouring state, and the place is one
// of its target points. A ray ends at the limits of the contacts of its state, and at the reach. It
// also ends where it would get behind a surface past the surface's limits, because linear patches
// do not match exactly. To find states that random rays miss, and beyond the paper, rays are cast
// toward every contact, contacts are broken, and places just past the end of a contact are
// examined. States that differ by several independent contacts are not neighbours. A state can be
// missed if it is so narrow that no ray comes through it; more target points find more.
ContactGraph MakeContactGraph(const ContactSpace& space, const ContactGraphOptions& options = {});

}  // namespace assay::finemotion
