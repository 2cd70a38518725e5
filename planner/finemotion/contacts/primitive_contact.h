#pragma once

#include <Eigen/Core>
#include <compare>
#include <optional>
#include <string>
#include <vector>

#include "planner/finemotion/contacts/polyhedron.h"
#include "planner/finemotion/numeric/generalized_point.h"
#include "planner/finemotion/numeric/small_vector.h"

namespace assay::finemotion {

// Coefficients of rows, and metres of offsets, below which C-surfaces are one.
inline constexpr double kSameSurface = 1e-9;

enum class ContactKind { kVertexFace, kFaceVertex, kEdgeEdge };  // moving part's feature first

// What may differ from the model: one dimension of generalized space.
struct ModelTolerance {
  enum class Of { kMovingFaces, kStationaryFaces };
  std::string name;  // "width of the shaft"
  Of of = Of::kMovingFaces;
  std::vector<int> faces;  // that are displaced outward together, by so much
};

// a . z <= b.
struct HalfSpace {
  SmallVector a;
  double b = 0;

  double Excess(const GeneralizedPoint& z) const { return a.dot(z) - b; }  // positive: outside
};

// A primitive contact near a critical point, linearized there: its gap, which is 0 on the C-surface
// and positive in free space, and where the surface ends: the vertex leaves its face or the edges
// pass each other, or a neighbouring feature would overlap (figure 6 of the paper; rows as in
// Dakin and Popplestone, equation 1). Rows are in metres, not normalized.
struct PrimitiveContact {
  ContactKind kind = ContactKind::kVertexFace;
  int moving = 0;  // index of the feature in its polyhedron
  int stationary = 0;
  SmallVector row;    // gap = offset + row . z
  double offset = 0;  // the gap at the critical point, metres
  // The contact is inside of all. At most 4, the paper's number: of a feature's ends the nearest;
  // more only where a face or an edge is narrower than the reach that was asked for.
  std::vector<HalfSpace> limits;
  Vector3 normal = Vector3::Zero();  // from the stationary part into free space, unit
  Vector3 at = Vector3::Zero();      // the contact point relative to the moving part's origin

  double Gap(const GeneralizedPoint& z) const { return offset + row.dot(z); }
};

// A primitive contact by its features, wherever it is linearized.
struct ContactKey {
  ContactKind kind = ContactKind::kVertexFace;
  int moving = 0;
  int stationary = 0;

  auto operator<=>(const ContactKey&) const = default;
};
ContactKey KeyOf(const PrimitiveContact& contact);
// Of several with these features (a face in regions) the one that the pose where they are
// linearized is most inside of; null: there is none.
const PrimitiveContact* Find(const std::vector<PrimitiveContact>& contacts, const ContactKey& key);

// "vertex 3 on face 1".
std::string Name(const ContactKey& key);
std::string Name(const PrimitiveContact& contact);
// The one with this name; none: it is nobody's name.
std::optional<ContactKey> ContactNamed(const std::string& name);

}  // namespace assay::finemotion
