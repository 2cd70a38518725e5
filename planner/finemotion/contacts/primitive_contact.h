#pragma once

#include <Eigen/Core>
#include <compare>
#include <optional>
#include <string>
#include <vector>

#include "planner/finemotion/contacts/generalized_point.h"
#include "planner/finemotion/contacts/polyhedron.h"
#include "planner/numeric/small_vector.h"

namespace assay::finemotion {

// Two C-surfaces are the same if their rows' coefficients and their offsets (metres) differ by less
// than this.
inline constexpr double kSameSurface = 1e-9;

// The kinds of contacts. The last four are those of a round shaft of the moving part with a round
// hole of the stationary part (round_contacts.h).
enum class ContactKind {
  kVertexFace,
  kFaceVertex,
  kEdgeEdge,
  kRimFace,  // the rim of the shaft's tip on a face
  kRimRim,   // the rim of the shaft's tip crosses that of the hole's mouth
  kSideRim,  // the side of the shaft on the rim of the hole's mouth
  kRimWall,  // the rim of the shaft's tip on the wall of the hole
};

bool IsRound(ContactKind kind);  // whether it is one of the last four

// A model parameter that may differ from its nominal value. It is one dimension of generalized
// space.
struct ModelTolerance {
  enum class Of { kMovingFaces, kStationaryFaces };
  std::string name;  // for example "width of the shaft"
  Of of = Of::kMovingFaces;
  std::vector<int> faces;  // indices of the faces that the tolerance displaces outward together
};

// The half-space of points z with a . z <= b.
struct HalfSpace {
  numeric::SmallVector a;
  double b = 0;

  double Excess(const GeneralizedPoint& z) const { return a.dot(z) - b; }
};

// A primitive contact near a critical point, linearized there. It has a gap, which is 0 on the
// C-surface and positive in free space, and limits, which bound the surface. A contact ends where
// the vertex leaves its face, where the edges pass each other, or where a neighbouring feature
// would overlap (figure 6 of the paper; rows as in Dakin and Popplestone, equation 1). Rows are in
// metres and not normalized.
struct PrimitiveContact {
  ContactKind kind = ContactKind::kVertexFace;
  int moving = 0;  // index of the feature in its polyhedron
  int stationary = 0;
  numeric::SmallVector row;  // gap = offset + row . z
  double offset = 0;         // the gap at the critical point, metres
  // The contact lies inside all of these half-spaces. Only the nearest ends of a feature are kept,
  // so there are mostly at most 4, as in the paper. There are more only if a face or an edge is
  // narrower than the reach of the search.
  std::vector<HalfSpace> limits;
  Vector3 normal = Vector3::Zero();  // unit vector from the stationary part into free space
  Vector3 at = Vector3::Zero();  // the contact point relative to the moving part's origin, metres

  double Gap(const GeneralizedPoint& z) const { return offset + row.dot(z); }
};

// Names a primitive contact by its features, independently of the pose where it is linearized.
struct ContactKey {
  ContactKind kind = ContactKind::kVertexFace;
  int moving = 0;
  int stationary = 0;

  auto operator<=>(const ContactKey&) const = default;
};
ContactKey KeyOf(const PrimitiveContact& contact);
// Returns the contact with these features, or null if there is none. If there are several (a face
// in several regions), it returns the one that contains the pose of the linearization most deeply.
const PrimitiveContact* Find(const std::vector<PrimitiveContact>& contacts, const ContactKey& key);

// Returns a name such as "vertex 3 on face 1".
std::string Name(const ContactKey& key);
std::string Name(const PrimitiveContact& contact);
// Returns the key with this name, or none if the text is no contact's name.
std::optional<ContactKey> ContactNamed(const std::string& name);

}  // namespace assay::finemotion
