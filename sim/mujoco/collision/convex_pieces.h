#pragma once

#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "planner/geometry/contact/contact_solid.h"
#include "planner/geometry/coordinates.h"

struct mjModel_;

namespace assay::mujoco {

// Pieces of a body lie against each other if the gap between them is smaller than this, in metres.
inline constexpr double kFlush = 1e-6;

// The convex solids of a model's boxes and meshes, prepared for contact. The engine has vertices of
// meshes in single precision, so a solid is exact to about 1e-7 of its size.
class ConvexPieces {
 public:
  explicit ConvexPieces(const mjModel_& model);

  // Returns the solid of a geom in the geom's frame, or null if the geom is neither box nor mesh.
  const geometry::ContactSolid* SolidOf(int geom) const { return pieces_[geom].solid.get(); }

  // A facet of a geom's solid, and the other geoms of the same body that may lie against this
  // facet. The geoms are considered at their places in the model. Some of these other geoms may not
  // collide with everything that this geom collides with.
  struct CoveredFacet {
    int facet = 0;
    std::vector<int> by;
  };
  const std::vector<CoveredFacet>& CoveredFacets(int geom) const { return pieces_[geom].covered; }

 private:
  struct Piece {
    std::shared_ptr<const geometry::ContactSolid> solid;  // geoms of one mesh share it
    std::vector<CoveredFacet> covered;
  };
  std::vector<CoveredFacet> FacetsCovered(const mjModel_& model, int geom) const;

  std::vector<Piece> pieces_;  // by geom
};

// A contact of two geoms that belong to two bodies.
struct PieceContact {
  int geom1 = 0;
  int geom2 = 0;
  geometry::Vector3 at;      // midway between the surfaces, metres, world frame
  geometry::Vector3 normal;  // unit, from the first geom to the second
  double separation = 0;     // metres; negative if they overlap
};

// While an object of this class lives, the engine's collision functions on this thread know the
// pieces of a model. The object lives during one pass of the engine's collisions. The engine's
// collision functions have no other way to data that belong to the model (its callbacks are plain
// functions for all models of the process).
class CollidingPieces {
 public:
  explicit CollidingPieces(const ConvexPieces* pieces);
  ~CollidingPieces();
  CollidingPieces(const CollidingPieces&) = delete;
  CollidingPieces& operator=(const CollidingPieces&) = delete;

  // Returns the pieces that are known on this thread, or null.
  static const ConvexPieces* Present();

  // The contacts of each pair of bodies that was looked at in this pass, the smaller index first.
  using BodyPair = std::pair<int, int>;
  static std::map<BodyPair, std::vector<PieceContact>>& Contacts();

 private:
  const ConvexPieces* pieces_;
  std::map<BodyPair, std::vector<PieceContact>> contacts_;
  CollidingPieces* before_;
};

}  // namespace assay::mujoco
